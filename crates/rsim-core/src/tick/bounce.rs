//! The rest of a tick after a bounce of the ball.
//!
//! The engine solves a tick without bounce, so in it the ball stays at the surface that it hit until the tick ends,
//! and goes along with a robot that gives way. Its bounce is known only then. So the ball is moved to where it
//! would be had it bounced at the contact.

use crate::ball::rolling::GroundMotion;
use crate::blocks::{BALL, robot, set_bits};
use crate::body_parameters::BodyParameters;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::state::{Setup, State};

/// The way of the ball in a tick if it met nothing.
pub(super) struct FreeWay {
    /// Its beginning, m.
    pub(super) start: Vector,
    /// m/s.
    pub(super) velocity: Vector,
    /// s.
    pub(super) time: f32,
}

impl FreeWay {
    /// Time after the contact, s, of a ball that the engine left at `position` with `velocity`: the time in which
    /// the change of velocity led there.
    fn time_after_contact(&self, position: Vector, velocity: Vector) -> f32 {
        let change = velocity - self.velocity;
        let aside = position - (self.start + self.velocity * self.time);
        // Contacts at opposite sides may cancel.
        let square = change.length_squared().max(f32::MIN_POSITIVE);
        (aside.dot(change) / square).clamp(0.0, self.time)
    }
}

/// Moves a ball with the motion `bounced` at its contact to the end of the tick. Returns its motion there.
pub(super) fn go_on(
    state: &mut State,
    setup: &Setup,
    parameters: &BodyParameters,
    free: &FreeWay,
    bounced: GroundMotion,
) -> GroundMotion {
    let Motion { position, velocity, .. } = state.bodies.motion(BALL);
    let time = free.time_after_contact(position, velocity);
    let (displacement, end) = bounced.after(&parameters.ball, time);
    let missing = displacement - velocity * time;
    let length = missing.length();
    if length > 0.0 {
        let direction = missing / length;
        let clear = clear_length(state, setup, parameters, direction, length);
        state.bodies.set_ball(position + direction * clear, velocity);
    }
    end
}

/// Way that the ball can move in a direction without coming nearer to a body than to touch it, m, at most `length`.
///
/// The distance to a convex body does not shrink on a way that leads away from its nearest point, and nowhere by more
/// than the length of the way.
fn clear_length(
    state: &State,
    setup: &Setup,
    parameters: &BodyParameters,
    direction: Vector,
    length: f32,
) -> f32 {
    let (center, radius) = (state.bodies.motion(BALL).position, parameters.ball.radius);
    let robots = set_bits(state.bodies.robots_near_ball(parameters, length)).map(|index| {
        let motion = state.bodies.motion(robot(index));
        let outline = &parameters.robots[index].outline;
        outline.nearest_at(motion.position, motion.rotation(), center)
    });
    let walls = setup.free_space.walls_near(center, radius + length);
    let all = robots.chain(walls.map(|wall| wall.outline.nearest(center)));
    let ahead = all.filter(|nearest| nearest.normal.dot(direction) < 0.0);
    ahead.fold(length, |clear, nearest| clear.min((nearest.distance - radius).max(0.0)))
}
