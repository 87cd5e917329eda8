//! A robot kicks too fast (SSL rules, "Ball Speed").

use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::repeats::Repeated;
use crate::rules::ssl::areas::commit;
use crate::ruling::{Ruling, Rulings};

/// The ball is faster, in three dimensions, than a robot may accelerate it.
pub fn ball_speed(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(robot) = game.last_touch.filter(|_| game.is_running()) else { return };
    let team = moment.team_of(robot);
    if moment.ball.speed() > moment.config.ball_speed
        && commit(Repeated::BallSpeed, game, moment, team)
    {
        let kind = EventKind::BotKickedBallTooFast;
        rulings.add(Ruling::of_robot(kind, team, robot, game.last_touch_position).foul());
    }
}
