//! Goals in VSSS.

use crate::codes::Command;
use crate::crossing::{Line, crossed};
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::vsss::areas::{goal_kick, penalty_kick};
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// The team that scores in the step, and where the ball crossed the line.
fn scored(game: &Game, moment: &Moment) -> Option<(Team, Vector)> {
    match crossed(moment, moment.pitch.ball_radius) {
        Some((Line::Goal(defender), position)) if game.in_play => {
            Some((defender.opponent(), position))
        }
        _ => None,
    }
}

/// A goal counts unless the team had too many attackers in the area with the ball: then it is a goal kick. If
/// the others had too many defenders too, the foul that has lasted longer decides, or else the defenders'.
pub fn goal(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((scorer, position)) = scored(game, moment) else { return };
    let defender = scorer.opponent();
    let is_defenders = game.had_defenders[defender]
        && game.defenders_steps[defender] >= game.attackers_steps[scorer];
    let (kind, (command, place)) = if !game.had_attackers[scorer] {
        (EventKind::Goal, (Command::PrepareKickoff(defender), Vector::default()))
    } else if is_defenders {
        (EventKind::InvalidGoal, penalty_kick(moment, scorer))
    } else {
        (EventKind::InvalidGoal, goal_kick(moment, defender))
    };
    let ruling = match game.last_touch {
        Some(robot) => Ruling::of_robot(kind, scorer, robot, position),
        None => Ruling::of_team(kind, Some(scorer), position),
    };
    rulings.add(ruling.stops(command, place));
}
