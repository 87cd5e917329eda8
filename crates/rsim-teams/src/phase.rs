//! Duty of a team, by the referee's command.

use rsim_referee::Team;
use rsim_referee::codes::Command;
use rsim_referee::game::Game;

/// Permission of robots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Stand still.
    Halt,
    /// Keep away from the ball and drive slowly.
    Stop,
    /// Take the positions for a kick.
    Prepare,
    /// The kick may be taken.
    Kick,
    /// The ball is placed.
    Place,
    /// The ball is in play.
    Play,
}

/// Kind of the kick with which play goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Restart {
    /// Kick-off.
    Kickoff,
    /// Penalty kick.
    Penalty,
    /// Free kick, or no kick of a team.
    Free,
}

/// Duty of a team.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Phase {
    /// Permission of robots.
    pub(crate) mode: Mode,
    /// Kind of the kick.
    pub(crate) restart: Restart,
    /// Whether the kick, or the placement, is the team's.
    pub(crate) ours: bool,
    /// Whether the team kicks after the stop or the placement.
    pub(crate) kicks_next: bool,
}

impl Phase {
    /// Duty of `team`.
    pub(crate) fn of(game: &Game, team: Team) -> Self {
        let mode = match game.command {
            Command::Halt => Mode::Halt,
            Command::Stop => Mode::Stop,
            Command::PrepareKickoff(_) | Command::PreparePenalty(_) => Mode::Prepare,
            Command::BallPlacement(_) => Mode::Place,
            Command::NormalStart if game.penalty_taker().is_some() => Mode::Kick,
            Command::NormalStart | Command::DirectFree(_) if !game.in_play => Mode::Kick,
            _ => Mode::Play,
        };
        let kick = match game.command {
            Command::Stop | Command::Halt => game.next_command,
            Command::NormalStart => game.kick,
            command => Some(command),
        };
        let restart = match kick {
            Some(Command::PrepareKickoff(_)) => Restart::Kickoff,
            Some(Command::PreparePenalty(_)) => Restart::Penalty,
            _ => Restart::Free,
        };
        let ours = kick.and_then(Command::team) == Some(team);
        let kicks_next = game.next_command == Some(Command::DirectFree(team));
        Self { mode, restart, ours, kicks_next }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Team::{Blue, Yellow};

    fn phase(command: Command, next: Option<Command>, kick: Option<Command>) -> Phase {
        let mut game = Game::new(Blue);
        game.give(command, next);
        game.kick = kick;
        Phase::of(&game, Blue)
    }

    #[test]
    fn commands_tell_what_to_do_and_whose_kick_it_is() {
        let free = Command::DirectFree(Yellow);
        let stop = phase(Command::Stop, Some(free), None);
        assert_eq!((stop.mode, stop.restart, stop.ours), (Mode::Stop, Restart::Free, false));
        let kickoff = Command::PrepareKickoff(Blue);
        let start = phase(Command::NormalStart, None, Some(kickoff));
        assert_eq!((start.mode, start.restart, start.ours), (Mode::Kick, Restart::Kickoff, true));
        let theirs = phase(free, None, Some(free));
        assert_eq!((theirs.mode, theirs.ours), (Mode::Kick, false));
        assert_eq!(phase(Command::ForceStart, None, None).mode, Mode::Play);
        let placing = phase(Command::BallPlacement(Blue), Some(free), None);
        assert_eq!((placing.mode, placing.ours), (Mode::Place, true));
    }

    #[test]
    fn a_penalty_kick_stays_one_while_the_ball_moves() {
        let mut game = Game::new(Blue);
        game.give(Command::NormalStart, None);
        game.in_play = true;
        assert_eq!(Phase::of(&game, Blue).mode, Mode::Play);
        game.kick = Some(Command::PreparePenalty(Yellow));
        let phase = Phase::of(&game, Blue);
        assert_eq!((phase.mode, phase.restart), (Mode::Kick, Restart::Penalty));
    }
}
