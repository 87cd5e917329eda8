//! One match.

pub(crate) mod batch;
mod estimate;
mod forecast;
pub(crate) mod forecaster;
mod line_up;
mod nearest;
mod placement;
mod reposition;
mod restart;
mod row;
mod sensed;
mod snapshot;

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::sync::Arc;

use crate::body_parameters::BodyParameters;
use crate::engine::{NonFinite, Scratch};
use crate::error::{ConfigError, PlaceError, StepError};
use crate::geometry::arena::walls;
use crate::geometry::free_space::FreeSpace;
use crate::models::config::SimConfig;
use crate::models::sensing::Sensing;
use crate::senses::Senses;
use crate::senses::exposed::Film;
use crate::senses::fetch::Fetched;
use crate::state::crossing::Crossing;
use crate::state::{Setup, State};
use crate::tick::{StepCommands, Tick};
use crate::world::line_up::line_up;
use crate::world::placement::{Placement, Start};
use crate::world::sensed::advance_sensed;

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
        Self { engine: Scratch::new(), commands: StepCommands::NONE }
    }
}

/// One match: place it, step it, write its row.
///
/// A world holds everything that its future depends on, so a clone continues as the original does.
#[derive(Clone)]
pub struct World {
    shared: Arc<Shared>,
    state: Box<State>,
    /// Senses of the robots; `None` if they know the true state and obey exactly.
    senses: Option<Box<Senses>>,
    contact_free_enabled: bool,
}

/// Constants that all worlds of one configuration share.
struct Shared {
    setup: Setup,
    /// Senses of the configuration.
    sensing: Option<Arc<Sensing>>,
    placement: Placement,
    /// State before any match. A match that starts from it keeps nothing of an earlier one.
    pristine: Box<State>,
}

impl World {
    /// A match in its default line-up: robots side by side in their own halves, ball at the center.
    ///
    /// # Errors
    /// As [`SimConfig::validate`]; teams that do not fit on the field.
    pub fn new(config: &SimConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let (parameters, walls) = (BodyParameters::of(config), walls(&config.field));
        let mut pristine = State::new(config, &parameters, &walls).boxed();
        for (body, motion) in line_up(config).iter().enumerate() {
            pristine.place(body, motion);
        }
        let placement = Placement::new(config, &walls);
        let mut row = vec![0.0; config.row_size()];
        row::write(&parameters, &pristine, config.tick, &mut row);
        placement.read(&row, &parameters).map_err(|error| {
            ConfigError::Inconsistent(format!("the teams do not fit on the field: {error}"))
        })?;
        let setup = Setup {
            config: config.clone(),
            free_space: FreeSpace::of(&config.field, &walls),
            walls,
            parameters,
            command_columns: config.command_columns(),
        };
        let sensing = config.sensing.clone().map(Arc::new);
        let shared = Arc::new(Shared { setup, sensing, placement, pristine: pristine.clone() });
        let mut world = Self { shared, state: pristine, senses: None, contact_free_enabled: true };
        world.set_senses(0, world.shared.sensing.clone());
        Ok(world)
    }

    /// Configuration of the match.
    pub fn config(&self) -> &SimConfig {
        &self.shared.setup.config
    }

    /// Starts a new match from a state row; its positions, headings, velocities, the ball's spin and the
    /// robots' `absent` are used, of an absent robot nothing else. `parameters` are factors on the models'
    /// numbers, in the order of [`BALL_PARAMETERS`](crate::columns::BALL_PARAMETERS) and, for each robot,
    /// [`ROBOT_PARAMETERS`](crate::columns::ROBOT_PARAMETERS); without them all factors are 1.
    ///
    /// # Errors
    /// [`PlaceError`] for bodies outside the field or overlapping, or parameters out of range; then
    /// nothing has changed.
    pub fn place(&mut self, row: &[f32], parameters: Option<&[f32]>) -> Result<(), PlaceError> {
        let checked = self.check(row, parameters)?;
        self.start_match(checked);
        Ok(())
    }

    /// Fetches the senses that a step needs.
    pub(crate) fn fetch_senses(&self, fetched: &mut Fetched) {
        if let Some(senses) = &self.senses {
            senses.fetch(fetched);
        }
    }

    /// Starts a new match from a checked start, with new senses.
    fn start_match(&mut self, checked: CheckedStart) {
        self.start(checked);
        self.set_senses(0, self.shared.sensing.clone());
    }

