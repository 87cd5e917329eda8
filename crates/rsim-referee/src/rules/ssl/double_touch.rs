//! The kicker touches the ball twice (SSL rules, "Double Touch").

use crate::codes::Command;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::kick_place;
use crate::ruling::{Ruling, Rulings};

/// The robot that brought the ball into play touches it, or still touches it, before another robot does.
pub fn double_touch(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some(taker) = game.kick_taker.and_then(|robot| moment.now.robot(robot)) else { return };
    if game.in_play && taker.touched_ball {
        let place = moment.ball.position;
        let kind = EventKind::AttackerDoubleTouchedBall;
        let ruling = Ruling::of_robot(kind, taker.team, taker.index, place);
        let command = Command::DirectFree(taker.team.opponent());
        rulings.add(ruling.stops(command, kick_place(moment, place)));
    }
}
