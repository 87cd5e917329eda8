//! The course of a match: stops, and the commands with which play goes on.

use crate::codes::{Command, Stage};
use crate::column::ByTeam;
use crate::config::{HalfEnd, League, Placement};
use crate::events::EventKind;
use crate::game::Game;
use crate::moment::Moment;
use crate::ruling::{Continuation, Rulings};
use crate::shootout;
use crate::stages::{is_shootout, kickoff_of};
use crate::team::Team;
use crate::vector::Vector;

/// Change of the bodies by the referee at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Arrangement {
    /// Nothing.
    None,
    /// Robots are taken out or come back; others stay.
    Robots,
    /// The ball comes to its place, and robots in forbidden places to valid ones.
    All,
}

/// Brings a match on by one step, after all rules have judged it.
pub(crate) fn advance(game: &mut Game, moment: &Moment, rulings: &Rulings) -> Arrangement {
    pass_time(game, moment);
    if let Some(then) = rulings.stop() {
        return stop(game, moment, rulings, then);
    }
    let is_time_up = game.stage.is_played() && game.stage_steps_left <= 0;
    if is_time_up && moment.config.half_end == HalfEnd::AtOnce && game.penalty_taker().is_none() {
        return end_stage(game, moment);
    }
    match game.command {
        Command::Halt => after_halt(game, moment),
        Command::Stop => after_stop(game, moment),
        Command::BallPlacement(team) => after_placement(game, moment, rulings, team),
        Command::PrepareKickoff(_)
        | Command::PreparePenalty(_)
        | Command::FreeBall
        | Command::GoalKick(_) => after_preparation(game, moment),
        Command::NormalStart | Command::DirectFree(_) => bring_into_play(game, moment),
        Command::ForceStart => Arrangement::None,
    }
}

/// Lets playing time pass.
fn pass_time(game: &mut Game, moment: &Moment) {
    if moment.config.counts(game) {
        game.stage_steps_left -= 1;
        crate::cards::pass_playing_time(game);
    }
}

/// Stops play, or decides anew how it goes on while it is stopped. A kick-off or penalty kick that is due
/// stays.
fn stop(game: &mut Game, moment: &Moment, rulings: &Rulings, then: Continuation) -> Arrangement {
    let was_running = game.is_running();
    let is_due = !was_running
        && matches!(
            game.next_command,
            Some(Command::PrepareKickoff(_) | Command::PreparePenalty(_))
        );
    let is_goal = rulings.has(EventKind::Goal);
    if is_goal {
        count_goal(game, rulings);
    }
    if !is_due {
        game.next_command = Some(awarded(game, moment, rulings, then.command));
        game.designated_position = then.position;
    }
    let is_halted = Team::BOTH.iter().any(|team| game.close_fouls[*team] >= 2);
    let command = if is_halted { Command::Halt } else { Command::Stop };
    game.give(command, game.next_command);
    let seconds =
        if is_goal { moment.config.goal_stop_seconds } else { moment.config.stop_seconds };
    game.wait_steps = moment.steps(seconds);
    let was_penalty = matches!(game.kick, Some(Command::PreparePenalty(_)));
    let shootout_kick = (was_running && was_penalty && is_shootout(game)).then_some(game.kick);
    game.kick = None;
    game.forget_play();
    if was_running {
        game.fast_robots = 0;
    }
    if is_goal && moment.config.ends_early(game) {
        return finish(game);
    }
    if let Some(Some(Command::PreparePenalty(taker))) = shootout_kick {
        return match shootout::next(game, moment.config, taker) {
            Some(next) => prepare_penalty(game, moment, next),
            None => finish(game),
        };
    }
    let is_time_up = game.stage.is_played() && game.stage_steps_left <= 0;
    if is_time_up && !matches!(game.next_command, Some(Command::PreparePenalty(_))) {
        return end_stage(game, moment);
    }
    arranged_in_stop(moment)
}

/// In a stop robots are put in valid places where the ball is teleported; in VSSS they are when the next
/// command is given.
fn arranged_in_stop(moment: &Moment) -> Arrangement {
    let is_teleported = moment.config.placement == Placement::Teleport;
    if moment.config.league == League::Ssl && is_teleported {
        Arrangement::All
    } else {
        Arrangement::Robots
    }
}

fn count_goal(game: &mut Game, rulings: &Rulings) {
    let goals = rulings.iter().filter(|ruling| ruling.event.kind == EventKind::Goal);
    for team in goals.filter_map(|ruling| ruling.event.team) {
        game.score[team] += 1;
    }
}

/// The command of a stop. A team that has failed to place the ball too often gets no free kick for a ball
/// that left the field ("Ball Placement").
fn awarded(game: &Game, moment: &Moment, rulings: &Rulings, command: Command) -> Command {
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
        && !game.has_failed_placement[team]
}

/// Ends a stage whose time is up.
fn end_stage(game: &mut Game, moment: &Moment) -> Arrangement {
    let is_draw = game.score[Team::Blue] == game.score[Team::Yellow];
    let stage = moment.config.after(game.stage, is_draw);
    game.kick = None;
    game.forget_play();
    if stage == Stage::PostGame {
        return finish(game);
    }
    game.stage = stage;
    game.stage_steps_left = 0;
    game.placement_failures = ByTeam::default(); // "for the rest of the game half"
    if stage == Stage::Shootout {
        let first = game.first_kickoff;
        return prepare_penalty(game, moment, first);
    }
    let kickoff = Command::PrepareKickoff(kickoff_of(stage, game.first_kickoff));
    game.give(Command::Stop, Some(kickoff));
    game.designated_position = Vector::default();
    game.wait_steps = moment.steps(moment.config.stop_seconds);
    arranged_in_stop(moment)
}

