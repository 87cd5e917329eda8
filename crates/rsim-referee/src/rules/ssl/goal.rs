//! Goals, and what speaks against them (SSL rules, "Scoring Goals").

use crate::cards;
use crate::codes::Command;
use crate::crossing::Line;
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::rules::ssl::ball_out::line_crossed;
use crate::ruling::{Ruling, Rulings};
use crate::team::Team;
use crate::vector::Vector;

/// The team that scores in the step, and where the ball crossed the line.
fn scored(game: &Game, moment: &Moment) -> Option<(Team, Vector)> {
    match line_crossed(game, moment) {
        Some((Line::Goal(defender), position)) => Some((defender.opponent(), position)),
        _ => None,
    }
}

/// A goal that does not count: the ball was too high after the last touch of the scoring team, the team has
/// too many robots, or has committed a foul that did not stop play, before or in the step. A penalty kick has
/// other rules.
pub fn invalid_goal(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((scorer, position)) = scored(game, moment) else { return };
    if game.penalty_taker().is_some() {
        return;
    }
    let too_high = game.height_since_touch[scorer] > moment.config.goal_height;
    let too_many = cards::too_many(game, moment, scorer) > 0;
    let foul_limit = moment.steps(moment.config.goal_foul_seconds);
    let had_foul = (0..foul_limit).contains(&game.foul_steps[scorer])
        || rulings.iter().any(|ruling| {
            cards::is_non_stopping(ruling.event.kind)
                && ruling.event.team.is_none_or(|at_fault| at_fault == scorer)
        });
    if too_high || too_many || had_foul {
        rulings.add(of_scorer(EventKind::InvalidGoal, scorer, game, position));
    }
}

/// A goal for the team that attacks it, with any robot as the last toucher.
pub fn goal(game: &mut Game, moment: &Moment, rulings: &mut Rulings) {
    let Some((scorer, position)) = scored(game, moment) else { return };
    if !rulings.has(EventKind::InvalidGoal) {
        rulings.add(awarded(scorer, game, position));
    }
}

/// A goal for a team, and the kick-off of the others.
pub(crate) fn awarded(scorer: Team, game: &Game, position: Vector) -> Ruling {
    let kickoff = Command::PrepareKickoff(scorer.opponent());
    of_scorer(EventKind::Goal, scorer, game, position).stops(kickoff, Vector::default())
}

fn of_scorer(kind: EventKind, scorer: Team, game: &Game, position: Vector) -> Ruling {
    match game.last_touch {
        Some(robot) => Ruling::of_robot(kind, scorer, robot, position),
        None => Ruling::of_team(kind, Some(scorer), position),
    }
}
