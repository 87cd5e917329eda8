//! The course of a match: stops, and the commands with which play goes on.

use crate::ball_placement::{after_placement, awarded, begin, waits_for_robots};
use crate::codes::{Command, Stage};
use crate::column::ByTeam;
use crate::config::{HalfEnd, League, Placement};
use crate::events::EventKind;
use crate::game::Game;
use crate::kick::{after_preparation, bring_into_play};
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
    if is_stage_over(game, moment) {
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

/// Whether the time of a half is up, and play stands or may be interrupted. In SSL a penalty kick is still
/// taken; after one of VSSS play just goes on, and the league's referee does not wait for it.
fn is_stage_over(game: &Game, moment: &Moment) -> bool {
    let is_penalty = |command| matches!(command, Some(Command::PreparePenalty(_)));
    let awaits_penalty = game.penalty_taker().is_some()
        || is_penalty(Some(game.command))
        || is_penalty(game.next_command);
    game.stage.is_played()
        && game.stage_steps_left <= 0
        && !(awaits_penalty && moment.config.league == League::Ssl)
        && (moment.config.half_end == HalfEnd::AtOnce || !game.is_running())
}

/// Stops play, or decides anew how it goes on while it is stopped. A kick-off or penalty kick that is due
/// stays.
fn stop(game: &mut Game, moment: &Moment, rulings: &Rulings, then: Continuation) -> Arrangement {
    let was_running = game.is_running();
    let shootout_taker = game.penalty_taker().filter(|_| is_shootout(game));
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
    game.kick = None;
    game.forget_play();
    if is_goal && moment.config.ends_early(game) {
        return finish(game);
    }
    if let Some(taker) = shootout_taker {
        return match shootout::next(game, moment.config, taker) {
            Some(next) => prepare_penalty(game, moment, next),
            None => finish(game),
        };
    }
    if is_stage_over(game, moment) {
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
    game.wait_steps = moment.steps(moment.config.stop_seconds);
    if stage == Stage::Shootout {
        let first = game.first_kickoff;
        return prepare_penalty(game, moment, first);
    }
    let kickoff = Command::PrepareKickoff(kickoff_of(stage, game.first_kickoff));
    game.give(Command::Stop, Some(kickoff));
    game.designated_position = Vector::default();
    arranged_in_stop(moment)
}

/// Decides that the present stop is followed by a penalty kick.
fn prepare_penalty(game: &mut Game, moment: &Moment, team: Team) -> Arrangement {
    game.give(Command::Stop, Some(Command::PreparePenalty(team)));
    game.designated_position = moment.lines().penalty_mark(team);
    arranged_in_stop(moment)
}

fn finish(game: &mut Game) -> Arrangement {
    game.stage = Stage::PostGame;
    game.stage_steps_left = 0;
    game.give(Command::Halt, None);
    Arrangement::None
}

fn after_halt(game: &mut Game, moment: &Moment) -> Arrangement {
    if game.command_steps >= moment.steps(moment.config.halt_seconds) {
        game.give(Command::Stop, game.next_command);
        game.close_fouls = ByTeam::default();
    }
    Arrangement::None
}

fn after_stop(game: &mut Game, moment: &Moment) -> Arrangement {
    match game.next_command {
        Some(next)
            if game.command_steps >= game.wait_steps && !waits_for_robots(game, moment, next) =>
        {
            begin(game, moment, next)
        }
        _ => Arrangement::None,
    }
}
