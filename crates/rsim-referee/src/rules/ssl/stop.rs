//! Robots in a stop (SSL rules, "Robot Stop Speed", "Robot Too Close To Opponent Defense Area").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};
use crate::sight::Robot;
use crate::team::Team;

/// A robot is too fast in a stop, after the time to slow down: once for each robot and stop.
pub fn too_fast(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let grace = moment.steps(moment.config.grace_seconds);
    if game.command != Command::Stop || game.command_steps <= grace {
        return;
    }
    for robot in moment.now.robots() {
        let bit = 1 << robot.index;
        let is_new = game.fast_robots & bit == 0;
        if is_new && robot.velocity.length() > moment.config.stop_speed {
            game.fast_robots |= bit;
            let kind = EventKind::BotTooFastInStop;
            rulings.add(Ruling::of_robot(kind, robot.team, robot.index, robot.position).foul());
        }
    }
}

/// A robot stays too close to the opponents' area, in a stop or before a free kick. Play goes on with a free
/// kick of the opponents; after the second foul of a team it is halted first.
pub fn too_close_to_area(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let is_judged = game.command == Command::Stop
        || matches!(game.command, Command::DirectFree(_)) && !game.in_play;
    let grace = moment.steps(moment.config.grace_seconds);
    for team in Team::BOTH {
        let offender =
            moment.now.team(team).filter(|_| is_judged).find(|robot| is_close(moment, robot));
        let Some(robot) = offender else {
            game.close_steps[team] = 0;
            continue;
        };
        game.close_steps[team] += 1;
        if game.close_steps[team] > grace {
            game.close_steps[team] = 0;
            game.close_fouls[team] += 1;
            let kind = EventKind::AttackerTooCloseToDefenseArea;
            let ruling = Ruling::of_robot(kind, team, robot.index, robot.position).foul();
            let place = kick_place(moment, moment.ball.position);
            rulings.add(ruling.stops(Command::DirectFree(team.opponent()), place));
        }
    }
}

fn is_close(moment: &Moment, robot: &Robot) -> bool {
    let distance = moment.lines().distance_to_area(robot.position, robot.team.opponent());
    distance - moment.pitch.robot_radius < moment.config.area_distance
}
