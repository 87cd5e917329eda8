//! Bounce of robots off each other and off walls, and the record of their collisions.

use crate::blocks::robot;
use crate::bodies::Undisturbed;
use crate::body_parameters::BodyParameters;
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
    let at = |index: usize| {
        let (velocity, angular_velocity) = motion_of(state, index);
        let arm = contact.point - state.bodies.motion(robot(index)).position;
        velocity + arm.perp() * angular_velocity
    };
    let with = if let Partner::Robot(other) = contact.with { at(other) } else { Vector::ZERO };
    (with - at(contact.robot)).dot(contact.normal)
}

/// Applies the impulse after which a pair separates at its restitution times the closing speed, m/s.
fn bounce(state: &mut State, parameters: &BodyParameters, contact: &RobotContact, closing: f32) {
    let RobotContact { robot: first, with, normal, point } = *contact;
    let restitution = |index: usize| parameters.robots[index].model.restitution;
    let arm = |index: usize| point - state.bodies.motion(robot(index)).position;
    let inverse_mass =
        |index: usize| parameters.robots[index].inverse_effective_mass(arm(index), normal);
    let (mean, inverse_mass) = match with {
        Partner::Robot(other) => (
            restitution(first).midpoint(restitution(other)),
            inverse_mass(first) + inverse_mass(other),
        ),
        Partner::Wall(_) => (restitution(first).midpoint(WALL_RESTITUTION), inverse_mass(first)),
    };
    let separating = separation_speed(state, contact, current_motion);
    let impulse = normal * ((mean * closing - separating) / inverse_mass).max(0.0);
    let own_arm = arm(first);
    if let Partner::Robot(other) = with {
        let arm = arm(other);
        state.bodies.apply_impulse(parameters, robot(other), impulse, arm);
    }
    state.bodies.apply_impulse(parameters, robot(first), -impulse, own_arm);
}
