//! One match.

use std::cell::RefCell;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::ball::Roll;
use crate::columns::{BALL_COLUMNS, DIFFERENTIAL_COLUMNS, ROBOT_COLUMNS};
use crate::crossing::Crossing;
use crate::drive::{Drive, Limits};
use crate::engine::{Engine, Motion, NonFinite, Scratch};
use crate::placement::Placement;
use crate::{ConfigError, PlaceError, SimConfig, StepError};

thread_local! {
    /// One per thread and not per world: a world keeps only what a match is.
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
}

/// One match: place it, step it, write its row.
///
/// Everything that its future depends on is in here, so a clone plays on as the original does.
#[derive(Clone)]
pub struct World {
    rules: Arc<Fixed>,
    pub(crate) state: State,
}

/// What all worlds of one configuration share.
pub(crate) struct Fixed {
    pub(crate) config: SimConfig,
    limits: Limits,
    placement: Placement,
    /// A world that nobody has touched. Starting from it leaves nothing of an earlier match.
    pristine: State,
}

/// What a match is at one instant.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct State {
    engine: Engine,
    drives: Vec<Drive>,
    crossing: Crossing,
    /// Whether a number left the finite ones; only placing the world anew mends it.
    broken: bool,
}

impl World {
    /// A match in its default line-up: robots side by side in their own halves, ball at the centre.
    ///
    /// # Errors
    /// What [`SimConfig::validate`] finds.
    pub fn new(config: &SimConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let mut pristine = State {
            engine: Engine::new(config),
            drives: vec![Drive::default(); config.n_robots()],
            crossing: Crossing::default(),
            broken: false,
        };
        for (body, motion) in line_up(config).iter().enumerate() {
            pristine.engine.set_motion(body, motion);
        }
        let rules = Arc::new(Fixed {
            config: config.clone(),
            limits: Limits::of(&config.robot, config.tick),
            placement: Placement::new(config),
            pristine: pristine.clone(),
        });
        Ok(Self { rules, state: pristine })
    }

    /// What this match is played with.
    pub fn config(&self) -> &SimConfig {
        &self.rules.config
    }

    /// Starts a new match from `row`, of which positions, headings and velocities count.
    ///
    /// # Errors
    /// Bodies outside the field or in each other; then nothing has changed.
    pub fn place(&mut self, row: &[f32]) -> Result<(), PlaceError> {
        let motions = self.motions(row)?;
        self.start(&motions);
        Ok(())
    }

    /// The motions that `row` asks for, checked.
    pub(crate) fn motions(&self, row: &[f32]) -> Result<Vec<Motion>, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        self.rules.placement.read(row)
    }

    /// Starts a new match with these motions.
    pub(crate) fn start(&mut self, motions: &[Motion]) {
        self.state.clone_from(&self.rules.pristine);
        for (body, motion) in motions.iter().enumerate() {
            self.state.engine.set_motion(body, motion);
        }
    }

    /// One control step. `commands` are each robot's `[left, right]` wheel speeds in rad/s;
    /// speeds that the motors cannot reach count as their top speed.
    ///
    /// # Errors
    /// The state became non-finite; only [`World::place`] mends it.
    pub fn step(&mut self, commands: &[f32]) -> Result<(), StepError> {
        debug_assert_eq!(commands.len(), self.config().command_size());
        if self.state.broken {
            return Err(StepError { world: 0 });
        }
        self.state.crossing = Crossing::default();
        let stepped = SCRATCH.with_borrow_mut(|scratch| {
            (0..self.rules.config.ticks_per_step()).try_for_each(|_| self.tick(commands, scratch))
        });
        stepped.map_err(|NonFinite| {
            self.state.broken = true;
            StepError { world: 0 }
        })
    }

    fn tick(&mut self, commands: &[f32], scratch: &mut Scratch) -> Result<(), NonFinite> {
        let ball_before = self.state.engine.motion(BALL);
        let roll =
            Roll::over(&self.rules.config.ball, ball_before.velocity, self.rules.config.tick);
        roll.begin(&mut self.state.engine);
        self.drive_robots(commands);
        self.state.engine.step(scratch)?;
        self.feel_loads();
        roll.finish(&mut self.state.engine);
        let ball_after = self.state.engine.motion(BALL).position;
        self.state.crossing.watch(&self.rules.config.field, ball_before.position, ball_after);
        Ok(())
    }

    fn drive_robots(&mut self, commands: &[f32]) {
        let wheels = commands.chunks_exact(DIFFERENTIAL_COLUMNS.len());
        for (index, (drive, wheels)) in self.state.drives.iter_mut().zip(wheels).enumerate() {
            let motion = self.state.engine.motion(robot(index));
            let (force, torque) = drive.pull(&self.rules.limits, [wheels[0], wheels[1]], &motion);
            self.state.engine.push(robot(index), force, torque);
        }
    }

    fn feel_loads(&mut self) {
        for (index, drive) in self.state.drives.iter_mut().enumerate() {
            drive.feel(&self.rules.limits, &self.state.engine.motion(robot(index)));
        }
    }

    /// Writes the state. Pure: writing twice writes the same.
    pub fn write_row(&self, row: &mut [f32]) {
        let (ball, robots) = row.split_at_mut(BALL_COLUMNS.len());
        let Motion { position, velocity, .. } = self.state.engine.motion(BALL);
        let Crossing { code, at } = self.state.crossing;
        ball.copy_from_slice(&[
            position.x,
            position.y,
            velocity.x,
            velocity.y,
            f32::from(code),
            at.x,
            at.y,
        ]);
        for (index, columns) in robots.chunks_exact_mut(ROBOT_COLUMNS.len()).enumerate() {
            let Motion { position, heading, velocity, spin } =
                self.state.engine.motion(robot(index));
            columns.copy_from_slice(&[
                position.x, position.y, heading.x, heading.y, velocity.x, velocity.y, spin,
            ]);
        }
    }

    /// Pairs of bodies or walls that touch: what makes a scene a crowd.
    pub fn contacts(&self) -> usize {
        self.state.engine.contacts()
    }
}

const BALL: usize = 0;

/// The body of robot `index`.
const fn robot(index: usize) -> usize {
    index + 1
}

/// Each team in a line across the middle of its half, facing the other's goal.
fn line_up(config: &SimConfig) -> Vec<Motion> {
    use rapier2d::math::Vector;
    let still = |position, heading| Motion { position, heading, velocity: Vector::ZERO, spin: 0.0 };
    let spacing = config.field.width / (config.field.max_robots + 1) as f32;
    let mut motions = vec![still(Vector::ZERO, Vector::X)];
    for (count, side) in [(config.n_blue, -1.0), (config.n_yellow, 1.0)] {
        for index in 0..count {
            let y = (index as f32 - (count as f32 - 1.0) / 2.0) * spacing;
            let x = side * config.field.length / 4.0;
            motions.push(still(Vector::new(x, y), Vector::new(-side, 0.0)));
        }
    }
    motions
}
