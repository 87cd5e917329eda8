//! Goals in VSSS.

use crate::codes::Command;
use crate::crossing::{Line, crossed};
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::areas::goal_kick;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// The team that scores in the step, and where the ball crossed the line.
pub(crate) fn scored(game: &Game, moment: &Moment) -> Option<(Team, Vector)> {
    match crossed(moment, moment.pitch.ball_radius) {
        Some((Line::Goal(defender), position)) if game.in_play => {
            Some((defender.opponent(), position))
        }
        _ => None,
    }
}

/// A goal counts unless the team had too many attackers in the area with the ball, and the others had not
/// too many defenders: then it is a goal kick.
pub fn goal(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((scorer, position)) = scored(game, moment) else { return };
    let defender = scorer.opponent();
    let is_invalid = game.had_attackers[scorer] && !game.had_defenders[defender];
    let kind = if is_invalid { EventKind::InvalidGoal } else { EventKind::Goal };
    let ruling = match game.last_touch {
        Some(robot) => Ruling::of_robot(kind, scorer, robot, position),
        None => Ruling::of_team(kind, Some(scorer), position),
    };
    rulings.add(if is_invalid {
        let (command, place) = goal_kick(moment, defender);
        ruling.stops(command, place)
    } else {
        ruling.stops(Command::PrepareKickoff(defender), Vector::default())
    });
}
