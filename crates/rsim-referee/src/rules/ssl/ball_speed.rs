//! A robot kicks too fast (SSL rules, "Ball Speed").

use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::repeats::Repeated;
use crate::rules::ssl::areas::commit;
use crate::ruling::{Ruling, Rulings};

/// A robot makes the ball faster, in three dimensions, than it may: right after its touch, since the ball is slower
/// at the end of the step. One that only slows a fast ball down is not at fault.
pub fn ball_speed(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(robot) = moment.toucher().filter(|_| game.is_running()) else { return };
    let (team, speed) = (robot.team, moment.ball.speed_after_touch);
    if speed > moment.config.ball_speed
        && speed > moment.ball_before.speed()
        && commit(Repeated::BallSpeed, game, moment, team)
    {
        let kind = EventKind::BotKickedBallTooFast;
        rulings.add(Ruling::of_robot(kind, team, robot.index, game.last_touch_position).foul());
    }
}
