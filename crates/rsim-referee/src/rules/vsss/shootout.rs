//! Penalty kicks of the shoot-out in VSSS.

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::areas::penalty_kick;
use crate::rules::vsss::in_large_area;
use crate::rules::vsss::stuck_ball::is_stuck;
use crate::ruling::{Ruling, Rulings};
use crate::stages::is_shootout;

/// A penalty kick of the shoot-out ends without a goal: the ball comes back to the own half, leaves the area
/// after it was in it, or is stuck, or the time is over.
pub fn conclude(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(Command::PreparePenalty(taker)) = game.kick else { return };
    if !is_shootout(game) || !game.in_play || rulings.has(EventKind::Goal) {
        return;
    }
    let ball = moment.ball.position;
    let came_back = taker.own_side() * ball.x > 0.0;
    let [was_inside, is_inside] = [moment.ball_before, moment.ball]
        .map(|ball| in_large_area(moment, ball.position, taker.opponent()));
    let is_over = game.command_steps >= moment.steps(moment.config.penalty_seconds);
    if came_back || was_inside && !is_inside || is_stuck(game, moment) || is_over {
        let ruling = Ruling::of_team(EventKind::PenaltyKickFailed, Some(taker), ball);
        let (command, place) = penalty_kick(moment, taker.opponent());
        rulings.add(ruling.stops(command, place));
    }
}
