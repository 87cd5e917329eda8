//! A robot is too close to the opponents' kick (SSL rules, "Defender Too Close To Ball").

use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::repeats::Repeated;
use crate::rules::ssl::areas::commit;
use crate::ruling::{Ruling, Rulings};

/// A robot of the others is too close to the ball before a kick-off or a free kick. The team that kicks gets
/// its time again.
pub fn defender_too_close(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(kicking) = game.kicking_team().filter(|_| game.penalty_taker().is_none()) else {
        return;
    };
    let ball = moment.ball.position;
    let too_close = moment
        .now
        .team(kicking.opponent())
        .find(|robot| moment.hull_distance(robot, ball) < moment.config.ball_distance);
    let Some(robot) = too_close else { return };
    if commit(Repeated::KickPoint, game, moment, robot.team) {
        game.command_steps = 0;
        let kind = EventKind::DefenderTooCloseToKickPoint;
        rulings.add(Ruling::of_robot(kind, robot.team, robot.index, robot.position).foul());
    }
}
