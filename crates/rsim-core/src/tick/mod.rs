//! One physics tick: robots handle the ball and drive, the ball moves by its law, contacts are
//! solved, touches and crossings are recorded.

mod ball_contacts;
mod bounce;
mod commands;
mod flight;
mod handling;
mod robot_contacts;
mod squeeze;

use crate::ball::rolling::GroundMotion;
use crate::blocks::{BALL, LANES};
use crate::bodies::FastestRobot;
use crate::body_parameters::BodyParameters;
use crate::engine::{BallPhase, BallRules, NonFinite, RobotContact, Scratch, SqueezedBall};
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::state::{Setup, State};
use crate::tick::bounce::FreeWay;
use crate::tick::flight::Flight;
use crate::tick::squeeze::Squeeze;
pub(crate) use commands::{CommandErrors, StepCommands};

/// Version of the physics, raised whenever the same start and commands would give other states.
pub const PHYSICS_VERSION: u32 = 9;

/// Inputs of a tick.
pub(crate) struct Tick<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) parameters: &'a BodyParameters,
    pub(crate) commands: &'a StepCommands,
}

/// A part of a tick, or all of it.
struct Part {
    /// s.
    length: f32,
    /// Whether the ball can be squeezed in it.
    may_squeeze: bool,
    /// Of the robots when it begins.
    fastest: FastestRobot,
}

/// Speed of the ball or of a surface around it, m/s, above which a squeeze is solved in parts of the
/// tick. The ball slides along rotating outlines, which one linear prediction for a whole tick misses,
/// and it may slip out within the tick: jammed for whole ticks, the ball between two SSL robots that
/// chase it moves 5% slower.
const FAST_SQUEEZE: f32 = 1.5;
const SQUEEZE_PARTS: u8 = 4;

