//! Invariants of the course of all matches: commands, score and clock.

use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::{Clock, Placement};
use rsim_referee::events::EventKind::Goal;
use rsim_referee::game::Game;

use crate::scene::{Scene, Side};

/// Commands and the ones after them are those of the diagram "Game States".
pub(crate) fn check_pair(scene: &Scene) {
    let game = &scene.game;
    let is_kick = |next: Option<Command>| {
        matches!(
            next,
            Some(
                Command::PrepareKickoff(_)
                    | Command::PreparePenalty(_)
                    | Command::DirectFree(_)
                    | Command::ForceStart
            )
        )
    };
    let next = game.next_command;
    let is_legal = match game.command {
        Command::Halt => next.is_none() == (game.stage == Stage::PostGame),
        Command::Stop => is_kick(next),
        Command::BallPlacement(_) => {
            scene.referee.config().placement == Placement::Robots
                && matches!(next, Some(Command::DirectFree(_) | Command::ForceStart))
        }
        Command::PrepareKickoff(_) | Command::PreparePenalty(_) => {
            next == Some(Command::NormalStart)
        }
        Command::NormalStart | Command::DirectFree(_) | Command::ForceStart => next.is_none(),
        Command::FreeBall | Command::GoalKick(_) => false,
    };
    assert!(is_legal, "{game:?}");
    assert!(!game.in_play || game.is_running(), "{game:?}");
}

/// Commands follow each other as in the diagram.
pub(crate) fn check_change(before: &Game, now: &Game) {
    use Command::{
        BallPlacement, DirectFree, ForceStart, Halt, NormalStart, PrepareKickoff, PreparePenalty,
        Stop,
    };
    let is_legal = match (before.command, now.command) {
        (from, to) if from == to => true,
        (Halt, to) => to == Stop,
        (Stop, Halt | BallPlacement(_)) => true,
        (Stop, to) | (BallPlacement(_), to @ (DirectFree(_) | ForceStart)) => {
            Some(to) == before.next_command || to == Stop || matches!(to, DirectFree(_))
        }
        (PrepareKickoff(_) | PreparePenalty(_), to) => to == NormalStart || to == Stop,
        (_, to) => matches!(to, Stop | Halt),
    };
    assert!(is_legal, "{:?} {:?} {:?}", before.command, before.next_command, now.command);
    let is_due = |game: &Game| {
        matches!(game.next_command, Some(PrepareKickoff(_) | PreparePenalty(_)))
            && game.command == Stop
    };
    if is_due(before) && now.command == Stop && before.stage == now.stage {
        assert_eq!(before.next_command, now.next_command, "a due kick stays");
        assert_eq!(before.designated_position, now.designated_position);
    }
}

/// The score is the number of goals.
pub(crate) fn check_score(before: &Game, scene: &Scene) {
    for side in Side::BOTH {
        let goals = scene.events().iter().filter(|e| e.kind == Goal && e.side == Some(side));
        let team = scene.team(side);
        let more = i32::try_from(goals.count()).expect("few");
        assert_eq!(scene.game.score[team], before.score[team] + more);
    }
    assert!(scene.count_of(Goal) <= 1);
}

/// The clock counts each step in which a team may play the ball, or all of a half.
pub(crate) fn check_clock(before: &Game, scene: &Scene) {
    let now = &scene.game;
    if before.stage != now.stage || !now.stage.is_played() {
        return;
    }
    let is_running = scene.referee.config().clock == Clock::Running;
    let counts = is_running || before.is_running();
    assert_eq!(before.stage_steps_left - now.stage_steps_left, i32::from(counts), "{before:?}");
}
