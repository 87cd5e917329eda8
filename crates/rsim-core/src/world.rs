//! One match.

use std::cell::RefCell;
use std::num::NonZeroUsize;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::arena::{Wall, walls};
use crate::ball::Ball;
use crate::crossing::Crossing;
use crate::drive::Drive;
use crate::engine::{Engine, NonFinite, Room, Scratch};
use crate::line_up::line_up;
use crate::physique::Physique;
use crate::placement::{Placement, Start};
use crate::tick::Tick;
use crate::touch::Touched;
use crate::{ConfigError, PlaceError, SimConfig, StepError, row};

thread_local! {
    /// One per thread and not per world: a world keeps only what a match is.
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
}

/// One match: place it, step it, write its row.
///
/// Everything that its future depends on is in here, so a clone plays on as the original does.
#[derive(Clone)]
pub struct World {
    pub(crate) rules: Arc<Fixed>,
    pub(crate) state: State,
    skips: bool,
}

/// What all worlds of one configuration share.
pub(crate) struct Fixed {
    pub(crate) config: SimConfig,
    pub(crate) walls: Vec<Wall>,
    pub(crate) room: Room,
    physique: Physique,
    pub(crate) placement: Placement,
    pub(crate) command_columns: usize,
    /// A world that nobody has touched. Starting from it leaves nothing of an earlier match.
    pristine: State,
}

/// What a match is at one instant.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct State {
    pub(crate) engine: Engine,
    pub(crate) ball: Ball,
    pub(crate) robots: Vec<Robot>,
    pub(crate) touched: Touched,
    pub(crate) crossing: Crossing,
    /// The bodies of a world that differs from the models.
    own: Option<Box<Physique>>,
    /// Whether a number left the finite ones; only placing the world anew mends it.
    pub(crate) broken: bool,
}

impl State {
    /// The engine notices only what it integrates itself, so everything is looked at.
    fn check(&self) -> Result<(), NonFinite> {
        let Ball { z, v_z, spin, .. } = self.ball;
        let ball = z.is_finite() && v_z.is_finite() && spin.is_finite();
        let finite =
            ball && (0..=self.robots.len()).all(|body| self.engine.motion(body).is_finite());
        if finite { Ok(()) } else { Err(NonFinite) }
    }
}

/// What a robot remembers from one tick to the next.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Robot {
    pub(crate) drive: Drive,
    /// s until its kicker is charged.
    pub(crate) recharging: f32,
    /// Share of its dribbler's speed at which it runs.
    pub(crate) dribbling: f32,
}

impl World {
    /// A match in its default line-up: robots side by side in their own halves, ball at the centre.
    ///
    /// # Errors
    /// What [`SimConfig::validate`] finds.
    pub fn new(config: &SimConfig) -> Result<Self, ConfigError> {
        config.validate()?;
        let (physique, walls) = (Physique::of(config), walls(&config.field));
        let mut pristine = State {
            engine: Engine::new(config, &physique, &walls),
            ball: Ball::default(),
            robots: vec![Robot::default(); config.n_robots()],
            touched: Touched::new(config.n_robots()),
            crossing: Crossing::default(),
            own: None,
            broken: false,
        };
        for (body, motion) in line_up(config).iter().enumerate() {
            pristine.engine.set_motion(body, motion);
        }
        let placement = Placement::new(config, &walls);
        let mut row = vec![0.0; config.row_size()];
        row::write(&physique, &pristine, &mut row);
        placement.read(&row, &physique).map_err(|error| {
            ConfigError::Inconsistent(format!("the teams do not fit on the field: {error}"))
        })?;
        let rules = Arc::new(Fixed {
            config: config.clone(),
            placement,
            room: Room::of(&config.field, &walls),
            walls,
            physique,
            command_columns: config.command_columns(),
            pristine: pristine.clone(),
        });
        Ok(Self { rules, state: pristine, skips: true })
    }

    /// What this match is played with.
    pub fn config(&self) -> &SimConfig {
        &self.rules.config
    }

