//! Bounce of robots off each other and off walls, and the record of their collisions.

use crate::blocks::robot;
use crate::bodies::Undisturbed;
use crate::body_parameters::{BodyParameters, RobotParameters};
use crate::engine::{Partner, RobotContact};
use crate::math::Vector;
use crate::state::State;

/// Closing speed below which robots do not bounce off each other or off walls, m/s.
const MIN_BOUNCE_SPEED: f32 = 0.1;

/// Restitution of a wall against robots: that of robot against robot. No value is published for a
/// robot that bounces off a wall.
const WALL_RESTITUTION: f32 = 0.2;

/// Separation speed from which a contact has ended, m/s. Robots that push each other in a crowd jitter
/// by less.
const SEPARATING: f32 = 0.05;

/// Gives robots the bounce of their contacts, and records collisions with their closing speeds.
pub(super) fn resolve(
    state: &mut State,
    parameters: &BodyParameters,
    n_blue: usize,
    contacts: &[RobotContact],
    undisturbed: &[Undisturbed],
) {
    for contact in contacts {
        let closing =
            -separation_speed(state, contact, |_, index| Undisturbed::motion(undisturbed, index));
        if let Partner::Robot(other) = contact.with {
            let pair = [contact.robot, other];
            if (contact.robot < n_blue) != (other < n_blue) {
                state.touches.add_opponents(pair);
            }
            for index in pair {
                state.bodies.add_collision(index, closing);
            }
        }
        // Wheels that press a pair together, and those that resist, add to the closing speed of each tick.
        // A closing speed that is mostly theirs is that of a push, which does not bounce.
        let pressed =
            -separation_speed(state, contact, |_, index| Undisturbed::gain(undisturbed, index));
        if closing > MIN_BOUNCE_SPEED.max(2.0 * pressed) {
            bounce(state, parameters, contact, closing);
        }
    }
}

/// Bodies of the robots in sustained contact, one bit each: the partner of a contact in the last tick has not
/// separated from them.
pub(super) fn sustained(state: &State, contacts: &[RobotContact]) -> u64 {
    let lasting = contacts
        .iter()
        .filter(|contact| separation_speed(state, contact, current_motion) < SEPARATING);
    lasting.fold(0, |all, contact| {
        let other = if let Partner::Robot(other) = contact.with { 1 << robot(other) } else { 0 };
        all | 1 << robot(contact.robot) | other
    })
}

/// Velocity (m/s) and angular velocity (rad/s) of a robot now.
fn current_motion(state: &State, index: usize) -> (Vector, f32) {
    let motion = state.bodies.motion(robot(index));
    (motion.velocity, motion.angular_velocity)
}

/// Separation speed at a contact, m/s, with the velocities and angular velocities that `motion_of` returns.
fn separation_speed(
    state: &State,
    contact: &RobotContact,
    motion_of: impl Fn(&State, usize) -> (Vector, f32),
) -> f32 {
    relative_velocity(state, contact, motion_of).dot(contact.normal)
}

/// Velocity of the partner at a contact relative to that of the robot, m/s.
fn relative_velocity(
    state: &State,
    contact: &RobotContact,
    motion_of: impl Fn(&State, usize) -> (Vector, f32),
) -> Vector {
    let at = |index: usize| {
        let (velocity, angular_velocity) = motion_of(state, index);
        let arm = contact.point - state.bodies.motion(robot(index)).position;
        velocity + arm.perp() * angular_velocity
    };
    let with = if let Partner::Robot(other) = contact.with { at(other) } else { Vector::ZERO };
    with - at(contact.robot)
}

/// Applies the impulse after which a pair separates at its restitution times the closing speed, m/s, with the friction
/// that it brings. In the last sub-step of a tick the solver slows two robots down only as far as they do not overlap
/// yet, so most of a collision may be left.
fn bounce(state: &mut State, parameters: &BodyParameters, contact: &RobotContact, closing: f32) {
    let RobotContact { robot: first, with, normal, point } = *contact;
    let restitution = |index: usize| parameters.robots[index].model.restitution;
    let arm = |index: usize| point - state.bodies.motion(robot(index)).position;
    let own = Response::of(&parameters.robots[first], arm(first), normal);
    let (mean, response) = match with {
        Partner::Robot(other) => (
            restitution(first).midpoint(restitution(other)),
            own.with(Response::of(&parameters.robots[other], arm(other), normal)),
        ),
        Partner::Wall(_) => (restitution(first).midpoint(WALL_RESTITUTION), own),
    };
    let velocity = relative_velocity(state, contact, current_motion);
    let missing = mean * closing - velocity.dot(normal);
    if missing <= 0.0 {
        return;
    }
    let slip = velocity.dot(normal.perp());
    let [along, aside] = response.impulses(missing, slip, with.friction(first, parameters));
    let impulse = normal * along + normal.perp() * aside;
    let own_arm = arm(first);
    if let Partner::Robot(other) = with {
        let arm = arm(other);
        state.bodies.apply_impulse(parameters, robot(other), impulse, arm);
    }
    state.bodies.apply_impulse(parameters, robot(first), -impulse, own_arm);
}

/// Speeds of a contact point by unit impulses, 1/kg.
#[derive(Clone, Copy)]
struct Response {
    /// Along the normal by an impulse along it.
    normal: f32,
    /// Along the tangent by an impulse along it.
    tangent: f32,
    /// Along one by an impulse along the other.
    coupling: f32,
}

impl Response {
    /// That of a robot at `arm` (m) from its center.
    fn of(robot: &RobotParameters, arm: Vector, normal: Vector) -> Self {
        let tangent = normal.perp();
        Self {
            normal: robot.inverse_effective_mass(arm, normal),
            tangent: robot.inverse_effective_mass(arm, tangent),
            coupling: arm.perp_dot(normal) * arm.perp_dot(tangent) * robot.inverse_inertia,
        }
    }

    /// That of two robots against each other.
    fn with(self, other: Self) -> Self {
        Self {
            normal: self.normal + other.normal,
            tangent: self.tangent + other.tangent,
            coupling: self.coupling + other.coupling,
        }
    }

    /// Impulses along the normal and the tangent (N s) that change the speed along the normal by `missing` (m/s) and
    /// stop the `slip` (m/s), as far as `friction` can.
    fn impulses(self, missing: f32, slip: f32, friction: f32) -> [f32; 2] {
        let Self { normal, tangent, coupling } = self;
        let determinant = normal * tangent - coupling * coupling;
        let along = (tangent * missing + coupling * slip) / determinant;
        let aside = -(coupling * missing + normal * slip) / determinant;
        if aside.abs() <= friction * along {
            return [along, aside];
        }
        let ratio = friction.copysign(aside);
        // Friction on a long lever may press robots together; they do not jam.
        let along = missing / (normal + coupling * ratio).max(0.5 * normal);
        [along, ratio * along]
    }
}
