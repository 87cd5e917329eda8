//! Line-ups of kick-offs: where robots stand before a match begins.

use crate::config::League;
use crate::formation;
use crate::game::Game;
use crate::moment::Moment;
use crate::sight::Placed;
use crate::team::Team;
use crate::vector::Vector;

/// Positions of an SSL team at a kick-off, as shares of half the field's length and of half its width, with
/// the own goal at 1: keeper, kicker, then the others. They are outside the center circle and the own area in
/// both divisions.
const SSL: [(f32, f32); 11] = [
    (0.95, 0.0),
    (0.18, 0.0),
    (0.5, 0.25),
    (0.5, -0.25),
    (0.2, 0.5),
    (0.2, -0.5),
    (0.68, 0.55),
    (0.68, -0.55),
    (0.42, 0.65),
    (0.42, -0.65),
    (0.35, 0.0),
];

/// Positions of all robots that are present, for a kick-off.
pub(crate) fn kickoff(game: &Game, moment: &Moment) -> Vec<Placed> {
    match moment.config.league {
        League::Vsss => vsss(game, moment),
        League::Ssl => Team::BOTH.into_iter().flat_map(|team| ssl(moment, team)).collect(),
    }
}

fn vsss(game: &Game, moment: &Moment) -> Vec<Placed> {
    let (ball, robots) = (game.designated_position, moment.now.robots().collect::<Vec<_>>());
    let places = formation::places(game, moment, ball, &robots).into_iter();
    places.map(|(robot, position)| Placed { robot, position, faces: Some(ball) }).collect()
}

fn ssl(moment: &Moment, team: Team) -> Vec<Placed> {
    let lines = moment.lines();
    let side = team.own_side();
    let robots = moment.now.team(team).zip(SSL);
    let placed = robots.map(|(robot, (ahead, aside))| Placed {
        robot: robot.index,
        position: Vector::new(side * ahead * lines.half_length, -side * aside * lines.half_width),
        faces: Some(Vector::default()),
    });
    placed.collect()
}