    /// Reads and checks a start.
    fn check(&self, row: &[f32], parameters: Option<&[f32]>) -> Result<CheckedStart, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        let own = parameters.map(|parameters| BodyParameters::varied(self.config(), parameters));
        let own_parameters = own.transpose().map_err(PlaceError::Parameters)?.map(Box::new);
        let of_bodies = own_parameters.as_deref().unwrap_or(&self.shared.setup.parameters);
        Ok(CheckedStart { start: self.shared.placement.read(row, of_bodies)?, own_parameters })
    }

    /// Starts a new match from a checked start.
    fn start(&mut self, checked: CheckedStart) {
        let CheckedStart { start, own_parameters } = checked;
        self.state.copy_from(&self.shared.pristine);
        self.state.engine.enable_contact_free_ticks(self.contact_free_enabled);
        self.state.own_parameters = own_parameters;
        if let Some(parameters) = &self.state.own_parameters {
            self.state.engine.set_parameters(parameters);
            self.state.bodies.ball_mass = parameters.ball.mass;
        }
        for (body, motion) in start.motions.iter().enumerate() {
            self.state.place(body, motion);
        }
        self.state.ball = start.ball;
        self.state.absent = start.absent;
    }

    /// Advances the match by one control step. `commands` has one row per robot, as wide as the longest
    /// command in the match; a robot reads the first columns, as its model names them. Values beyond
    /// the limits of motors and kickers are clipped.
    ///
    /// # Errors
    /// [`StepError`] if the state became non-finite; [`World::place`] and [`World::restart`] repair it.
    pub fn step(&mut self, commands: &[f32]) -> Result<(), StepError> {
        debug_assert_eq!(commands.len(), self.config().command_size());
        let mut film = Film::default();
        self.begin_step(commands);
        self.move_bodies(commands, &mut film);
        self.end_step(&film);
        if self.is_lost() { Err(StepError { worlds: vec![0] }) } else { Ok(()) }
    }

    /// Whether the state is non-finite: only a placement repairs it.
    fn is_lost(&self) -> bool {
        self.state.broken
    }

    /// Advances the bodies by the ticks of a control step, and exposes a film to them where there are cameras. A world
    /// that is lost stays as it is.
    fn move_bodies(&mut self, commands: &[f32], film: &mut Film) {
        if self.is_lost() {
            return;
        }
        self.state.crossing = Crossing::default();
        self.state.touches.start_step();
        self.state.bodies.clear_collisions();
        let setup = &self.shared.setup;
        let state = &mut self.state;
        let own_parameters = state.own_parameters.take();
        let parameters = own_parameters.as_deref().unwrap_or(&setup.parameters);
        let moved = MEMORY.with_borrow_mut(|memory| match &mut self.senses {
            None => advance(memory, setup, parameters, state, commands),
            Some(senses) => {
                advance_sensed(&mut memory.engine, setup, parameters, state, (senses, film))
            }
        });
        state.own_parameters = own_parameters;
        self.state.broken = moved.and_then(|()| self.state.check_finite()).is_err();
    }

    /// Makes every tick use the contact solver, also those without contacts. This is slower, and the
    /// same except for rounding and rare pairs of corners that pass each other: for tests and benchmarks
    /// that compare.
    pub fn disable_contact_free_ticks(&mut self) {
        self.contact_free_enabled = false;
        self.state.engine.enable_contact_free_ticks(false);
    }

    /// Sets the number of sub-steps of the solver in a tick, before any are merged, until the next [`World::place`] or
    /// [`World::restart`]: for the benchmark that compares numbers.
    pub fn set_sub_steps(&mut self, sub_steps: NonZeroUsize) {
        self.state.engine.set_sub_steps(sub_steps.get());
    }

    /// Number of ticks of this match without contacts, which went without the solver.
    pub fn contact_free_ticks(&self) -> u32 {
        self.state.engine.contact_free_ticks()
    }

    /// Writes the state row.
    pub fn write_row(&self, out: &mut [f32]) {
        row::write(self.parameters(), &self.state, self.config().tick, out);
    }

    /// Number of pairs of bodies, or of a body and a wall, with an impulse between them in the last tick.
    pub fn contacts(&self) -> usize {
        self.state.engine.contacts()
    }

    fn parameters(&self) -> &BodyParameters {
        self.state.own_parameters.as_deref().unwrap_or(&self.shared.setup.parameters)
    }
}

/// Advances a match by the ticks of a control step.
fn advance(
    memory: &mut WorkingMemory,
    setup: &Setup,
    parameters: &BodyParameters,
    state: &mut State,
    commands: &[f32],
) -> Result<(), NonFinite> {
    let WorkingMemory { engine, commands: read } = memory;
    read.read(state, parameters, commands, setup.command_columns.max(1));
    let tick = Tick { setup, parameters, commands: read };
    (0..setup.config.ticks_per_step()).try_for_each(|_| tick.advance(state, engine))
}

/// A start that passed all checks.
struct CheckedStart {
    start: Start,
    own_parameters: Option<Box<BodyParameters>>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::WARM_STARTS;
    use crate::models::config::EngineKind;
    use crate::models::field::Field;
    use crate::scenes::{self, Driver, Scene};

    #[test]
    fn crowds_leave_a_third_of_the_space_for_warm_starts_empty() {
        let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
        let ssl_a = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
        for config in [scenes::vss(1, 1), scenes::vss(3, 3), vss_5v5, scenes::ssl(6, 6), ssl_a] {
            let config = SimConfig { engine: EngineKind::Compact, ..config };
            let mut scene = Scene::lined_up("crowd", config, Driver::Chase);
            let (mut most, mut space) = (0, 0);
            for seed in 0..10 {
                scene.scatter(seed);
                let (mut world, mut row) = (scene.world(), scene.start.clone());
                for step in 0..200 {
                    world.step(&scene.commands(&row, step, seed)).expect("finite");
                    world.write_row(&mut row);
                    most = most.max(world.state.engine.warm_starts());
                }
                space = world.state.bodies.blocks.len() * WARM_STARTS;
            }
            assert!(most >= 2 && 3 * most <= 2 * space, "{most} of {space}");
        }
    }
}
