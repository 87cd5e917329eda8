//! Physics of robot soccer, for reinforcement learning: many small matches, stepped fast.
//!
//! A [`SimConfig`] says what is fixed (field, robot and ball models, time step). A [`World`] is one
//! match; a [`Batch`] is many, stepped on several threads. Commands go in as plain rows, states
//! come out as plain rows, whose columns are named once in [`columns`].
//!
//! SI units and radians everywhere. The origin is the centre of the field, x points at the goal
//! that the first team attacks, y to the left. The crate knows nothing of episodes or rules of play,
//! and knows the two teams only as an order of robots.
//!
//! What tasks work out for every robot in every step is here besides: a [`Viewpoint`] turns rows
//! into what robots see, [`Sight`] scales that for a network, a [`Potential`] is what a robot is to
//! raise, [`Steering`] turns actions into commands.
#![forbid(unsafe_code)]

mod arena;
mod ball;
mod ball_model;
mod batch;
pub mod columns;
mod config;
mod contacts;
mod crossing;
mod drive;
mod engine;
mod error;
mod field;
mod flight;
mod handling;
mod impact;
mod kicks;
mod line_up;
mod mouth;
mod mouth_model;
mod obstacle;
mod outline;
mod physique;
mod placement;
mod pool;
mod reposition;
mod robot_model;
mod robot_presets;
mod row;
pub mod scenes;
pub mod shaping;
mod sight;
mod snapshot;
mod squeeze;
pub mod steering;
mod tick;
mod touch;
mod viewpoint;
mod world;

pub use ball_model::{BallModel, Hop, Surface};
pub use batch::Batch;
pub use config::{SimConfig, check_team};
pub use error::{ConfigError, PlaceError, SnapshotError, StepError};
pub use field::Field;
pub use mouth_model::Mouth;
pub use placement::FASTEST;
pub use robot_model::{Body, DifferentialDrive, Drive, OmniDrive, RobotModel};
pub use shaping::Potential;
pub use sight::{Block, Sight};
pub use steering::Steering;
pub use viewpoint::{Seat, Viewpoint};
pub use world::World;

/// Number of the physics: raised whenever the same start and commands would give other states.
pub const PHYSICS_VERSION: u32 = 5;
