//! Physics of robot soccer, for reinforcement learning: many small matches, stepped fast.
//!
//! A [`SimConfig`] holds the constants of a simulator: field, robot and ball models, time step. A
//! [`World`] is one match; a [`Batch`] is many, stepped on several [`Threads`]. Commands go in as plain
//! rows, states come out as plain rows, whose columns are named once in [`columns`].
//!
//! SI units and radians everywhere. The origin is the center of the field, x points at the goal
//! that the first team attacks, y to the left. The crate knows no episodes and no rules of play; a
//! team is a range of robots in a row.
//!
//! The crate also computes the features that tasks need for every robot in every step: a
//! [`Viewpoint`] turns rows into the view of each robot, [`EgoFeatures`] scale a view for a network,
//! a [`Potential`] shapes rewards, [`Steering`] turns actions into commands. A [`Forecaster`] runs the physics from what is
//! known of the past to the time at which the next commands act. [`streams`] are random numbers of many worlds.
#![forbid(unsafe_code)]

mod ball;
mod blocks;
mod bodies;
mod body_parameters;
pub mod columns;
mod drive;
mod engine;
mod error;
mod features;
mod forecast;
mod geometry;
mod math;
mod models;
pub mod scenes;
mod senses;
mod state;
pub mod streams;
mod threads;
mod tick;
mod world;

pub use columns::{
    MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED, MAX_PLACED_SPIN,
};
pub use error::{ConfigError, ForecastError, PlaceError, SnapshotError, StepError};
pub use features::ego_features::{Block, EgoFeatures};
pub use features::shaping::Potential;
pub use features::steering::Steering;
pub use features::viewpoint::{Observer, Viewpoint};
pub use features::{shaping, steering};
pub use forecast::Knowledge;
pub use models::ball::BallModel;
pub use models::config::{EngineKind, SimConfig, check_team};
pub use models::field::Field;
pub use models::league::League;
pub use models::mouth::Mouth;
pub use models::numbers::{Number, Range};
pub use models::robot::{Body, DifferentialDrive, Drive, OmniDrive, RobotModel};
pub use models::sensing::Sensing;
pub use senses::frames::CameraFrame;
pub use senses::vision_tracker::{SeenRobot, VisionTracker};
pub use threads::Threads;
pub use tick::PHYSICS_VERSION;
pub use world::World;
pub use world::batch::Batch;
pub use world::forecaster::Forecaster;