impl Tick<'_> {
    pub(crate) fn advance(
        &self,
        state: &mut State,
        scratch: &mut Scratch,
    ) -> Result<(), NonFinite> {
        let length = self.setup.config.tick;
        handling::handle_ball(state, self.parameters, self.commands, length);
        self.drive_robots(state);
        let ball = state.bodies.motion(BALL);
        let before = ball.position.extend(state.ball.z);
        let whole = Part { length, may_squeeze: true, fastest: state.bodies.fastest_robot() };
        let squeeze = self.squeeze(state, ball.velocity, &whole);
        let may_squeeze = squeeze.is_some();
        if squeeze.is_some_and(|squeeze| squeeze.speed > FAST_SQUEEZE) {
            for _ in 0..SQUEEZE_PARTS {
                let length = length / f32::from(SQUEEZE_PARTS);
                let fastest = state.bodies.fastest_robot();
                self.move_bodies(state, scratch, &Part { length, may_squeeze, fastest })?;
            }
        } else {
            self.move_bodies(state, scratch, &Part { may_squeeze, ..whole })?;
        }
        estimate_loads(state, &scratch.contacts.robots);
        let after = state.bodies.motion(BALL).position.extend(state.ball.z);
        state.crossing.update(&self.setup.config.field, before, after);
        let State { touches, ball, bodies, .. } = state;
        touches.end_tick(ball.z, || bodies.motion(BALL).velocity.extend(ball.v_z).length());
        Ok(())
    }

    /// Moves all bodies for a part of the tick and resolves their contacts.
    fn move_bodies(
        &self,
        state: &mut State,
        scratch: &mut Scratch,
        part: &Part,
    ) -> Result<(), NonFinite> {
        let before = state.bodies.motion(BALL);
        if state.ball.is_down() {
            self.roll(state, &before, scratch, part)?;
        } else {
            self.fly(state, &before, scratch, part)?;
        }
        robot_contacts::resolve(
            state,
            self.parameters,
            self.setup.config.blue.len(),
            &scratch.contacts.robots,
            &scratch.undisturbed,
        );
        Ok(())
    }

    /// Moves all bodies with the ball on the floor.
    ///
    /// The engine moves the ball with its *mean* velocity over `length`; afterwards the ball gets the
    /// difference to the *end* velocity added to the engine's result. So the path is exact for any
    /// tick, and a push changes nothing about the law. After a bounce the law starts anew from the contact.
    fn roll(
        &self,
        state: &mut State,
        before: &Motion,
        scratch: &mut Scratch,
        part: &Part,
    ) -> Result<(), NonFinite> {
        let Part { length, may_squeeze, fastest } = *part;
        let ball = &self.parameters.ball;
        let start = GroundMotion { velocity: before.velocity, spin: state.ball.spin };
        let (displacement, end) = start.after(ball, length);
        let mean = displacement / length;
        state.bodies.set_velocity(BALL, mean);
        let squeeze = if may_squeeze { self.squeeze(state, mean, part) } else { None };
        if let Some(squeeze) = &squeeze {
            state.bodies.set_velocity(BALL, squeeze.velocity);
        }
        let squeezed = squeeze.map(|squeeze| squeeze.solver);
        let rules = self.ball_rules(BallPhase::Floor, squeezed, length);
        state.engine.step(&mut state.bodies, scratch, &rules, &self.setup.free_space, fastest)?;
        let mut now = GroundMotion { velocity: state.bodies.motion(BALL).velocity, spin: end.spin };
        if squeezed.is_some_and(|squeezed| squeezed.jammed) {
            ball_contacts::record_touches(&mut state.touches, &scratch.contacts.ball);
        } else if ball_contacts::resolve(
            state,
            self.setup,
            self.parameters,
            mean,
            &mut now,
            scratch,
        ) {
            let free = FreeWay { start: before.position, velocity: mean, time: length };
            now = bounce::go_on(state, self.setup, self.parameters, &free, now);
        } else {
            now.velocity += end.velocity - mean;
        }
        state.bodies.set_velocity(BALL, now.velocity);
        state.ball.spin = now.spin;
        Ok(())
    }

    /// Moves all bodies with the ball in the air; the others stay in the plane.
    fn fly(
        &self,
        state: &mut State,
        before: &Motion,
        scratch: &mut Scratch,
        part: &Part,
    ) -> Result<(), NonFinite> {
        let Part { length, may_squeeze, fastest } = *part;
        let squeeze = if may_squeeze { self.squeeze(state, before.velocity, part) } else { None };
        let squeeze = squeeze.filter(|squeeze| squeeze.solver.jammed);
        let phase = if let Some(squeeze) = &squeeze {
            state.bodies.set_velocity(BALL, squeeze.velocity);
            BallPhase::JammedInAir { height: state.ball.z + self.parameters.ball.radius }
        } else {
            BallPhase::Air
        };
        let rules = self.ball_rules(phase, squeeze.map(|squeeze| squeeze.solver), length);
        state.engine.step(&mut state.bodies, scratch, &rules, &self.setup.free_space, fastest)?;
        if squeeze.is_some() {
            ball_contacts::record_touches(&mut state.touches, &scratch.contacts.ball);
        }
        let flight = Flight {
            parameters: self.parameters,
            walls: &self.setup.walls,
            bodies: &mut state.bodies,
            touches: &mut state.touches,
        };
        if squeeze.is_some() {
            flight.fall(&mut state.ball, length);
        } else {
            flight.fly(&mut state.ball, before.position, before.velocity, length);
        }
        Ok(())
    }

    /// The squeeze of a ball that moves with `velocity` within a part of the tick, if any.
    fn squeeze(&self, state: &State, velocity: Vector, part: &Part) -> Option<Squeeze> {
        let height = state.ball.z + self.parameters.ball.radius;
        let free_space = &self.setup.free_space;
        let Part { length, fastest, .. } = *part;
        Squeeze::find(&state.bodies, self.parameters, free_space, velocity, height, length, fastest)
    }

    fn ball_rules(
        &self,
        phase: BallPhase,
        squeezed: Option<SqueezedBall>,
        time: f32,
    ) -> BallRules<'_> {
        BallRules { parameters: self.parameters, walls: &self.setup.walls, phase, squeezed, time }
    }

    fn drive_robots(&self, state: &mut State) {
        let wheels = self.parameters.wheels.iter().zip(self.commands.targets());
        for (block, (wheels, targets)) in state.bodies.blocks.iter_mut().zip(wheels) {
            block.acceleration = block.drive.accelerate(wheels, targets, &block.motion);
        }
    }
}

/// Estimates the loads of the tick on robots whose `contacts` last.
fn estimate_loads(state: &mut State, contacts: &[RobotContact]) {
    let in_contact = robot_contacts::sustained(state, contacts);
    for (index, block) in state.bodies.blocks.iter_mut().enumerate() {
        block.drive.estimate_loads(&block.motion, in_contact >> (index * LANES));
    }
}
