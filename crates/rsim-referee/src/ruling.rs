//! Rulings: what a rule decided, and how play goes on.

use crate::codes::Command;
use crate::events::{Event, EventKind};
use crate::team::Team;
use crate::vector::Vector;

/// Command and place with which play goes on after a stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuation {
    /// Command with which it goes on.
    pub command: Command,
    /// Place where the ball has to be, m.
    pub position: Vector,
}

/// The decision of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ruling {
    /// The event.
    pub event: Event,
    /// Continuation if play stops; `None` if it does not stop.
    pub then: Option<Continuation>,
    /// Whether it counts for cards of the team, or of both teams where it names none.
    pub is_foul: bool,
}

impl Ruling {
    /// A ruling about a robot.
    pub const fn of_robot(kind: EventKind, team: Team, robot: usize, position: Vector) -> Self {
        let event = Event { kind, team: Some(team), robot: Some(robot), position };
        Self { event, then: None, is_foul: false }
    }

    /// A ruling about a team, or about none.
    pub const fn of_team(kind: EventKind, team: Option<Team>, position: Vector) -> Self {
        let event = Event { kind, team, robot: None, position };
        Self { event, then: None, is_foul: false }
    }

    /// The same, as a foul.
    #[must_use]
    pub const fn foul(mut self) -> Self {
        self.is_foul = true;
        self
    }

    /// The same, with a stop.
    #[must_use]
    pub const fn stops(mut self, command: Command, position: Vector) -> Self {
        self.then = Some(Continuation { command, position });
        self
    }
}

/// Rulings of a step, in the order of the table of rules.
#[derive(Debug, Clone, Default)]
pub struct Rulings {
    list: Vec<Ruling>,
}

impl Rulings {
    /// Adds a ruling.
    pub fn add(&mut self, ruling: Ruling) {
        self.list.push(ruling);
    }

    /// Adds a ruling that decides how play goes on, whatever others do.
    pub fn add_first(&mut self, ruling: Ruling) {
        self.list.insert(0, ruling);
    }

    /// All rulings.
    pub fn iter(&self) -> impl Iterator<Item = &Ruling> {
        self.list.iter()
    }

    /// Continuation after the first ruling that stops play.
    pub fn stop(&self) -> Option<Continuation> {
        self.list.iter().find_map(|ruling| ruling.then)
    }

    /// Whether a ruling of a kind was made.
    pub fn has(&self, kind: EventKind) -> bool {
        self.list.iter().any(|ruling| ruling.event.kind == kind)
    }

    /// Removes all rulings.
    pub fn clear(&mut self) {
        self.list.clear();
    }
}
