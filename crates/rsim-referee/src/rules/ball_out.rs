//! SSL: the ball leaves the field (SSL rules, "Ball Leaving the Field").

use crate::codes::Command;
use crate::events::{Event, EventKind};
use crate::lines::Lines;
use crate::team::Team;
use crate::vector::Vector;

/// Distance from the lines of the ball of a throw-in and of a corner kick, m.
pub const FROM_LINES: f32 = 0.2;
/// Distance from the goal line of the ball of a goal kick, m.
pub const GOAL_KICK_FROM_GOAL_LINE: f32 = 1.0;

/// Line that the ball crossed completely, other than into a goal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// A touch line.
    Touch,
    /// The goal line of the team.
    Goal(Team),
}

/// A ball that left the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallOut {
    /// Place where it left, m.
    pub position: Vector,
    /// Line that it crossed.
    pub line: Line,
    /// Robot that touched it last, and its team.
    pub toucher: Option<(usize, Team)>,
    /// Place where that robot touched it, m.
    pub touched_at: Vector,
    /// Whether another robot has touched it since that robot's kick.
    pub was_deflected: bool,
}

/// The decision about a ball that left the field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// The event.
    pub event: Event,
    /// Command with which play goes on.
    pub command: Command,
    /// Place where the ball has to be, m.
    pub position: Vector,
}

/// Decides on a ball that left the field: a throw-in, a goal kick, a corner kick, or a free kick where an
/// aimless kick was made, if `aimless_kick` is a rule.
pub fn judge(lines: &Lines, ball: &BallOut, aimless_kick: bool) -> Decision {
    let (robot, team) = ball.toucher.unzip();
    let event = |kind| Event { kind, team, robot, position: ball.position };
    let Some(team) = team else {
        // Nobody touched it since the start: play goes on by a free ball, near the line.
        let kind = match ball.line {
            Line::Touch => EventKind::BallLeftFieldTouchLine,
            Line::Goal(_) => EventKind::BallLeftFieldGoalLine,
        };
        let position = lines.nearest_kick_place(ball.position, FROM_LINES, FROM_LINES);
        return Decision { event: event(kind), command: Command::ForceStart, position };
    };
    let command = Command::DirectFree(team.opponent());
    match ball.line {
        Line::Touch => Decision {
            event: event(EventKind::BallLeftFieldTouchLine),
            command,
            position: throw_in(lines, ball.position),
        },
        Line::Goal(_) if aimless_kick && is_aimless(ball, team) => {
            Decision { event: event(EventKind::AimlessKick), command, position: ball.touched_at }
        }
        Line::Goal(defender) => {
            let from_goal_line =
                if team == defender { FROM_LINES } else { GOAL_KICK_FROM_GOAL_LINE };
            Decision {
                event: event(EventKind::BallLeftFieldGoalLine),
                command,
                position: beside_goal_line(lines, ball.position, defender, from_goal_line),
            }
        }
    }
}

/// A kick over the far goal line, from the own half, that no other robot touched.
fn is_aimless(ball: &BallOut, kicker: Team) -> bool {
    ball.line == Line::Goal(kicker.opponent())
        && kicker.own_side() * ball.touched_at.x > 0.0
        && !ball.was_deflected
}

/// Inside the touch line, where the ball crossed it.
fn throw_in(lines: &Lines, left_at: Vector) -> Vector {
    let max_x = lines.half_length - FROM_LINES;
    let y = (lines.half_width - FROM_LINES).copysign(left_at.y);
    Vector::new(left_at.x.clamp(-max_x, max_x), y)
}

/// Beside the corner on the side on which the ball left, some way from the goal line.
fn beside_goal_line(lines: &Lines, left_at: Vector, defender: Team, from_goal_line: f32) -> Vector {
    let x = defender.own_side() * (lines.half_length - from_goal_line);
    Vector::new(x, (lines.half_width - FROM_LINES).copysign(left_at.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::tests::SSL_B;

    fn out(line: Line, x: f32, y: f32, team: Team, touched_x: f32) -> BallOut {
        BallOut {
            position: Vector::new(x, y),
            line,
            toucher: Some((3, team)),
            touched_at: Vector::new(touched_x, 0.5),
            was_deflected: false,
        }
    }

    fn decided(ball: &BallOut) -> (EventKind, Command, Vector) {
        let decision = judge(&SSL_B, ball, true);
        assert_eq!(decision.event.robot, Some(3));
        (decision.event.kind, decision.command, decision.position)
    }

    #[test]
    fn a_ball_over_a_touch_line_is_thrown_in_by_the_others() {
        for team in Team::BOTH {
            for (x, y, place) in [
                (1.0, 3.02, Vector::new(1.0, 2.8)),
                (-4.4, -3.02, Vector::new(-4.3, -2.8)),
                (4.49, 3.02, Vector::new(4.3, 2.8)),
            ] {
                assert_eq!(
                    decided(&out(Line::Touch, x, y, team, 0.0)),
                    (
                        EventKind::BallLeftFieldTouchLine,
                        Command::DirectFree(team.opponent()),
                        place
                    )
                );
            }
        }
    }

    #[test]
    fn over_a_goal_line_attackers_give_a_goal_kick_and_defenders_a_corner_kick() {
        for defender in Team::BOTH {
            let x = defender.own_side() * 4.52;
            let attacker = defender.opponent();
            // Touched in the half that the team attacks, so it is no aimless kick.
            let kick = out(Line::Goal(defender), x, -1.0, attacker, defender.own_side());
            let place = Vector::new(defender.own_side() * 3.5, -2.8);
            let expected = (EventKind::BallLeftFieldGoalLine, Command::DirectFree(defender), place);
            assert_eq!(decided(&kick), expected);
            let corner = out(Line::Goal(defender), x, 1.0, defender, x);
            let place = Vector::new(defender.own_side() * 4.3, 2.8);
            let expected = (EventKind::BallLeftFieldGoalLine, Command::DirectFree(attacker), place);
            assert_eq!(decided(&corner), expected);
        }
    }

    #[test]
    fn a_kick_from_the_own_half_over_the_far_goal_line_is_aimless() {
        let kick = out(Line::Goal(Team::Yellow), 4.52, 2.0, Team::Blue, -1.0);
        let expected =
            (EventKind::AimlessKick, Command::DirectFree(Team::Yellow), Vector::new(-1.0, 0.5));
        assert_eq!(decided(&kick), expected);
        let ordinary = EventKind::BallLeftFieldGoalLine;
        assert_eq!(judge(&SSL_B, &kick, false).event.kind, ordinary, "no rule of division A");
        let from_the_other_half = BallOut { touched_at: Vector::new(0.01, 0.0), ..kick };
        assert_eq!(decided(&from_the_other_half).0, ordinary);
        let deflected = BallOut { was_deflected: true, ..kick };
        assert_eq!(decided(&deflected).0, ordinary);
        let own_line = out(Line::Goal(Team::Blue), -4.52, 2.0, Team::Blue, -1.0);
        assert_eq!(decided(&own_line).0, ordinary);
    }

    #[test]
    fn a_ball_that_nobody_touched_is_free_for_both() {
        let ball = BallOut { toucher: None, ..out(Line::Touch, 0.0, 3.02, Team::Blue, 0.0) };
        let decision = judge(&SSL_B, &ball, true);
        assert_eq!(decision.command, Command::ForceStart);
        assert_eq!(decision.event.team, None);
        assert_eq!(decision.position, Vector::new(0.0, 2.8));
    }
}
