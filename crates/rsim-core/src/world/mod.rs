//! One match.

pub(crate) mod batch;
mod line_up;
mod placement;
mod reposition;
mod row;
mod snapshot;

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::sync::Arc;

use crate::ball::state::BallState;
use crate::blocks::blocks_of;
use crate::body_params::BodyParams;
use crate::drive::DriveState;
use crate::engine::{Engine, NonFinite, Scratch};
use crate::error::{ConfigError, PlaceError, StepError};
use crate::geometry::arena::walls;
use crate::geometry::free_space::FreeSpace;
use crate::models::config::SimConfig;
use crate::state::crossing::Crossing;
use crate::state::touch::TouchRecord;
use crate::state::{RobotState, Setup, State};
use crate::tick::{StepCommands, Tick};
use crate::world::line_up::line_up;
use crate::world::placement::{Placement, Start};

thread_local! {
    /// Working memory, one per thread and not per world: a world holds only the state of its match.
    static MEMORY: RefCell<WorkingMemory> = RefCell::new(WorkingMemory::new());
}

struct WorkingMemory {
    engine: Scratch,
    commands: StepCommands,
}

impl WorkingMemory {
    fn new() -> Self {
        Self { engine: Scratch::new(), commands: StepCommands::default() }
    }
}

/// One match: place it, step it, write its row.
///
/// A world holds everything that its future depends on, so a clone continues as the original does.
#[derive(Clone)]
pub struct World {
    shared: Arc<Shared>,
    state: State,
    contact_free_enabled: bool,
}

/// Constants that all worlds of one configuration share.
struct Shared {
    setup: Setup,
    placement: Placement,
    /// State before any match. A match that starts from it keeps nothing of an earlier one.
    pristine: State,
}

impl World {
    /// A match in its default line-up: robots side by side in their own halves, ball at the centre.
    ///
    /// # Errors
    /// As [`SimConfig::validate`]; teams that do not fit on the field.
    pub fn new(config: &SimConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let (params, walls) = (BodyParams::of(config), walls(&config.field));
        let mut pristine = State {
            engine: Engine::new(config, &params, &walls),
            ball: BallState::default(),
            robots: vec![RobotState::default(); config.n_robots()],
            drives: vec![DriveState::default(); blocks_of(config.n_robots())],
            touches: TouchRecord::new(config.n_robots()),
            crossing: Crossing::default(),
            own_params: None,
            broken: false,
        };
        for (body, motion) in line_up(config).iter().enumerate() {
            pristine.engine.set_motion(body, motion);
        }
        let placement = Placement::new(config, &walls);
        let mut row = vec![0.0; config.row_size()];
        row::write(&params, &pristine, &mut row);
        placement.read(&row, &params).map_err(|error| {
            ConfigError::Inconsistent(format!("the teams do not fit on the field: {error}"))
        })?;
        let setup = Setup {
            config: config.clone(),
            free_space: FreeSpace::of(&config.field, &walls),
            walls,
            params,
            command_columns: config.command_columns(),
        };
        let shared = Arc::new(Shared { setup, placement, pristine: pristine.clone() });
        Ok(Self { shared, state: pristine, contact_free_enabled: true })
    }

    /// Configuration of the match.
    pub fn config(&self) -> &SimConfig {
        &self.shared.setup.config
    }

    /// Starts a new match from a state row; its positions, headings, velocities and the ball's spin are
    /// used. `parameters` are factors on the models' numbers, in the order of
    /// [`BALL_PARAMETERS`](crate::columns::BALL_PARAMETERS) and, for each robot,
    /// [`ROBOT_PARAMETERS`](crate::columns::ROBOT_PARAMETERS); without them all factors are 1.
    ///
    /// # Errors
    /// [`PlaceError`] for bodies outside the field or overlapping, or parameters out of range; then
    /// nothing has changed.
    pub fn place(&mut self, row: &[f32], parameters: Option<&[f32]>) -> Result<(), PlaceError> {
        let start = self.check(row, parameters)?;
        self.start(&start);
        Ok(())
    }

