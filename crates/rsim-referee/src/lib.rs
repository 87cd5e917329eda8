//! Referee of robot-soccer matches: the rules of VSSS and SSL as a state machine of one match.
//!
//! It knows rows of columns by name, its own row of state and its configuration: no physics, no
//! Python, no threads and no clock.

pub mod codes;
pub mod column;
pub mod config;
mod error;
pub mod events;
pub mod game;
mod lines;
pub mod rules;
pub mod sight;
pub mod stages;
mod team;
mod vector;

pub use error::RefereeError;
pub use lines::Lines;
pub use team::Team;
pub use vector::Vector;
