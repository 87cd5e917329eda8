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

impl Tick<'_> {
    pub(crate) fn advance(
        &self,
        state: &mut State,
        scratch: &mut Scratch,
    ) -> Result<(), NonFinite> {
        let length = self.rules.config.tick;
        handling::handle_ball(state, self.physique, self.commands, self.columns(), length);
        self.drive_robots(state);
        let before = state.engine.motion(BALL);
        let z = state.ball.z;
        if state.ball.is_down() {
            self.roll(state, &before, scratch)?;
        } else {
            self.fly(state, &before, scratch)?;
        }
        state.engine.list_presses(&mut scratch.presses);
        contacts::settle_robots(
            state,
            self.physique,
            self.rules.config.blue.len(),
            &scratch.presses,
        );
        self.feel_loads(state, &scratch.presses);
        let after = state.engine.motion(BALL).position.extend(state.ball.z);
        state.crossing.watch(&self.rules.config.field, before.position.extend(z), after);
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
    ) -> Result<(), NonFinite> {
        let (ball, length) = (&self.physique.ball, self.rules.config.tick);
        let start = Rolling { velocity: before.velocity, spin: state.ball.spin };
        let (way, end) = start.after(ball, length);
        let mean = way / length;
        state.engine.set_velocity(BALL, mean);
        let squeeze = self.squeeze(state, mean);
        if let Some(squeeze) = &squeeze {
            state.engine.set_velocity(BALL, squeeze.velocity);
        }
        let hooks = self.hooks(Level::Floor, squeeze);
        state.engine.step(scratch, &hooks, &self.rules.room)?;
        let mut now = Rolling { velocity: state.engine.motion(BALL).velocity, spin: end.spin };
        if squeeze.is_some_and(|squeeze| squeeze.jammed) {
            contacts::settle_caught(state);
        } else if contacts::settle(state, self.rules, self.physique, mean, &mut now) {
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
    ) -> Result<(), NonFinite> {
        let squeeze = self.squeeze(state, before.velocity).filter(|squeeze| squeeze.jammed);
        let level = if let Some(squeeze) = &squeeze {
            state.engine.set_velocity(BALL, squeeze.velocity);
            Level::Caught { height: state.ball.z + self.physique.ball.radius }
        } else {
            Level::Air
        };
        let hooks = self.hooks(level, squeeze);
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
        let length = self.rules.config.tick;
        if squeeze.is_some() {
            flight.fall(&mut state.ball, length);
        } else {
            flight.fly(&mut state.ball, before.position, before.velocity, length);
        }
        Ok(())
    }

    /// Whether the ball, which moves with `velocity`, is caught in this tick.
    fn squeeze(&self, state: &State, velocity: Vector) -> Option<Squeeze> {
        let height = state.ball.z + self.physique.ball.radius;
        let (room, tick) = (&self.rules.room, self.rules.config.tick);
        Squeeze::find(&state.engine, self.physique, room, velocity, height, tick)
    }

    fn hooks(&self, level: Level, squeeze: Option<Squeeze>) -> BallHooks<'_> {
        let (walls, tick) = (&*self.rules.walls, self.rules.config.tick);
        BallHooks { physique: self.physique, walls, level, squeeze, tick }
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
