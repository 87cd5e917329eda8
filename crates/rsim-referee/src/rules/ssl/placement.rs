//! Ball placement by robots (SSL rules, "Ball Placement", "Ball Placement Interference").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;

/// The team that places the ball.
const fn placing_team(game: &Game) -> Option<Team> {
    match game.command {
        Command::BallPlacement(team) => Some(team),
        _ => None,
    }
}

/// A robot of the others stays in the way, which is a stadium around the line from the ball to its place:
/// the team gets more time. The first time in a placement is a foul.
pub fn interference(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(placing) = placing_team(game) else { return };
    let (ball, place) = (moment.ball.position, game.designated_position);
    let reach = moment.config.ball_distance + moment.pitch.robot_radius;
    let in_the_way = moment
        .now
        .team(placing.opponent())
        .find(|robot| robot.position.distance_to_segment(ball, place) < reach);
    let Some(robot) = in_the_way else {
        game.interference_steps = 0;
        return;
    };
    game.interference_steps += 1;
    if game.interference_steps > moment.steps(moment.config.grace_seconds) {
        game.interference_steps = 0;
        game.wait_steps += moment.steps(moment.config.interference_seconds);
        let kind = EventKind::BotInterferedPlacement;
        let ruling = Ruling::of_robot(kind, robot.team, robot.index, robot.position);
        rulings.add(if game.has_interfered { ruling } else { ruling.foul() });
        game.has_interfered = true;
    }
}

/// The ball rests at its place, and the robots have left it.
pub fn succeeded(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(placing) = placing_team(game) else { return };
    let ball = moment.ball;
    let is_early = game.command_steps < moment.steps(moment.config.min_placement_seconds);
    let is_placed = ball.speed() < moment.config.stuck_speed
        && ball.position.distance(game.designated_position) < moment.config.placement_tolerance;
    if is_early || !is_placed || !is_clear(game, moment, placing) {
        return;
    }
    rulings.add(Ruling::of_team(EventKind::PlacementSucceeded, Some(placing), ball.position));
}

/// Whether all robots keep their distance from the placed ball: a short one of the team that kicks next.
fn is_clear(game: &Game, moment: &Moment, placing: Team) -> bool {
    let kicks_next = game.next_command == Some(Command::DirectFree(placing));
    let least =
        if kicks_next { moment.config.placement_clearance } else { moment.config.ball_distance };
    let ball = moment.ball.position;
    moment
        .now
        .robots()
        .all(|robot| moment.hull_distance(&robot, ball) - moment.pitch.ball_radius >= least)
}

/// The time of the placement is over.
pub fn failed(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(placing) = placing_team(game) else { return };
    if game.command_steps >= game.wait_steps && !rulings.has(EventKind::PlacementSucceeded) {
        let kind = EventKind::PlacementFailed;
        rulings.add(Ruling::of_team(kind, Some(placing), moment.ball.position));
    }
}
