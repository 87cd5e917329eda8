//! The ball is kicked over the walls (SSL rules, "Boundary Crossing").

use crate::codes::Command;
use crate::crossing::Line;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::ball_out::line_crossed;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};
use crate::sight::Ball;

/// Acceleration of free fall, m/s².
const GRAVITY: f32 = 9.81;

/// A ball that flies over a line will fly over the wall behind it, too. It is judged at the line, where play
/// stops: the simulator's walls have no top, and a teleported ball never reaches them.
pub fn boundary_crossing(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((line, position)) = line_crossed(game, moment) else { return };
    let Some(robot) = game.last_touch.filter(|_| !rulings.has(EventKind::Goal)) else { return };
    let (ball, lines) = (moment.ball, moment.lines());
    let (place, speed, wall) = match line {
        Line::Touch => (ball.position.y, ball.velocity.y, lines.boundary_y),
        Line::End(_) => (ball.position.x, ball.velocity.x, lines.boundary_x),
        Line::Goal(_) => return, // its back stops the ball, where no goal counts too
    };
    let seconds = (wall - place.abs()).max(0.0) / speed.abs();
    if height_after(&ball, seconds) > moment.config.boundary_height {
        let team = moment.team_of(robot);
        let ruling = Ruling::of_robot(EventKind::BoundaryCrossing, team, robot, position).foul();
        let command = Command::DirectFree(team.opponent());
        rulings.add(ruling.stops(command, kick_place(moment, position)));
    }
}

/// Height of a flying ball after a time, m; negative after it has met the floor.
fn height_after(ball: &Ball, seconds: f32) -> f32 {
    ball.height + (ball.vertical_velocity - GRAVITY / 2.0 * seconds) * seconds
}
