//! The course of a ball placement by robots (SSL rules, "Ball Placement").

use crate::codes::Command;
use crate::config::Placement;
use crate::events::EventKind;
use crate::flow::Arrangement;
use crate::game::Game;
use crate::kick::allow;
use crate::moment::Moment;
use crate::placing;
use crate::ruling::Rulings;
use crate::team::Team;

/// Interferences after which the referee ends a ball placement at the next one.
const MAX_INTERFERENCES: f32 = 3.0;

/// The command of a stop. A team that has failed to place the ball too often gets no free kick for a ball
/// that left the field ("Ball Placement").
pub(crate) fn awarded(
    game: &Game,
    moment: &Moment,
    rulings: &Rulings,
    command: Command,
) -> Command {
    let is_ball_out = rulings.has(EventKind::BallLeftFieldTouchLine)
        || rulings.has(EventKind::BallLeftFieldGoalLine)
        || rulings.has(EventKind::AimlessKick);
    match command {
        Command::DirectFree(team)
            if is_ball_out
                && moment.config.placement == Placement::Robots
                && !may_place(game, moment, team)
                && may_place(game, moment, team.opponent()) =>
        {
            Command::DirectFree(team.opponent())
        }
        command => command,
    }
}

/// Whether a team may place the ball.
#[allow(clippy::cast_precision_loss)] // few failures
fn may_place(game: &Game, moment: &Moment, team: Team) -> bool {
    (game.placement_failures[team] as f32) < moment.config.placement_failures
}

/// Whether robots still have time to leave a ball that needs no placement.
pub(crate) fn waits_for_robots(game: &Game, moment: &Moment, next: Command) -> bool {
    let most = game.wait_steps + moment.steps(moment.config.max_prepare_seconds);
    is_placed_by_robots(moment, next)
        && !needs_placement(game, moment)
        && game.command_steps < most
        && !placing::is_arranged(game, moment, moment.ball.position)
}

/// Whether robots place the ball before a command.
fn is_placed_by_robots(moment: &Moment, next: Command) -> bool {
    moment.config.placement == Placement::Robots
        && matches!(next, Command::DirectFree(_) | Command::ForceStart)
}

/// Begins the command with which play goes on, or the ball placement before it.
pub(crate) fn begin(game: &mut Game, moment: &Moment, next: Command) -> Arrangement {
    if !is_placed_by_robots(moment, next) {
        allow(game, moment, next);
        return Arrangement::All;
    }
    if !needs_placement(game, moment) {
        game.designated_position = moment.ball.position;
        allow(game, moment, next);
        return Arrangement::Robots;
    }
    let Some(team) = placing_team(game, moment, next) else {
        allow(game, moment, next);
        return Arrangement::All;
    };
    game.give(Command::BallPlacement(team), Some(next));
    game.wait_steps = moment.steps(moment.config.placement_seconds);
    game.has_interfered = false;
    game.interference_steps = 0;
    Arrangement::Robots
}

/// Whether the ball has to be placed ("Ball Placement").
fn needs_placement(game: &Game, moment: &Moment) -> bool {
    let (config, lines, ball) = (moment.config, moment.lines(), moment.ball);
    let from_areas = Team::BOTH.map(|team| lines.distance_to_area(ball.position, team));
    ball.position.distance(game.designated_position) >= config.placement_distance
        || !lines.is_inside(ball.position, 0.0)
        || from_areas[0].min(from_areas[1]) < config.placement_area_distance
        || ball.speed() >= config.stuck_speed
}

/// The team that places the ball: the one in favor, or for a force start the teams in turns, first the one
/// that had the first kick-off. After it has failed the others try. `None` where the referee places it.
fn placing_team(game: &mut Game, moment: &Moment, next: Command) -> Option<Team> {
    let failed = Team::BOTH.into_iter().find(|team| game.has_failed_placement[*team]);
    if let Some(failed) = failed {
        return Some(failed.opponent()).filter(|team| may_place(game, moment, *team));
    }
    if let Some(favored) = next.team() {
        return Some(favored).filter(|team| may_place(game, moment, *team));
    }
    game.neutral_placements += 1;
    let first = if game.neutral_placements % 2 == 1 {
        game.first_kickoff
    } else {
        game.first_kickoff.opponent()
    };
    [first, first.opponent()].into_iter().find(|team| may_place(game, moment, *team))
}

pub(crate) fn after_placement(
    game: &mut Game,
    moment: &Moment,
    rulings: &Rulings,
    placing: Team,
) -> Arrangement {
    let Some(next) = game.next_command else { return Arrangement::None };
    if rulings.has(EventKind::PlacementSucceeded) {
        game.placement_failures[placing] = (game.placement_failures[placing] - 1).max(0);
        game.designated_position = moment.ball.position;
        allow(game, moment, next);
        return Arrangement::Robots;
    }
    if is_hopeless(game, moment) {
        allow(game, moment, next);
        return Arrangement::All;
    }
    if !rulings.has(EventKind::PlacementFailed) {
        return Arrangement::None;
    }
    game.placement_failures[placing] += 1;
    game.has_failed_placement[placing] = true;
    let both_failed = game.has_failed_placement[placing.opponent()];
    let passes = moment.config.failed_placement_passes && next == Command::DirectFree(placing);
    // After both have failed the original command is given: the kick comes back to the team in favor.
    let next = if passes { Command::DirectFree(placing.opponent()) } else { next };
    if both_failed {
        allow(game, moment, next);
        return Arrangement::All;
    }
    game.give(Command::Stop, Some(next));
    game.wait_steps = moment.steps(moment.config.stop_seconds);
    Arrangement::Robots
}

/// Whether the others have interfered so often that the referee places the ball ("Ball Placement
/// Interference", last note).
fn is_hopeless(game: &Game, moment: &Moment) -> bool {
    let config = moment.config;
    let seconds = config.placement_seconds + MAX_INTERFERENCES * config.interference_seconds;
    game.wait_steps > moment.steps(seconds)
}
