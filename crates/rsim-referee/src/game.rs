//! State of a match besides the bodies: one row of numbers in named columns.

use crate::codes::{Command, Stage};
use crate::column::{ByTeam, Column};
use crate::error::RefereeError;
use crate::team::Team;
use crate::vector::Vector;

/// Most yellow cards of a team that run at once; another one is a red card (SSL rules, "Red Card").
pub const MAX_YELLOW_CARDS: usize = 2;

/// Declares the struct of a match's state and its columns.
macro_rules! game {
    ($(#[$of_struct:meta])* pub struct Game { $($(#[$doc:meta])* $name:ident: $value:ty,)* }) => {
        $(#[$of_struct])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct Game { $($(#[$doc])* pub $name: $value,)* }

        impl Game {
            /// Names of the columns, in the order of a row.
            pub fn columns() -> Vec<String> {
                let mut names = Vec::new();
                $(names.extend(
                    <$value>::suffixes().iter().map(|end| format!("{}{end}", stringify!($name))),
                );)*
                names
            }

            /// Reads a row.
            ///
            /// # Errors
            /// If the row has another length, or a number that its column cannot have.
            pub fn read(row: &[f32]) -> Result<Self, RefereeError> {
                let size = Self::columns().len();
                if row.len() != size {
                    return Err(RefereeError::RowSize { expected: size, got: row.len() });
                }
                let rest = row;
                $(let ($name, rest) = <$value>::read(rest)
                    .ok_or(RefereeError::Column { name: stringify!($name) })?;)*
                let _: &[f32] = rest;
                Ok(Self { $($name,)* })
            }

            /// The state as a row.
            pub fn row(&self) -> Vec<f32> {
                let mut row = Vec::new();
                $(self.$name.write(&mut row);)*
                row
            }
        }
    };
}

game! {
    /// State of a match. Times are in control steps.
    pub struct Game {
        /// Command of the referee.
        command: Command,
        /// Command that follows the present one, where it is decided.
        next_command: Option<Command>,
        /// Part of the match.
        stage: Stage,
        /// Time that the stage has left; below 0 where play goes on to its next stop.
        stage_steps_left: i32,
        /// Time since the command began.
        command_steps: i32,
        /// Goals that count.
        score: ByTeam<i32>,
        /// Place where the ball has to be for the next kick, m.
        designated_position: Vector,
        /// Whether the ball has moved since the kick was allowed.
        in_play: bool,
        /// Place where the ball was when the kick was allowed, m.
        kick_position: Vector,
        /// Robot that took the last kick and may not touch the ball again before another one.
        kick_taker: Option<usize>,
        /// Robot that touched the ball last.
        last_touch: Option<usize>,
        /// Place where the ball was when it was touched last, m.
        last_touch_position: Vector,
        /// Maximum height of the ball since each team touched it last, m.
        height_since_touch: ByTeam<f32>,
        /// Place where the robot that has the ball began to have it, m.
        dribble_start: Vector,
        /// Robot that has the ball.
        dribbler: Option<usize>,
        /// Time since the ball has hardly moved.
        stuck_steps: i32,
        /// Place where the ball is stuck, m.
        stuck_position: Vector,
        /// Time since the ball is in the area of a team.
        area_steps: ByTeam<i32>,
        /// Fouls that count for cards.
        fouls: ByTeam<i32>,
        /// Yellow cards of the match.
        yellow_cards: ByTeam<i32>,
        /// Time that each running yellow card has left; 0 for none.
        yellow_steps_left: ByTeam<[i32; MAX_YELLOW_CARDS]>,
        /// Red cards of the match.
        red_cards: ByTeam<i32>,
        /// Time since a foul of the team that did not stop play; -1 for none.
        foul_steps: ByTeam<i32>,
        /// Ball placements that failed, less those that succeeded.
        placement_failures: ByTeam<i32>,
        /// Penalty kicks taken in the shoot-out.
        shootout_kicks: ByTeam<i32>,
        /// Team with the first kick-off of the match.
        first_kickoff: Option<Team>,
    }
}

impl Game {
    /// A match before its first kick-off, which `kickoff` has.
    pub fn new(kickoff: Team) -> Self {
        Self {
            command: Command::Halt,
            next_command: Some(Command::PrepareKickoff(kickoff)),
            stage: Stage::FirstHalfPre,
            stage_steps_left: 0,
            command_steps: 0,
            score: ByTeam::new(0, 0),
            designated_position: Vector::default(),
            in_play: false,
            kick_position: Vector::default(),
            kick_taker: None,
            last_touch: None,
            last_touch_position: Vector::default(),
            height_since_touch: ByTeam::new(0.0, 0.0),
            dribble_start: Vector::default(),
            dribbler: None,
            stuck_steps: 0,
            stuck_position: Vector::default(),
            area_steps: ByTeam::new(0, 0),
            fouls: ByTeam::new(0, 0),
            yellow_cards: ByTeam::new(0, 0),
            yellow_steps_left: ByTeam::new([0; MAX_YELLOW_CARDS], [0; MAX_YELLOW_CARDS]),
            red_cards: ByTeam::new(0, 0),
            foul_steps: ByTeam::new(-1, -1),
            placement_failures: ByTeam::new(0, 0),
            shootout_kicks: ByTeam::new(0, 0),
            first_kickoff: Some(kickoff),
        }
    }

    /// Begins a command.
    pub fn give(&mut self, command: Command, next: Option<Command>) {
        (self.command, self.next_command) = (command, next);
        self.command_steps = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_match_comes_back_from_its_row() {
        let mut game = Game::new(Team::Yellow);
        game.give(Command::BallPlacement(Team::Blue), Some(Command::DirectFree(Team::Blue)));
        game.score[Team::Yellow] = 3;
        game.yellow_steps_left[Team::Blue] = [17, 4800];
        game.height_since_touch[Team::Blue] = 0.25;
        game.kick_taker = Some(4);
        let row = game.row();
        assert_eq!(row.len(), Game::columns().len());
        assert_eq!(Game::read(&row), Ok(game));
    }

    #[test]
    fn columns_have_names_of_their_own() {
        let mut names = Game::columns();
        assert!(names.contains(&"score_blue".to_owned()));
        assert!(names.contains(&"yellow_steps_left_yellow_1".to_owned()));
        assert!(names.contains(&"designated_position_x".to_owned()));
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn rows_of_another_kind_are_refused_by_the_name_of_the_column() {
        let mut row = Game::new(Team::Blue).row();
        row[2] = 99.0;
        assert_eq!(Game::read(&row), Err(RefereeError::Column { name: "stage" }));
        assert!(matches!(Game::read(&row[1..]), Err(RefereeError::RowSize { .. })));
    }
}
