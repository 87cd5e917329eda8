//! Referee of robot-soccer matches: the rules of VSSS and SSL as a state machine of one match.
//!
//! It knows rows of columns by name, its own row of state and its configuration: no physics, no
//! Python, no threads and no clock.

mod ball_placement;
pub mod cards;
pub mod codes;
pub mod column;
pub mod config;
mod crossing;
pub mod draws;
mod error;
pub mod events;
pub mod features;
mod flow;
mod formation;
pub mod game;
mod kick;
mod line_up;
mod lines;
pub mod moment;
pub mod pitch;
mod placing;
mod positions;
mod presets;
mod referee;
pub mod repeats;
pub mod rules;
pub mod ruling;
mod shootout;
pub mod sight;
pub mod stages;
pub mod statistics;
mod team;
mod tracking;
mod vector;

pub use error::RefereeError;
pub use lines::Lines;
pub use referee::{Decisions, Referee};
pub use team::Team;
pub use vector::Vector;
