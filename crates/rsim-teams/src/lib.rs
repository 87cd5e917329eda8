//! A scripted SSL side: a whole team that plays matches under a referee.
//!
//! It knows state rows by the names of their columns, the state of the match, and a memory that its caller
//! owns: no physics, no threads, no clock. The same row, match and memory give the same commands, on every
//! platform.

mod aim;
mod anticipation;
mod approach;
mod avoidance;
mod bounds;
mod config;
mod defense;
mod error;
mod intercept;
mod jobs;
mod keeper;
mod kicking;
mod lanes;
mod memory;
mod motion;
mod order;
mod orders;
mod path;
mod penalty;
mod phase;
mod pitch;
mod placement;
mod plane;
mod possession;
mod random;
mod restart;
mod roles;
mod rolling;
mod situation;
mod skill;
mod support;
mod tactics;
mod team;
#[cfg(test)]
mod testing;
mod view;

pub use config::{BallNumbers, MAX_ROBOTS, RobotNumbers, TeamConfig};
pub use error::TeamsError;
pub use tactics::{TACTICS, Tactic};
pub use team::{COMMAND_COLUMNS, ScriptedTeam};
