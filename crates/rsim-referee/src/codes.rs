//! Commands, stages and kinds of events, with the numbers of the SSL game controller.
//!
//! Source: the enumerations `Referee.Command`, `Referee.Stage` and `GameEvent.Type` of the game
//! controller's messages (78a9b3b, 2026-08-03). Commands from 100 and events from 1000 are not the
//! game controller's: VSSS has no such numbers.

use crate::team::Team::{self, Blue, Yellow};

/// Command of the referee: what play is in, or what it waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Command {
    /// All robots stop at once.
    Halt,
    /// Robots keep away from the ball and drive slowly.
    Stop,
    /// The kick that was prepared may be taken.
    NormalStart,
    /// The ball is free for both teams.
    ForceStart,
    /// The team prepares its kick-off.
    PrepareKickoff(Team),
    /// The team prepares its penalty kick.
    PreparePenalty(Team),
    /// The team may take a free kick.
    DirectFree(Team),
    /// The team places the ball.
    BallPlacement(Team),
    /// VSSS: both teams may play the ball from a free-ball mark.
    FreeBall,
    /// VSSS: the team may take a goal kick.
    GoalKick(Team),
}

/// All commands, their numbers and their names.
pub const COMMANDS: [(Command, u8, &str); 15] = [
    (Command::Halt, 0, "HALT"),
    (Command::Stop, 1, "STOP"),
    (Command::NormalStart, 2, "NORMAL_START"),
    (Command::ForceStart, 3, "FORCE_START"),
    (Command::PrepareKickoff(Yellow), 4, "PREPARE_KICKOFF_YELLOW"),
    (Command::PrepareKickoff(Blue), 5, "PREPARE_KICKOFF_BLUE"),
    (Command::PreparePenalty(Yellow), 6, "PREPARE_PENALTY_YELLOW"),
    (Command::PreparePenalty(Blue), 7, "PREPARE_PENALTY_BLUE"),
    (Command::DirectFree(Yellow), 8, "DIRECT_FREE_YELLOW"),
    (Command::DirectFree(Blue), 9, "DIRECT_FREE_BLUE"),
    (Command::BallPlacement(Yellow), 16, "BALL_PLACEMENT_YELLOW"),
    (Command::BallPlacement(Blue), 17, "BALL_PLACEMENT_BLUE"),
    (Command::FreeBall, 100, "FREE_BALL"),
    (Command::GoalKick(Yellow), 101, "GOAL_KICK_YELLOW"),
    (Command::GoalKick(Blue), 102, "GOAL_KICK_BLUE"),
];

impl Command {
    /// Number of the command.
    ///
    /// # Panics
    /// Never: all commands are listed.
    pub fn code(self) -> u8 {
        let found = COMMANDS.iter().find(|(command, ..)| *command == self);
        found.expect("all commands are listed").1
    }

    /// Command of a number; `None` if there is none.
    pub fn of_code(code: u8) -> Option<Self> {
        COMMANDS.iter().find(|(_, number, _)| *number == code).map(|(command, ..)| *command)
    }

    /// The team whose command it is; `None` for a command to both.
    pub const fn team(self) -> Option<Team> {
        match self {
            Self::PrepareKickoff(team)
            | Self::PreparePenalty(team)
            | Self::DirectFree(team)
            | Self::BallPlacement(team)
            | Self::GoalKick(team) => Some(team),
            Self::Halt | Self::Stop | Self::NormalStart | Self::ForceStart | Self::FreeBall => None,
        }
    }
}

/// Part of a match.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Stage {
    /// Before the first kick-off.
    FirstHalfPre = 0,
    /// First half.
    FirstHalf = 1,
    /// Break between the halves.
    HalfTime = 2,
    /// Before the kick-off of the second half.
    SecondHalfPre = 3,
    /// Second half.
    SecondHalf = 4,
    /// Break before extra time.
    ExtraTimeBreak = 5,
    /// Before the first kick-off of extra time.
    ExtraFirstHalfPre = 6,
    /// First half of extra time.
    ExtraFirstHalf = 7,
    /// Break between the halves of extra time.
    ExtraHalfTime = 8,
    /// Before the second kick-off of extra time.
    ExtraSecondHalfPre = 9,
    /// Second half of extra time.
    ExtraSecondHalf = 10,
    /// Break before the shoot-out.
    ShootoutBreak = 11,
    /// Alternating penalty kicks.
    Shootout = 12,
    /// The match is over.
    PostGame = 13,
}

impl Stage {
    /// All stages, in the order of their numbers.
    pub const ALL: [Self; 14] = [
        Self::FirstHalfPre,
        Self::FirstHalf,
        Self::HalfTime,
        Self::SecondHalfPre,
        Self::SecondHalf,
        Self::ExtraTimeBreak,
        Self::ExtraFirstHalfPre,
        Self::ExtraFirstHalf,
        Self::ExtraHalfTime,
        Self::ExtraSecondHalfPre,
        Self::ExtraSecondHalf,
        Self::ShootoutBreak,
        Self::Shootout,
        Self::PostGame,
    ];

    /// Names of all stages, in the order of their numbers.
    pub const NAMES: [&'static str; 14] = [
        "NORMAL_FIRST_HALF_PRE",
        "NORMAL_FIRST_HALF",
        "NORMAL_HALF_TIME",
        "NORMAL_SECOND_HALF_PRE",
        "NORMAL_SECOND_HALF",
        "EXTRA_TIME_BREAK",
        "EXTRA_FIRST_HALF_PRE",
        "EXTRA_FIRST_HALF",
        "EXTRA_HALF_TIME",
        "EXTRA_SECOND_HALF_PRE",
        "EXTRA_SECOND_HALF",
        "PENALTY_SHOOTOUT_BREAK",
        "PENALTY_SHOOTOUT",
        "POST_GAME",
    ];

    /// Number of the stage.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// Stage of a number; `None` if there is none.
    pub fn of_code(code: u8) -> Option<Self> {
        Self::ALL.get(usize::from(code)).copied()
    }

    /// Whether the match clock counts in the stage.
    pub const fn is_played(self) -> bool {
        matches!(
            self,
            Self::FirstHalf | Self::SecondHalf | Self::ExtraFirstHalf | Self::ExtraSecondHalf
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_lead_back_to_commands_and_stages() {
        for (command, code, _) in COMMANDS {
            assert_eq!(command.code(), code);
            assert_eq!(Command::of_code(code), Some(command));
        }
        for stage in Stage::ALL {
            assert_eq!(Stage::of_code(stage.code()), Some(stage));
        }
        assert_eq!(Command::of_code(10), None);
        assert_eq!(Stage::of_code(14), None);
    }

    #[test]
    fn commands_of_a_team_name_it() {
        let teams = COMMANDS.map(|(command, ..)| command.team());
        assert_eq!(teams.iter().flatten().filter(|team| **team == Blue).count(), 5);
        assert_eq!(teams.iter().flatten().filter(|team| **team == Yellow).count(), 5);
    }
}
