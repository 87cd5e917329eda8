//! State of one match, and the constants that all matches of a configuration share.

pub(crate) mod crossing;
mod memory;
pub(crate) mod touch;

use serde::{Deserialize, Serialize};

use crate::ball::state::BallState;
use crate::blocks::robot;
use crate::bodies::{Bodies, BodyBlock};
use crate::body_parameters::BodyParameters;
use crate::engine::{Engine, NonFinite};
use crate::geometry::arena::Wall;
use crate::geometry::free_space::FreeSpace;
use crate::geometry::motion::Motion;
use crate::models::config::SimConfig;
use crate::state::crossing::Crossing;
use crate::state::touch::TouchRecord;

/// Constants of all worlds of one configuration.
pub(crate) struct Setup {
    pub(crate) config: SimConfig,
    pub(crate) walls: Vec<Wall>,
    pub(crate) free_space: FreeSpace,
    pub(crate) parameters: BodyParameters,
    /// Number of columns of one robot's command.
    pub(crate) command_columns: usize,
}

/// State of a match at one instant.
///
/// `B` is the memory of the blocks of bodies. In a match they follow the other fields, so that the whole
/// state is one allocation, a `Box<State>`. Only what rapier keeps and parameters of its own lie elsewhere.
#[derive(Serialize, Deserialize)]
pub(crate) struct State<B: ?Sized = [BodyBlock]> {
    pub(crate) engine: Engine,
    pub(crate) ball: BallState,
    pub(crate) touches: TouchRecord,
    pub(crate) crossing: Crossing,
    /// Robots that are not on the field, one bit each. They rest where nothing meets them.
    pub(crate) absent: u64,
    /// Body parameters of a world that differs from the models.
    pub(crate) own_parameters: Option<Box<BodyParameters>>,
    /// Whether a number became non-finite; only placing the world again repairs it.
    pub(crate) broken: bool,
    pub(crate) bodies: Bodies<B>,
}

impl State<Vec<BodyBlock>> {
    /// State before any match.
    pub(crate) fn new(config: &SimConfig, parameters: &BodyParameters, walls: &[Wall]) -> Self {
        Self {
            engine: Engine::new(config, parameters, walls),
            ball: BallState::default(),
            touches: TouchRecord::default(),
            crossing: Crossing::default(),
            absent: 0,
            own_parameters: None,
            broken: false,
            bodies: Bodies::new(parameters),
        }
    }
}

impl State {
    /// Sets the motion of a body, wherever it was. `heading` must be a unit vector.
    pub(crate) fn place(&mut self, body: usize, motion: &Motion) {
        self.bodies.set_motion(body, motion);
        self.engine.note_placed(body);
    }

    /// Puts a robot at rest or into motion in a match that continues: nothing of its old state remains.
    pub(crate) fn replace_robot(&mut self, index: usize, motion: &Motion, is_absent: bool) {
        self.engine.forget_impulses(&mut self.bodies, robot(index));
        self.bodies.reset_robot(index);
        self.place(robot(index), motion);
        self.touches.forget(index);
        self.absent = self.absent & !(1 << index) | u64::from(is_absent) << index;
    }

    /// Whether a robot is not on the field.
    pub(crate) fn is_absent(&self, index: usize) -> bool {
        self.absent >> index & 1 == 1
    }

    /// Checks that all numbers are finite: the engine notices only those that it integrates itself.
    pub(crate) fn check_finite(&self) -> Result<(), NonFinite> {
        let blocks = &self.bodies.blocks;
        let finite = self.ball.is_finite() && blocks.iter().all(|block| block.motion.is_finite());
        if finite { Ok(()) } else { Err(NonFinite) }
    }
}
