//! A robot dribbles too far (SSL rules, "Excessive Dribbling").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};

/// The ball is farther from the place where the contact began than a robot may dribble. Play goes on where
/// the foul began to happen, which is that place.
pub fn excessive_dribbling(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(robot) = game.dribbler.filter(|_| game.in_play) else { return };
    let place = moment.ball.position;
    if place.distance(game.dribble_start) > moment.config.dribble_distance {
        let team = moment.team_of(robot);
        let ruling = Ruling::of_robot(EventKind::BotDribbledBallTooFar, team, robot, place).foul();
        let start = kick_place(moment, game.dribble_start);
        rulings.add(ruling.stops(Command::DirectFree(team.opponent()), start));
    }
}