    /// Starts a new match from `row`, of which positions, headings, velocities and the ball's spin
    /// count. `parameters` are factors on the models' numbers, in the order of
    /// [`crate::columns::BALL_PARAMETERS`] and, for each robot,
    /// [`crate::columns::ROBOT_PARAMETERS`]; without them the models count as they are.
    ///
    /// # Errors
    /// Bodies outside the field or in each other, or parameters out of range; then nothing has
    /// changed.
    pub fn place(&mut self, row: &[f32], parameters: Option<&[f32]>) -> Result<(), PlaceError> {
        let start = self.check(row, parameters)?;
        self.start(&start);
        Ok(())
    }

    /// What `row` and `parameters` ask for, checked.
    pub(crate) fn check(
        &self,
        row: &[f32],
        parameters: Option<&[f32]>,
    ) -> Result<Checked, PlaceError> {
        debug_assert_eq!(row.len(), self.config().row_size());
        let own = parameters.map(|factors| Physique::varied(self.config(), factors));
        let own = own.transpose().map_err(PlaceError::Parameters)?.map(Box::new);
        let physique = own.as_deref().unwrap_or(&self.rules.physique);
        Ok(Checked { start: self.rules.placement.read(row, physique)?, own })
    }

    /// Starts a new match.
    pub(crate) fn start(&mut self, checked: &Checked) {
        self.state.clone_from(&self.rules.pristine);
        self.state.engine.set_skips(self.skips);
        self.state.own.clone_from(&checked.own);
        if let Some(own) = &self.state.own {
            self.state.engine.fit(own);
        }
        for (body, motion) in checked.start.motions.iter().enumerate() {
            self.state.engine.set_motion(body, motion);
        }
        self.state.ball = checked.start.ball;
    }

    /// One control step. `commands` has a row a robot, as wide as the longest command in the match;
    /// a robot reads the columns that its model names, from the first. What motors and kickers
    /// cannot reach counts as the most that they can.
    ///
    /// # Errors
    /// The state became non-finite; only [`World::place`] mends it.
    pub fn step(&mut self, commands: &[f32]) -> Result<(), StepError> {
        debug_assert_eq!(commands.len(), self.config().command_size());
        if self.state.broken {
            return Err(StepError { worlds: vec![0] });
        }
        self.state.crossing = Crossing::default();
        self.state.touched.forget();
        let rules = &*self.rules;
        let state = &mut self.state;
        let own = state.own.take();
        let tick = Tick { rules, physique: own.as_deref().unwrap_or(&rules.physique), commands };
        let stepped = SCRATCH.with_borrow_mut(|scratch| {
            (0..rules.config.ticks_per_step()).try_for_each(|_| tick.advance(state, scratch))
        });
        state.own = own;
        stepped.and_then(|()| self.state.check()).map_err(|NonFinite| {
            self.state.broken = true;
            StepError { worlds: vec![0] }
        })
    }

    /// Has every tick go through the contact solver, also those in which nothing touches. Slower,
    /// and the same but for rounding, and now and then for two corners that pass each other: for
    /// tests and benchmarks that compare.
    pub fn never_skip(&mut self) {
        self.skips = false;
        self.state.engine.set_skips(false);
    }

    /// Has the solver take each tick in so many sub-steps, until the next [`World::place`]: for the
    /// benchmark that shows what fewer and more would give.
    pub fn set_sub_steps(&mut self, sub_steps: NonZeroUsize) {
        self.state.engine.set_sub_steps(sub_steps.get());
    }

    /// Ticks of this match in which nothing touched, so that they went without the solver.
    pub fn skipped_ticks(&self) -> u32 {
        self.state.engine.skipped()
    }

    /// Writes the state. Pure: writing twice writes the same.
    pub fn write_row(&self, out: &mut [f32]) {
        row::write(self.physique(), &self.state, out);
    }

    /// Pairs of bodies, or of a body and a wall, that pressed on each other in the last tick: what
    /// makes a scene a crowd.
    pub fn contacts(&self) -> usize {
        self.state.engine.contacts()
    }

    pub(crate) fn physique(&self) -> &Physique {
        self.state.own.as_deref().unwrap_or(&self.rules.physique)
    }
}

/// A start that nothing speaks against.
pub(crate) struct Checked {
    start: Start,
    own: Option<Box<Physique>>,
}
