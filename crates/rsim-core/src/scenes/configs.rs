//! Configurations of scenes: their engine can be chosen from outside, so that every test and benchmark
//! runs with each.

use std::sync::OnceLock;

use crate::models::ball::BallModel;
use crate::models::config::{EngineKind, SimConfig};
use crate::models::field::Field;
use crate::models::robot::RobotModel;

/// Environment variable with the name of the engine of scenes.
const ENGINE: &str = "RSIM_TEST_ENGINE";

/// The engine of scenes: that of the environment variable `RSIM_TEST_ENGINE`, or the default.
///
/// # Panics
/// If the variable names no engine.
pub fn engine() -> EngineKind {
    static CHOSEN: OnceLock<EngineKind> = OnceLock::new();
    *CHOSEN.get_or_init(|| match std::env::var(ENGINE) {
        Ok(name) => EngineKind::named(&name).expect("RSIM_TEST_ENGINE names an engine"),
        Err(_) => EngineKind::default(),
    })
}

/// [`SimConfig::new`] with the engine of scenes.
pub fn config(
    field: Field,
    ball: BallModel,
    robot: &RobotModel,
    n_blue: usize,
    n_yellow: usize,
) -> SimConfig {
    SimConfig { engine: engine(), ..SimConfig::new(field, ball, robot, n_blue, n_yellow) }
}

/// [`SimConfig::vss`] with the engine of scenes.
pub fn vss(n_blue: usize, n_yellow: usize) -> SimConfig {
    SimConfig { engine: engine(), ..SimConfig::vss(n_blue, n_yellow) }
}

/// [`SimConfig::ssl`] with the engine of scenes.
pub fn ssl(n_blue: usize, n_yellow: usize) -> SimConfig {
    SimConfig { engine: engine(), ..SimConfig::ssl(n_blue, n_yellow) }
}
