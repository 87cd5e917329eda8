//! Fouls, cards, and robots that are taken out (SSL rules, "Fouls", "Sanctions").

use crate::events::{Event, EventKind};
use crate::game::Game;
use crate::moment::Moment;
use crate::ruling::Ruling;
use crate::sight::Robot;
use crate::team::Team;

/// Counts a foul of a team: every third one is a card. A team without time for more yellow cards gets a red
/// one.
pub fn count_foul(game: &mut Game, moment: &Moment, ruling: &Ruling, events: &mut Vec<Event>) {
    for team in Team::BOTH {
        if ruling.event.team.is_some_and(|at_fault| at_fault != team) {
            continue;
        }
        game.fouls[team] += 1;
        if is_non_stopping(ruling.event.kind) {
            game.foul_steps[team] = 0;
        }
        if is_multiple(game.fouls[team], moment.config.fouls_per_card) {
            let event = |kind| Event { kind, team: Some(team), robot: None, ..ruling.event };
            events.push(event(EventKind::MultipleFouls));
            if give_card(game, moment, team) {
                events.push(event(EventKind::MultipleCards));
            }
        }
    }
}

/// Whether an event is one of the fouls under "Non Stopping Fouls". Fouls while the ball is out of play do not
/// stop play either, but are none of them.
pub const fn is_non_stopping(kind: EventKind) -> bool {
    matches!(
        kind,
        EventKind::AttackerTouchedBallInDefenseArea
            | EventKind::BotKickedBallTooFast
            | EventKind::BotCrashUnique
            | EventKind::BotCrashDrawn
    )
}

#[allow(clippy::cast_possible_truncation)] // a small whole number
fn is_multiple(count: i32, of: f32) -> bool {
    of >= 1.0 && count % of as i32 == 0
}

/// Gives a team a card. Returns whether it is a red one.
fn give_card(game: &mut Game, moment: &Moment, team: Team) -> bool {
    game.removal_steps_left[team] = moment.steps(moment.config.removal_seconds);
    let duration = moment.steps(moment.config.yellow_card_seconds);
    let free = game.yellow_steps_left[team].iter_mut().find(|steps| **steps == 0);
    if let Some(steps) = free {
        *steps = duration;
        game.yellow_cards[team] += 1;
        return false;
    }
    game.red_cards[team] += 1;
    true
}

/// Lets playing time of cards pass by one step.
pub fn pass_playing_time(game: &mut Game) {
    for team in Team::BOTH {
        for steps in &mut game.yellow_steps_left[team] {
            *steps = (*steps - 1).max(0);
        }
    }
}

/// Robots that the rules leave a team: those on the field and those that were taken out, less one for each
/// running card.
pub fn max_robots(game: &Game, moment: &Moment, team: Team) -> usize {
    let removed = moment.now.indices(team).filter(|robot| is_removed(game, *robot)).count();
    game.max_robots(team, moment.now.count(team) + removed)
}

/// Whether the referee has taken a robot out.
pub const fn is_removed(game: &Game, robot: usize) -> bool {
    game.removed_robots >> robot & 1 == 1
}

/// Robots that a team has too many.
pub fn too_many(game: &Game, moment: &Moment, team: Team) -> usize {
    moment.now.count(team).saturating_sub(max_robots(game, moment, team))
}

/// The robots of a team that are taken out: those farthest from the ball, and the keeper last.
pub fn taken_out(game: &Game, moment: &Moment, team: Team) -> Vec<Robot> {
    let mut robots: Vec<Robot> = moment.now.team(team).collect();
    let rank = |robot: &Robot| {
        let distance = robot.position.distance(moment.ball.position);
        (robot.index == moment.keeper(team), -distance)
    };
    robots.sort_by(|a, b| {
        let (a, b) = (rank(a), rank(b));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    robots.truncate(too_many(game, moment, team));
    robots
}

/// Lets the time pass in which a team may take its robots out. Returns whether it is over.
pub fn pass_removal_time(game: &mut Game, moment: &Moment, team: Team) -> bool {
    if too_many(game, moment, team) == 0 {
        game.removal_steps_left[team] = -1;
        return false;
    }
    game.removal_steps_left[team] = (game.removal_steps_left[team] - 1).max(0);
    game.removal_steps_left[team] == 0
}