    /// Reads and checks a start.
    fn check(&self, row: &[f32], parameters: Option<&[f32]>) -> Result<CheckedStart, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        let own = parameters.map(|factors| BodyParams::varied(self.config(), factors));
        let own_params = own.transpose().map_err(PlaceError::Parameters)?.map(Box::new);
        let params = own_params.as_deref().unwrap_or(&self.shared.setup.params);
        Ok(CheckedStart { start: self.shared.placement.read(row, params)?, own_params })
    }

    /// Starts a new match from a checked start.
    fn start(&mut self, checked: &CheckedStart) {
        self.state.clone_from(&self.shared.pristine);
        self.state.engine.enable_contact_free_ticks(self.contact_free_enabled);
        self.state.own_params.clone_from(&checked.own_params);
        if let Some(params) = &self.state.own_params {
            self.state.engine.set_params(params);
        }
        for (body, motion) in checked.start.motions.iter().enumerate() {
            self.state.engine.set_motion(body, motion);
        }
        self.state.ball = checked.start.ball;
    }

    /// Advances the match by one control step. `commands` has one row per robot, as wide as the longest
    /// command in the match; a robot reads the first columns, as its model names them. Values beyond
    /// the limits of motors and kickers are clipped.
    ///
    /// # Errors
    /// [`StepError`] if the state became non-finite; only [`World::place`] repairs it.
    pub fn step(&mut self, commands: &[f32]) -> Result<(), StepError> {
        debug_assert_eq!(commands.len(), self.config().command_size());
        if self.state.broken {
            return Err(StepError { worlds: vec![0] });
        }
        self.state.crossing = Crossing::default();
        self.state.touches.start_step();
        let setup = &self.shared.setup;
        let state = &mut self.state;
        let own_params = state.own_params.take();
        let params = own_params.as_deref().unwrap_or(&setup.params);
        let stepped = MEMORY.with_borrow_mut(|memory| {
            let WorkingMemory { engine, commands: read } = memory;
            read.read(state, params, commands, setup.command_columns.max(1));
            let tick = Tick { setup, params, commands: read };
            (0..setup.config.ticks_per_step()).try_for_each(|_| tick.advance(state, engine))
        });
        state.own_params = own_params;
        stepped.and_then(|()| self.state.check_finite()).map_err(|NonFinite| {
            self.state.broken = true;
            StepError { worlds: vec![0] }
        })
    }

    /// Makes every tick use the contact solver, also those without contacts. This is slower, and the
    /// same except for rounding and rare pairs of corners that pass each other: for tests and benchmarks
    /// that compare.
    pub fn disable_contact_free_ticks(&mut self) {
        self.contact_free_enabled = false;
        self.state.engine.enable_contact_free_ticks(false);
    }

    /// Sets the number of sub-steps of the solver in a tick, until the next [`World::place`]: for the
    /// benchmark that compares numbers.
    pub fn set_sub_steps(&mut self, sub_steps: NonZeroUsize) {
        self.state.engine.set_sub_steps(sub_steps.get());
    }

    /// Number of ticks of this match without contacts, which went without the solver.
    pub fn contact_free_ticks(&self) -> u32 {
        self.state.engine.contact_free_ticks()
    }

    /// Writes the state row.
    pub fn write_row(&self, out: &mut [f32]) {
        row::write(self.params(), &self.state, out);
    }

    /// Number of pairs of bodies, or of a body and a wall, with an impulse between them in the last tick.
    pub fn contacts(&self) -> usize {
        self.state.engine.contacts()
    }

    fn params(&self) -> &BodyParams {
        self.state.own_params.as_deref().unwrap_or(&self.shared.setup.params)
    }
}

/// A start that passed all checks.
struct CheckedStart {
    start: Start,
    own_params: Option<Box<BodyParams>>,
}
