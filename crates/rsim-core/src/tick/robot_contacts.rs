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
        let meeting = Meeting::of(state, contact);
        let closing = -meeting.separation_speed(|index| Undisturbed::motion(undisturbed, index));
        if let Partner::Robot(other) = contact.with {
            let pair = [contact.robot, other];
            if (contact.robot < n_blue) != (other < n_blue) {
                state.touches.add_opponents(pair);
            }
            for index in pair {
                state.bodies.add_collision(index, closing);
            }
        }
        if closing <= MIN_BOUNCE_SPEED {
            continue;
        }
        // Wheels that press a pair together, and those that resist, add to the closing speed of each tick.
        // A closing speed that is mostly theirs is that of a push, which does not bounce.
        let pressed = -meeting.separation_speed(|index| Undisturbed::gain(undisturbed, index));
        if closing > 2.0 * pressed {
            meeting.bounce(state, parameters, closing);
        }
    }
}

/// Bodies of the robots in sustained contact, one bit each: the partner of a contact in the last tick has not
/// separated from them.
pub(super) fn sustained(state: &State, contacts: &[RobotContact]) -> u64 {
    let lasting = contacts.iter().filter(|contact| {
        let motion = |index| current_motion(state, index);
        Meeting::of(state, contact).separation_speed(motion) < SEPARATING
    });
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

/// A contact, and where it is on both parties.
#[derive(Clone, Copy)]
struct Meeting<'a> {
    contact: &'a RobotContact,
    /// From the centers of the robot and of its partner to the point, m. A wall has none.
    arms: [Vector; 2],
}

impl<'a> Meeting<'a> {
    fn of(state: &State, contact: &'a RobotContact) -> Self {
        let arm = |index: usize| contact.point - state.bodies.motion(robot(index)).position;
        let met = if let Partner::Robot(other) = contact.with { arm(other) } else { Vector::ZERO };
        Self { contact, arms: [arm(contact.robot), met] }
    }

    /// Separation speed, m/s, with the velocities and angular velocities that `motion_of` returns.
    fn separation_speed(&self, motion_of: impl Fn(usize) -> (Vector, f32)) -> f32 {
        self.relative_velocity(motion_of).dot(self.contact.normal)
    }

    /// Velocity of the partner relative to that of the robot, m/s.
    fn relative_velocity(&self, motion_of: impl Fn(usize) -> (Vector, f32)) -> Vector {
        let at = |index: usize, arm: Vector| {
            let (velocity, angular_velocity) = motion_of(index);
            velocity + arm.perp() * angular_velocity
        };
        let Self { contact, arms: [own, met] } = *self;
        let with =
            if let Partner::Robot(other) = contact.with { at(other, met) } else { Vector::ZERO };
        with - at(contact.robot, own)
    }

    /// Applies the impulse after which a pair separates at its restitution times the closing speed, m/s, with the
    /// friction that it brings. In the last sub-step of a tick the solver slows two robots down only as far as they do
    /// not overlap yet, so most of a collision may be left.
    fn bounce(&self, state: &mut State, parameters: &BodyParameters, closing: f32) {
        let Self { contact, arms: [own_arm, met_arm] } = *self;
        let RobotContact { robot: first, with, normal, .. } = *contact;
        let velocity = self.relative_velocity(|index| current_motion(state, index));
        let missing = self.restitution(parameters) * closing - velocity.dot(normal);
        if missing <= 0.0 {
            return;
        }
        let slip = velocity.dot(normal.perp());
        let friction = with.friction(first, parameters);
        let [along, aside] = self.response(parameters).impulses(missing, slip, friction);
        let impulse = normal * along + normal.perp() * aside;
        if let Partner::Robot(other) = with {
            state.bodies.apply_impulse(parameters, robot(other), impulse, met_arm);
        }
        state.bodies.apply_impulse(parameters, robot(first), -impulse, own_arm);
    }

    fn restitution(&self, parameters: &BodyParameters) -> f32 {
        let of = |index: usize| parameters.robots[index].model.restitution;
        let met = if let Partner::Robot(other) = self.contact.with {
            of(other)
        } else {
            WALL_RESTITUTION
        };
        of(self.contact.robot).midpoint(met)
    }

    fn response(&self, parameters: &BodyParameters) -> Response {
        let Self { contact, arms: [own_arm, met_arm] } = *self;
        let of = |index: usize, arm: Vector| {
            Response::of(&parameters.robots[index], arm, contact.normal)
        };
        let own = of(contact.robot, own_arm);
        if let Partner::Robot(other) = contact.with { own.with(of(other, met_arm)) } else { own }
    }
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
