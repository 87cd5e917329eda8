//! Numbers that a robot observes of the state of a match, from the side of its team.

use crate::codes::Command;
use crate::error::RefereeError;
use crate::game::Game;
use crate::referee::Referee;
use crate::sight::Sight;
use crate::team::Team;
use crate::vector::Vector;

/// Names of the numbers that a robot observes. "Own" and "opponents'" are those of its team.
pub const FEATURES: [&str; 29] = [
    // What play is in, one of these is 1.
    "halt",
    "stop",
    "in_play",
    "own_kickoff",
    "opponents_kickoff",
    "own_penalty",
    "opponents_penalty",
    "own_free_kick",
    "opponents_free_kick",
    "own_placement",
    "opponents_placement",
    "free_ball",
    // What a stop or a placement waits for, at most one of these is 1.
    "next_own_kickoff",
    "next_opponents_kickoff",
    "next_own_penalty",
    "next_opponents_penalty",
    "next_own_free_kick",
    "next_opponents_free_kick",
    "next_free_ball",
    // Whether the robot may touch the ball, 0 or 1.
    "may_touch",
    // Whether the robot is the keeper of its team, 0 or 1.
    "keeper",
    // Way that the robot has dribbled the ball, as a share of what the rules allow.
    "dribbled",
    // Time until something has to happen, in units of 10 s.
    "time_to_act",
    // Place where the ball has to be, relative to the robot, in half lengths of the field; 0 in play.
    "designated_x",
    "designated_y",
    // Goals of the own team less those of the others, in units of 5, -1 to 1.
    "score_difference",
    // Share of the half that is left.
    "time_left",
    // Robots of both teams on the field, as shares of the numbers in the match.
    "own_robots",
    "opponents_robots",
];

/// Place of the numbers in [`FEATURES`].
const NEXT: usize = 12;
const MAY_TOUCH: usize = 19;

/// Time in which `time_to_act` is 1, s.
const ACTION_SECONDS: f32 = 10.0;
/// Goals for which `score_difference` is 1.
const MANY_GOALS: f32 = 5.0;

/// A match as its robots observe it.
#[derive(Debug)]
pub struct Features<'a> {
    game: &'a Game,
    sight: Sight<'a>,
    seconds_to_act: f32,
    share_left: f32,
    /// Share of each team's robots that are on the field.
    robots: [f32; 2],
    /// Half the distance between the goal lines, m.
    half_length: f32,
    /// Way that a robot may dribble, m; 0 for any.
    dribble_distance: f32,
}

impl Referee {
    /// Prepares what the robots of a match observe.
    ///
    /// # Errors
    /// A row of another length.
    pub fn features<'a>(
        &'a self,
        game: &'a Game,
        row: &'a [f32],
    ) -> Result<Features<'a>, RefereeError> {
        let sight = self.layout().sight(row)?;
        Ok(Features {
            game,
            sight,
            seconds_to_act: self.seconds_to_act(game),
            share_left: self.share_left(game),
            robots: Team::BOTH
                .map(|team| share(sight.count(team), self.layout().team_size(team).max(1))),
            half_length: self.pitch().lines.half_length,
            dribble_distance: self.config().dribble_distance,
        })
    }

    /// Time until the present command ends or a kick has to be taken, s; 0 while the ball is in play.
    fn seconds_to_act(&self, game: &Game) -> f32 {
        let config = self.config();
        let limit = match game.command {
            Command::Stop | Command::BallPlacement(_) => self.pitch().seconds(game.wait_steps),
            Command::Halt => config.halt_seconds,
            Command::NormalStart | Command::DirectFree(_) if !game.in_play => match game.kick {
                Some(Command::PrepareKickoff(_)) => config.kickoff_seconds,
                Some(Command::PreparePenalty(_)) => config.penalty_seconds,
                _ => config.free_kick_seconds,
            },
            Command::PrepareKickoff(_)
            | Command::PreparePenalty(_)
            | Command::FreeBall
            | Command::GoalKick(_) => config.prepare_seconds,
            _ => return 0.0,
        };
        (limit - self.pitch().seconds(game.command_steps)).max(0.0)
    }

    /// Share of the half that is left; 1 before it begins.
    fn share_left(&self, game: &Game) -> f32 {
        let all = self.config().seconds(game.stage);
        if all > 0.0 {
            (self.pitch().seconds(game.stage_steps_left) / all).clamp(0.0, 1.0)
        } else {
            1.0
        }
    }
}