fn prepare_penalty(game: &mut Game, moment: &Moment, team: Team) -> Arrangement {
    game.give(Command::Stop, Some(Command::PreparePenalty(team)));
    game.designated_position = moment.lines().penalty_mark(team);
    game.wait_steps = moment.steps(moment.config.stop_seconds);
    arranged_in_stop(moment)
}

fn finish(game: &mut Game) -> Arrangement {
    game.stage = Stage::PostGame;
    game.stage_steps_left = 0;
    game.give(Command::Halt, None);
    Arrangement::None
}

fn after_halt(game: &mut Game, moment: &Moment) -> Arrangement {
    let is_over = game.stage == Stage::PostGame;
    if !is_over && game.command_steps >= moment.steps(moment.config.halt_seconds) {
        game.give(Command::Stop, game.next_command);
        game.close_fouls = ByTeam::default();
    }
    Arrangement::None
}

fn after_stop(game: &mut Game, moment: &Moment) -> Arrangement {
    match game.next_command {
        Some(next) if game.command_steps >= game.wait_steps => begin(game, moment, next),
        _ => Arrangement::None,
    }
}

/// Begins the command with which play goes on, or the ball placement before it.
fn begin(game: &mut Game, moment: &Moment, next: Command) -> Arrangement {
    let by_robots = moment.config.placement == Placement::Robots;
    let is_placed_by_robots =
        by_robots && matches!(next, Command::DirectFree(_) | Command::ForceStart);
    if !is_placed_by_robots {
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

/// The team that places the ball: the one in favor, or for a force start the teams in turns, unless it has
/// failed. `None` if no team may.
fn placing_team(game: &mut Game, moment: &Moment, next: Command) -> Option<Team> {
    let first = next.team().unwrap_or_else(|| {
        game.neutral_placements += 1;
        if game.neutral_placements % 2 == 1 { Team::Blue } else { Team::Yellow }
    });
    [first, first.opponent()].into_iter().find(|team| may_place(game, moment, *team))
}

fn after_placement(
    game: &mut Game,
    moment: &Moment,
    rulings: &Rulings,
    placing: Team,
) -> Arrangement {
    let Some(next) = game.next_command else { return Arrangement::None };
    if rulings.has(EventKind::PlacementSucceeded) {
        game.placement_failures[placing] = (game.placement_failures[placing] - 1).max(0);
        allow(game, moment, next);
        return Arrangement::Robots;
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

/// Gives a command that prepares or allows a kick.
fn allow(game: &mut Game, moment: &Moment, command: Command) {
    game.forget_play();
    game.kick = Some(command);
    game.kick_position = game.designated_position;
    let is_prepared = matches!(
        command,
        Command::PrepareKickoff(_)
            | Command::PreparePenalty(_)
            | Command::FreeBall
            | Command::GoalKick(_)
    );
    game.give(command, is_prepared.then_some(Command::NormalStart));
    if command == Command::ForceStart {
        put_in_play(game);
    }
    start_stage(game, moment, is_prepared);
}

/// Begins the half that a kick-off opens, once it may be taken.
fn start_stage(game: &mut Game, moment: &Moment, is_prepared: bool) {
    let stage = moment.config.after(game.stage, false);
    let is_before = !game.stage.is_played() && stage.is_played();
    if is_before && !is_prepared {
        game.stage = stage;
        game.stage_steps_left = moment.steps(moment.config.seconds(stage));
    }
}

fn after_preparation(game: &mut Game, moment: &Moment) -> Arrangement {
    let [least, most] = [moment.config.prepare_seconds, moment.config.max_prepare_seconds]
        .map(|seconds| moment.steps(seconds));
    let is_over = game.command_steps >= most;
    let is_ready = game.command_steps >= least && crate::placing::is_arranged(game, moment);
    if !is_over && !is_ready {
        return Arrangement::None;
    }
    game.give(Command::NormalStart, None);
    game.kick_position = game.designated_position;
    start_stage(game, moment, false);
    if moment.config.league == League::Vsss {
        put_in_play(game);
    }
    Arrangement::All
}

/// Brings the ball into play, once it has moved or the time to kick is over ("Ball In And Out Of Play").
fn bring_into_play(game: &mut Game, moment: &Moment) -> Arrangement {
    let Some(kicking) = game.kicking_team() else { return Arrangement::None };
    let way = moment.ball.position.distance(game.kick_position);
    let limit = match game.kick {
        Some(Command::PreparePenalty(_)) => f32::INFINITY, // it ends after its time
        Some(Command::PrepareKickoff(_)) => moment.config.kickoff_seconds,
        _ => moment.config.free_kick_seconds,
    };
    if way >= moment.config.in_play_distance {
        let is_penalty = game.penalty_taker().is_some();
        let taker = game.last_touch.filter(|robot| moment.team_of(*robot) == kicking);
        put_in_play(game);
        game.kick_taker = taker.filter(|_| !is_penalty);
    } else if limit.is_finite() && game.command_steps >= moment.steps(limit) {
        put_in_play(game);
    }
    Arrangement::None
}

fn put_in_play(game: &mut Game) {
    game.in_play = true;
    game.close_fouls = ByTeam::default();
    game.close_steps = ByTeam::default();
    game.has_failed_placement = ByTeam::default();
}
