//! A kick from its permission until the ball is in play (SSL rules, "Resuming The Game", "Ball In And Out Of
//! Play").

use crate::codes::Command;
use crate::column::ByTeam;
use crate::config::League;
use crate::flow::Arrangement;
use crate::game::Game;
use crate::moment::Moment;
use crate::placing;

/// Gives a command that prepares or allows a kick.
pub(crate) fn allow(game: &mut Game, moment: &Moment, command: Command) {
    game.forget_play();
    game.fast_robots = 0;
    game.has_failed_placement = ByTeam::default();
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

pub(crate) fn after_preparation(game: &mut Game, moment: &Moment) -> Arrangement {
    let [least, most] = [moment.config.prepare_seconds, moment.config.max_prepare_seconds]
        .map(|seconds| moment.steps(seconds));
    let is_over = game.command_steps >= most;
    let is_ready =
        game.command_steps >= least && placing::is_arranged(game, moment, game.designated_position);
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
pub(crate) fn bring_into_play(game: &mut Game, moment: &Moment) -> Arrangement {
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
}
