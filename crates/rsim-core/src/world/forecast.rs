//! Forecasts: the physics of the models run from what is known of one time to another time.

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::forecast::coasting::Coasting;
use crate::forecast::commands::{Acting, CommandLog, is_same};
use crate::forecast::{Knowledge, MAX_FORECAST};
use crate::math::Vector;
use crate::state::State;
use crate::state::crossing::Crossing;
use crate::tick::Tick;
use crate::world::placement::Start;
use crate::world::{MEMORY, Shared, WorkingMemory, World, row};

/// Part of a tick that counts as none.
const ROUNDING: f64 = 0.01;

/// The input of a forecast.
pub(super) struct Known<'a> {
    /// State row of what is known.
    pub(super) row: &'a [f32],
    /// Time at which it was so, s.
    pub(super) seen: f64,
    /// Time to forecast, s.
    pub(super) until: f64,
    pub(super) commands: &'a CommandLog,
    /// Robots whose commands are known, one bit each.
    pub(super) robots: u64,
    /// Time without commands after which robots stop, s; `None` for never.
    pub(super) timeout: Option<f64>,
}

impl World {
    /// Whether robots know a forecast.
    pub(super) fn forecasts(&self) -> bool {
        self.senses.as_ref().is_some_and(|senses| senses.sensing().forecast >= 0.5)
    }

    /// Writes the row of what a team knows: without a forecast and without cameras of each team's own the same
    /// for both, see [`World::write_sensed_row`]. With a forecast it is the state in which the next commands
    /// will act, as far as the models, the configuration's delay and the commands that are known tell.
    pub fn write_row_known_to(&self, knowledge: Knowledge, out: &mut [f32]) {
        let Some(senses) = self.senses.as_ref().filter(|senses| senses.sensing().forecast >= 0.5)
        else {
            return self.write_row_as_seen(knowledge, out);
        };
        let config = self.config();
        let expected = senses.expected(config);
        let all = senses.sensing().forecast_others >= 0.5;
        let acting = if all { Knowledge::All } else { knowledge };
        let robots = acting.robots(config);
        let mut seen = vec![0.0; out.len()];
        senses.write_row_by_cameras(knowledge, robots, &self.state, &mut seen);
        let until = senses.now(config) + f64::from(expected.command_delay);
        let known = Known {
            row: &seen,
            seen: senses.seen_at(knowledge).max(until - MAX_FORECAST),
            until,
            commands: senses.sent(),
            robots,
            timeout: expected.timeout(),
        };
        if !self.shared.run(&known, out) {
            senses.write_row(knowledge, &self.state, out);
        }
    }
}

impl Shared {
    /// Writes the forecast of a row, whose bodies may overlap as those of an estimate may. Of bodies that the
    /// physics lose, what is known is written, and so it is of a row that is not finite.
    pub(super) fn forecast(&self, known: &Known<'_>, out: &mut [f32]) {
        if !self.run(known, out) {
            out.copy_from_slice(known.row);
        }
    }

    /// Writes the forecast. Returns whether there is one.
    fn run(&self, known: &Known<'_>, out: &mut [f32]) -> bool {
        let tick = f64::from(self.setup.config.tick);
        let time = known.until - known.seen;
        if time < ROUNDING * tick {
            return false;
        }
        // Ticks end with the forecast: commands of a regular sender then act at their starts.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 400")]
        let ticks = (time / tick + ROUNDING) as u32;
        let rest = time - f64::from(ticks) * tick;
        let mut row = known.row.to_vec();
        if rest > ROUNDING * tick {
            #[expect(clippy::cast_possible_truncation, reason = "less than a tick")]
            carry_on(&mut row, rest as f32);
        }
        let Ok(found) = self.placement.nearest(&row, &self.setup.parameters) else { return false };
        let mut state = self.placed(&found.start);
        let run = Run { shared: self, known, ticks };
        let is_finite = MEMORY.with_borrow_mut(|memory| run.advance(memory, &mut state));
        if is_finite {
            row::write(&self.setup.parameters, &state, self.setup.config.tick, out);
        }
        is_finite
    }

    /// The state of a match that starts with the models' parameters.
    fn placed(&self, start: &Start) -> Box<State> {
        let mut state = self.pristine.clone();
        for (body, motion) in start.motions.iter().enumerate() {
            state.place(body, motion);
        }
        state.ball = start.ball;
        state.absent = start.absent;
        state
    }
}

/// Moves the bodies of a row on by less than a tick, along their velocities.
fn carry_on(row: &mut [f32], time: f32) {
    let (ball, robots) = row.split_at_mut(BALL_COLUMNS.len());
    let [x, y, z, v_x, v_y, v_z, ..] = ball else { unreachable!("{BALL_COLUMNS:?}") };
    *x += *v_x * time;
    *y += *v_y * time;
    *z = (*z + *v_z * time).max(0.0);
    for robot in robots.chunks_exact_mut(ROBOT_COLUMNS.len()) {
        let [x, y, cos, sin, v_x, v_y, turn, ..] = robot else { unreachable!("{ROBOT_COLUMNS:?}") };
        *x += *v_x * time;
        *y += *v_y * time;
        let heading = Vector::new(*cos, *sin);
        let turned = heading + heading.perp() * (*turn * time);
        let turned = turned * (heading.length() / turned.length().max(f32::MIN_POSITIVE));
        (*cos, *sin) = (turned.x, turned.y);
    }
}

/// The physics from what is known to the time that is forecast.
struct Run<'a> {
    shared: &'a Shared,
    known: &'a Known<'a>,
    ticks: u32,
}

impl Run<'_> {
    /// Advances a state. Returns whether it is still finite.
    fn advance(&self, memory: &mut WorkingMemory, state: &mut State) -> bool {
        let WorkingMemory { engine, commands: read } = memory;
        let Run { shared: Shared { setup, .. }, known, ticks } = self;
        let (config, parameters) = (&setup.config, &setup.parameters);
        let columns = setup.command_columns.max(1);
        let coasting = Coasting::new(self.unknown(state), &state.bodies, parameters);
        let mut commands = vec![0.0; config.command_size()];
        // Touches, collisions and crossings are those of the last control step.
        let steps = u32::try_from(config.ticks_per_step()).unwrap_or(u32::MAX);
        let tick = f64::from(config.tick);
        let mut last: Option<Acting<'_>> = None;
        for left in (1..=*ticks).rev() {
            if left == steps {
                state.crossing = Crossing::default();
                state.touches.start_step();
                state.bodies.clear_collisions();
            }
            // Commands of an irregular sender act from the nearest tick.
            let now = known.until - f64::from(left) * tick + tick / 2.0;
            let acting = known.commands.acting(now, known.timeout);
            let is_new = last.is_none_or(|last| !is_same(last, acting));
            if is_new {
                match acting {
                    Some(acting) => commands.copy_from_slice(acting),
                    None => commands.fill(0.0),
                }
                last = Some(acting);
            }
            if coasting.command(&state.bodies, &mut commands, columns) || is_new {
                read.read(state, parameters, &commands, columns);
            }
            if (Tick { setup, parameters, commands: read }).advance(state, engine).is_err() {
                return false;
            }
        }
        state.check_finite().is_ok()
    }

    /// Robots on the field whose commands are unknown, one bit each.
    fn unknown(&self, state: &State) -> u64 {
        Knowledge::All.robots(&self.shared.setup.config) & !self.known.robots & !state.absent
    }
}
