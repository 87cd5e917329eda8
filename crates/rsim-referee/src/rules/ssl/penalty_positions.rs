//! Positions at a penalty kick (SSL rules, "Penalty Kick", "Disrespect Procedures").

use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::positions::{is_on_goal_line, nearest_to};
use crate::rules::ssl::penalty::way_to_goal;
use crate::ruling::{Ruling, Rulings};
use crate::sight::Robot;
use crate::team::Team;

/// A robot does not keep to its position after the kick was allowed: once for each team. The rules leave the
/// sanction to people. Here the kick is decided, as by any other offense of the team, and nobody gets a card.
pub fn judge(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(attacker) = game.penalty_taker() else { return };
    let kicker = nearest_to(moment, attacker, moment.ball.position);
    for team in Team::BOTH {
        let offender = moment.now.team(team).find(|robot| {
            if robot.team != attacker && robot.index == moment.keeper(robot.team) {
                !is_kicked(game, moment) && !is_on_goal_line(moment, robot.team, robot.position)
            } else {
                Some(robot.index) != kicker && !is_behind(game, moment, robot, attacker)
            }
        });
        if let Some(robot) = offender {
            let kind = EventKind::UnsportingBehaviorMinor;
            rulings.add(Ruling::of_robot(kind, team, robot.index, robot.position));
        }
    }
}

/// Whether the ball is in play at the end of the step: then the keeper may leave its line.
fn is_kicked(game: &Game, moment: &Moment) -> bool {
    let way = moment.ball.position.distance(game.kick_position);
    game.in_play || way >= moment.config.in_play_distance
}

/// Whether the center of a robot is far enough behind the ball, as the game controller measures it. A ball that
/// comes back from the keeper is where it has been.
fn is_behind(game: &Game, moment: &Moment, robot: &Robot, attacker: Team) -> bool {
    let ball = way_to_goal(game, attacker, moment.ball.position).max(game.penalty_way);
    ball - way_to_goal(game, attacker, robot.position) >= moment.config.penalty_distance
}
