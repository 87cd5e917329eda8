//! The ball makes no progress (SSL rules, "No Progress In Game").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};

/// The ball has hardly moved for a time in which both teams might have played it.
pub fn no_progress(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let is_judged = game.in_play && game.penalty_taker().is_none();
    if is_judged && game.stuck_steps > moment.steps(moment.config.no_progress_seconds) {
        let place = moment.ball.position;
        let ruling = Ruling::of_team(EventKind::NoProgressInGame, None, place);
        rulings.add(ruling.stops(Command::ForceStart, kick_place(moment, place)));
    }
}
