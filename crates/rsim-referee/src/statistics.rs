//! Statistics of a match, as a broadcast shows them: shots, possession, distances, offenses.

use crate::column::{ByTeam, row};
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::ruling::Ruling;
use crate::team::Team;

/// Kinds of offenses that are counted apart.
pub const OFFENSES: [EventKind; 15] = [
    EventKind::KeeperHeldBall,
    EventKind::AttackerDoubleTouchedBall,
    EventKind::AttackerTouchedBallInDefenseArea,
    EventKind::BotDribbledBallTooFar,
    EventKind::BotKickedBallTooFast,
    EventKind::AttackerTooCloseToDefenseArea,
    EventKind::BotInterferedPlacement,
    EventKind::BotCrashDrawn,
    EventKind::BotCrashUnique,
    EventKind::BotPushedBot,
    EventKind::BotTooFastInStop,
    EventKind::DefenderTooCloseToKickPoint,
    EventKind::DefenderInDefenseArea,
    EventKind::BoundaryCrossing,
    EventKind::PlacementFailed,
];

/// Speed of the ball toward the goal from which it is a shot, as a share of the field's length a second: 0.1
/// m/s on a VSSS table of 1.5 m, 0.6 m/s on an SSL field of 9 m.
const SHOT_SPEED: f32 = 0.067;

row! {
    /// Statistics since the match began.
    #[derive(Default)]
    pub struct Statistics {
        /// Control steps in which the ball was in play.
        in_play_steps: i32,
        /// Control steps in which the team touched the ball last, while it was in play.
        possession_steps: ByTeam<i32>,
        /// Balls that left a robot of the team toward the mouth of the opponents' goal.
        shots: ByTeam<i32>,
        /// Way of all robots of the team, m.
        distance: ByTeam<f32>,
    }
}

impl Statistics {
    /// Counts a step, with the state of the match at its end.
    pub fn count(&mut self, game: &Game, moment: &Moment) {
        for team in Team::BOTH {
            self.distance[team] += way(moment, team);
        }
        if !game.in_play {
            return;
        }
        self.in_play_steps += 1;
        if let Some(robot) = game.last_touch {
            let team = moment.team_of(robot);
            self.possession_steps[team] += 1;
            if left(moment, robot) && is_on_target(moment, team) {
                self.shots[team] += 1;
            }
        }
    }
}

/// Counts an offense in a row of numbers of blue and of yellow, by the kinds in [`OFFENSES`].
pub fn count_offense(row: &mut [f32], ruling: &Ruling) {
    let Some(nth) = OFFENSES.iter().position(|kind| *kind == ruling.event.kind) else { return };
    for (team, counts) in Team::BOTH.into_iter().zip(row.chunks_exact_mut(OFFENSES.len())) {
        if ruling.event.team.is_none_or(|at_fault| at_fault == team) {
            counts[nth] += 1.0;
        }
    }
}

/// Names of the columns of offenses.
pub fn offense_columns() -> Vec<String> {
    let kinds =
        |team: &'static str| (0..OFFENSES.len()).map(move |nth| format!("offenses_{team}_{nth}"));
    ["blue", "yellow"].into_iter().flat_map(kinds).collect()
}

/// Way of the robots of a team in the step, m.
fn way(moment: &Moment, team: Team) -> f32 {
    let robots = moment.now.team(team);
    robots.map(|robot| robot.velocity.length() * moment.pitch.time_step).sum()
}

/// Whether the ball left the robot that touched it last: it touched it before the step, and does not now.
fn left(moment: &Moment, robot: usize) -> bool {
    let touched_before = moment.before.robot(robot).is_some_and(|robot| robot.touched_ball);
    touched_before && !moment.now.robots().any(|robot| robot.touched_ball)
}

/// Whether the ball moves toward the mouth of the goal that a team attacks.
fn is_on_target(moment: &Moment, attacker: Team) -> bool {
    let (lines, ball) = (moment.lines(), moment.ball);
    let ahead = -attacker.own_side();
    let speed = ahead * ball.velocity.x;
    let way = lines.half_length - ahead * ball.position.x;
    let y = ball.position.y + ball.velocity.y * (way / speed);
    speed > SHOT_SPEED * 2.0 * lines.half_length && way > 0.0 && y.abs() < lines.half_goal_width
}
