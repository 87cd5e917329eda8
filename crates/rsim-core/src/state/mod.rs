//! State of one match, and the constants that all matches of a configuration share.

pub(crate) mod crossing;
pub(crate) mod touch;

use serde::{Deserialize, Serialize};

use crate::ball::state::BallState;
use crate::body_params::BodyParams;
use crate::drive::DriveState;
use crate::engine::{Engine, NonFinite};
use crate::geometry::arena::Wall;
use crate::geometry::free_space::FreeSpace;
use crate::models::config::SimConfig;
use crate::state::crossing::Crossing;
use crate::state::touch::TouchRecord;

/// Constants of all worlds of one configuration.
pub(crate) struct Setup {
    pub(crate) config: SimConfig,
    pub(crate) walls: Vec<Wall>,
    pub(crate) free_space: FreeSpace,
    pub(crate) params: BodyParams,
    /// Number of columns of one robot's command.
    pub(crate) command_columns: usize,
}

/// State of a match at one instant.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) engine: Engine,
    pub(crate) ball: BallState,
    pub(crate) robots: Vec<RobotState>,
    /// Wheels of the robots, by block.
    pub(crate) drives: Vec<DriveState>,
    pub(crate) touches: TouchRecord,
    pub(crate) crossing: Crossing,
    /// Body parameters of a world that differs from the models.
    pub(crate) own_params: Option<Box<BodyParams>>,
    /// Whether a number became non-finite; only placing the world again repairs it.
    pub(crate) broken: bool,
}

/// State that a robot keeps from one tick to the next, beyond its motion.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct RobotState {
    /// Time until the kicker is charged, s.
    pub(crate) recharging: f32,
    /// Speed of the dribbler by its maximum, 0 to 1.
    pub(crate) dribbling: f32,
}

impl State {
    /// Checks that all numbers are finite: the engine notices only those that it integrates itself.
    pub(crate) fn check_finite(&self) -> Result<(), NonFinite> {
        let finite = self.ball.is_finite()
            && (0..=self.robots.len()).all(|body| self.engine.motion(body).is_finite());
        if finite { Ok(()) } else { Err(NonFinite) }
    }
}