impl Features<'_> {
    /// Writes the features of a robot.
    pub fn write(&self, robot: usize, out: &mut [f32]) {
        let (game, team) = (self.game, self.sight.team_of(robot));
        out.fill(0.0);
        out[command_feature(game, team)] = 1.0;
        if matches!(game.command, Command::Halt | Command::Stop | Command::BallPlacement(_)) {
            if let Some(next) = game.next_command.and_then(|next| kick_feature(next, team)) {
                out[NEXT + next] = 1.0;
            }
        }
        let place = self.designated_offset(robot, team);
        let lead = game.score[team] - game.score[team.opponent()];
        out[MAY_TOUCH..].copy_from_slice(&[
            if game.robot_may_touch(robot, team) { 1.0 } else { 0.0 },
            if robot == self.sight.keeper(team) { 1.0 } else { 0.0 },
            self.share_dribbled(robot),
            self.seconds_to_act / ACTION_SECONDS,
            place.x,
            place.y,
            (number(lead) / MANY_GOALS).clamp(-1.0, 1.0),
            self.share_left,
            self.robots[team.index()],
            self.robots[team.opponent().index()],
        ]);
    }

    /// Way that the robot has dribbled, as a share of the allowed one; 0 out of play and without such a rule.
    fn share_dribbled(&self, robot: usize) -> f32 {
        if self.game.in_play && self.game.dribbler == Some(robot) && self.dribble_distance > 0.0 {
            self.sight.ball().position.distance(self.game.dribble_start) / self.dribble_distance
        } else {
            0.0
        }
    }

    /// Offset from the robot to the place of the next kick, in the coordinates of its team.
    fn designated_offset(&self, robot: usize, team: Team) -> Vector {
        let Some(robot) = self.sight.robot(robot).filter(|_| !self.game.in_play) else {
            return Vector::default();
        };
        let scale = -team.own_side() / self.half_length;
        (self.game.designated_position - robot.position) * scale
    }
}

/// Place of the number that is 1 for what play is in.
fn command_feature(game: &Game, team: Team) -> usize {
    match game.command {
        Command::Halt => 0,
        Command::Stop => 1,
        Command::BallPlacement(placing) => {
            if placing == team {
                9
            } else {
                10
            }
        }
        Command::ForceStart => 2,
        Command::NormalStart | Command::DirectFree(_) if game.in_play => 2,
        command => {
            let kick = if command == Command::NormalStart { game.kick } else { Some(command) };
            match kick.and_then(|kick| kick_feature(kick, team)) {
                Some(6) => 11,
                Some(kick) => 3 + kick,
                None => 2,
            }
        }
    }
}

/// Place of a kick among the seven kinds, own ones before the opponents'.
fn kick_feature(kick: Command, team: Team) -> Option<usize> {
    let of = |kicking: Team| usize::from(kicking != team);
    match kick {
        Command::PrepareKickoff(kicking) => Some(of(kicking)),
        Command::PreparePenalty(kicking) => Some(2 + of(kicking)),
        Command::DirectFree(kicking) | Command::GoalKick(kicking) => Some(4 + of(kicking)),
        Command::ForceStart | Command::FreeBall => Some(6),
        Command::Halt | Command::Stop | Command::NormalStart | Command::BallPlacement(_) => None,
    }
}

#[allow(clippy::cast_precision_loss)] // few goals
fn number(goals: i32) -> f32 {
    goals as f32
}

#[allow(clippy::cast_precision_loss)] // few robots
fn share(count: usize, all: usize) -> f32 {
    count as f32 / all as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_command_has_a_feature_of_its_own_for_each_team() {
        let mut game = Game::new(Team::Blue);
        for (command, own, others) in [
            (Command::Halt, "halt", "halt"),
            (Command::Stop, "stop", "stop"),
            (Command::ForceStart, "in_play", "in_play"),
            (Command::PrepareKickoff(Team::Blue), "own_kickoff", "opponents_kickoff"),
            (Command::PreparePenalty(Team::Blue), "own_penalty", "opponents_penalty"),
            (Command::DirectFree(Team::Blue), "own_free_kick", "opponents_free_kick"),
            (Command::GoalKick(Team::Blue), "own_free_kick", "opponents_free_kick"),
            (Command::BallPlacement(Team::Blue), "own_placement", "opponents_placement"),
            (Command::FreeBall, "free_ball", "free_ball"),
        ] {
            game.give(command, None);
            assert_eq!(FEATURES[command_feature(&game, Team::Blue)], own, "{command:?}");
            assert_eq!(FEATURES[command_feature(&game, Team::Yellow)], others, "{command:?}");
        }
    }

    #[test]
    fn a_kick_is_shown_until_the_ball_is_in_play() {
        let mut game = Game::new(Team::Yellow);
        game.give(Command::NormalStart, None);
        assert_eq!(FEATURES[command_feature(&game, Team::Yellow)], "own_kickoff");
        game.in_play = true;
        assert_eq!(FEATURES[command_feature(&game, Team::Yellow)], "in_play");
    }

    #[test]
    fn the_kinds_of_the_next_kick_follow_those_of_the_present_one() {
        for (kick, name) in [
            (Command::PrepareKickoff(Team::Yellow), "next_opponents_kickoff"),
            (Command::DirectFree(Team::Blue), "next_own_free_kick"),
            (Command::ForceStart, "next_free_ball"),
        ] {
            let place = kick_feature(kick, Team::Blue).expect("a kick");
            assert_eq!(FEATURES[NEXT + place], name);
        }
        assert_eq!(FEATURES[MAY_TOUCH], "may_touch");
    }
}
