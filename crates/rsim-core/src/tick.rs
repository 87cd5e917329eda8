//! One physics tick: robots handle the ball and drive, the ball moves by its law, contacts are
//! solved, and what happened is noted.

use crate::ball::Rolling;
use rapier2d::math::Vector;

use crate::engine::{BALL, BallHooks, Level, Motion, NonFinite, Press, Scratch, robot};
use crate::flight::Flight;
use crate::physique::Physique;
use crate::squeeze::Squeeze;
use crate::world::{Fixed, State};
use crate::{contacts, handling};

/// What a tick is played with.
pub(crate) struct Tick<'a> {
    pub(crate) rules: &'a Fixed,
    pub(crate) physique: &'a Physique,
    pub(crate) commands: &'a [f32],
}

/// Speed from which a squeeze is solved in parts of the tick, m/s: of what is around the ball, or its
/// own. It slides along outlines that turn, which one linear look at the contacts of a tick does not see.
const FAST_SQUEEZE: f32 = 1.5;
const SQUEEZE_PARTS: u8 = 4;

impl Tick<'_> {
    pub(crate) fn advance(
        &self,
        state: &mut State,
        scratch: &mut Scratch,
    ) -> Result<(), NonFinite> {
        let length = self.rules.config.tick;
        handling::handle_ball(state, self.physique, self.commands, self.columns(), length);
        self.drive_robots(state);
        let before = state.engine.motion(BALL).position.extend(state.ball.z);
        let squeeze = self.squeeze(state, state.engine.motion(BALL).velocity, length);
        let is_fast = squeeze.is_some_and(|squeeze| squeeze.speed > FAST_SQUEEZE);
        let parts = if is_fast { SQUEEZE_PARTS } else { 1 };
        for _ in 0..parts {
            let part = length / f32::from(parts);
            self.move_bodies(state, scratch, part, squeeze.is_some())?;
        }
        self.feel_loads(state, &scratch.presses);
        let after = state.engine.motion(BALL).position.extend(state.ball.z);
        state.crossing.watch(&self.rules.config.field, before, after);
        Ok(())
    }

    /// Lets everything move and meet for `length`, in which the ball may be squeezed or cannot be.
    fn move_bodies(
        &self,
        state: &mut State,
        scratch: &mut Scratch,
        length: f32,
        may_squeeze: bool,
    ) -> Result<(), NonFinite> {
        state.engine.list_undisturbed(length, &mut scratch.undisturbed);
        let before = state.engine.motion(BALL);
        if state.ball.is_down() {
            self.roll(state, &before, scratch, length, may_squeeze)?;
        } else {
            self.fly(state, &before, scratch, length, may_squeeze)?;
        }
        state.engine.list_presses(&mut scratch.presses);
        contacts::settle_robots(
            state,
            self.physique,
            self.rules.config.blue.len(),
            &scratch.presses,
            &scratch.undisturbed,
        );
        Ok(())
    }

    /// A tick with the ball on the floor.
    ///
    /// The engine moves it with its *mean* velocity over the tick, and afterwards gets the
    /// difference to the *end* velocity added to whatever it made of it. So the path is exact at any
    /// tick, and whether somebody pushed the ball makes no difference to the law. After a bounce the
    /// law starts anew from there, for half a tick on average.
    fn roll(
        &self,
        state: &mut State,
        before: &Motion,
        scratch: &mut Scratch,
        length: f32,
        may_squeeze: bool,
    ) -> Result<(), NonFinite> {
        let ball = &self.physique.ball;
        let start = Rolling { velocity: before.velocity, spin: state.ball.spin };
        let (way, end) = start.after(ball, length);
        let mean = way / length;
        state.engine.set_velocity(BALL, mean);
        let squeeze = if may_squeeze { self.squeeze(state, mean, length) } else { None };
        if let Some(squeeze) = &squeeze {
            state.engine.set_velocity(BALL, squeeze.velocity);
        }
        let hooks = self.hooks(Level::Floor, squeeze, length);
        state.engine.step(scratch, &hooks, &self.rules.room)?;
        let mut now = Rolling { velocity: state.engine.motion(BALL).velocity, spin: end.spin };
        if squeeze.is_some_and(|squeeze| squeeze.jammed) {
            contacts::settle_caught(state);
        } else if contacts::settle(
            state,
            self.rules,
            self.physique,
            mean,
            &mut now,
            &scratch.undisturbed,
        ) {
            now = now.after(ball, length / 2.0).1;
        } else {
            now.velocity += end.velocity - mean;
        }
        state.engine.set_velocity(BALL, now.velocity);
        state.ball.spin = now.spin;
        Ok(())
    }

    /// A tick with the ball in the air, while the rest stays in the plane.
    fn fly(
        &self,
        state: &mut State,
        before: &Motion,
        scratch: &mut Scratch,
        length: f32,
        may_squeeze: bool,
    ) -> Result<(), NonFinite> {
        let squeeze = if may_squeeze { self.squeeze(state, before.velocity, length) } else { None };
        let squeeze = squeeze.filter(|squeeze| squeeze.jammed);
        let level = if let Some(squeeze) = &squeeze {
            state.engine.set_velocity(BALL, squeeze.velocity);
            Level::Caught { height: state.ball.z + self.physique.ball.radius }
        } else {
            Level::Air
        };
        let hooks = self.hooks(level, squeeze, length);
        state.engine.step(scratch, &hooks, &self.rules.room)?;
        if squeeze.is_some() {
            contacts::settle_caught(state);
        }
        let flight = Flight {
            physique: self.physique,
            walls: &self.rules.walls,
            engine: &mut state.engine,
            touched: &mut state.touched,
        };
        if squeeze.is_some() {
            flight.fall(&mut state.ball, length);
        } else {
            flight.fly(&mut state.ball, before.position, before.velocity, length);
        }
        Ok(())
    }

    /// Whether the ball, which moves with `velocity`, is caught within `time`.
    fn squeeze(&self, state: &State, velocity: Vector, time: f32) -> Option<Squeeze> {
        let height = state.ball.z + self.physique.ball.radius;
        let room = &self.rules.room;
        Squeeze::find(&state.engine, self.physique, room, velocity, height, time)
    }

    fn hooks(&self, level: Level, squeeze: Option<Squeeze>, time: f32) -> BallHooks<'_> {
        let walls = &*self.rules.walls;
        BallHooks { physique: self.physique, walls, level, squeeze, time }
    }

    fn drive_robots(&self, state: &mut State) {
        let commands = self.commands.chunks_exact(self.columns());
        for (index, command) in commands.enumerate() {
            let motion = state.engine.motion(robot(index));
            let limits = &self.physique.robots[index].limits;
            let (force, torque) = state.robots[index].drive.pull(limits, command, &motion);
            state.engine.push(robot(index), force, torque);
        }
    }

    fn feel_loads(&self, state: &mut State, presses: &[Press]) {
        let leaning = contacts::leaning(state, presses);
        for (index, body) in self.physique.robots.iter().enumerate() {
            let motion = state.engine.motion(robot(index));
            let leans = leaning & (1 << index) != 0;
            state.robots[index].drive.feel(&body.limits, &motion, leans);
        }
    }

    fn columns(&self) -> usize {
        self.rules.command_columns.max(1)
    }
}
