//! Impact of the ball on a body: Coulomb's law in closed form, with friction and restitution solved
//! together and momentum conserved.

use crate::math::{Vec3, Vector};
use crate::models::ball::Surface;

/// Closing speed below which the ball does not bounce, m/s: pushing must not rattle.
const MIN_BOUNCE_SPEED: f32 = 0.1;

/// A ball at the instant of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    pub(crate) velocity: Vec3,
    pub(crate) spin: Vec3,
    pub(crate) radius: f32,
    pub(crate) mass: f32,
}

/// A body at the point where the ball touches it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContactBody {
    /// Velocity of the surface at the point, m/s.
    pub(crate) velocity: Vec3,
    /// Vector from the center of mass to the point, m.
    pub(crate) arm: Vector,
    /// 1/kg; 0 for a fixed body. Only the ball moves vertically.
    pub(crate) inverse_mass: f32,
    /// 1/(kg m²).
    pub(crate) inverse_inertia: f32,
    pub(crate) surface: Surface,
}

impl ContactBody {
    /// A body that does not move.
    pub(crate) fn fixed(surface: Surface) -> Self {
        Self {
            velocity: Vec3::ZERO,
            arm: Vector::ZERO,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            surface,
        }
    }

    /// Inverse effective mass of the point along `direction`, 1/kg: the velocity that a unit impulse
    /// gives it.
    fn inverse_effective_mass(&self, direction: Vec3) -> f32 {
        let direction = direction.truncate();
        let turn = self.arm.perp_dot(direction);
        direction.length_squared() * self.inverse_mass + turn * turn * self.inverse_inertia
    }
}

impl Sphere {
    /// Slip velocity of the ball's surface against the other's at the contact, m/s. `normal` is the
    /// unit vector from the other body to the ball.
    fn slip(&self, other: &ContactBody, normal: Vec3) -> Vec3 {
        self.velocity + self.spin.cross(normal * -self.radius) - other.velocity
    }

    /// Closing speed of the two, m/s.
    pub(crate) fn closing(&self, other: &ContactBody, normal: Vec3) -> f32 {
        -(self.velocity - other.velocity).dot(normal)
    }

    /// Normal impulse, N s, after which the two separate at the restitution times `closing`, the speed
    /// (m/s) at which they came together.
    pub(crate) fn rebound(&self, other: &ContactBody, normal: Vec3, closing: f32) -> f32 {
        let back =
            if closing > MIN_BOUNCE_SPEED { other.surface.restitution * closing } else { 0.0 };
        let missing = back + self.closing(other, normal);
        (missing / (1.0 / self.mass + other.inverse_effective_mass(normal))).max(0.0)
    }

    /// Friction impulse on the ball, N s, for a normal impulse: enough to stop the slip, or the maximum
    /// by Coulomb's law.
    pub(crate) fn friction(&self, other: &ContactBody, normal: Vec3, normal_impulse: f32) -> Vec3 {
        let slip = self.slip(other, normal);
        let slip = slip - normal * slip.dot(normal);
        let speed = slip.length();
        if speed <= 0.0 {
            return Vec3::ZERO;
        }
        let direction = slip / speed;
        // The inverse effective mass at a solid sphere's surface is 3.5 times that of its center.
        let stop = speed / (3.5 / self.mass + other.inverse_effective_mass(direction));
        direction * -stop.min(other.surface.friction * normal_impulse)
    }

    /// Applies an impulse (N s) at the contact point.
    pub(crate) fn apply_impulse(&mut self, impulse: Vec3, normal: Vec3) {
        self.velocity += impulse / self.mass;
        let inertia = 0.4 * self.mass * self.radius * self.radius;
        self.spin += (normal * -self.radius).cross(impulse) / inertia;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WALL: Surface = Surface { restitution: 0.3, friction: 0.35 };
    const NORMAL: Vec3 = Vec3::new(-1.0, 0.0, 0.0);

    fn ball(velocity: [f32; 2]) -> Sphere {
        let velocity = Vec3::new(velocity[0], velocity[1], 0.0);
        Sphere { velocity, spin: Vec3::ZERO, radius: 0.0215, mass: 0.046 }
    }

    fn hit(mut ball: Sphere, other: &ContactBody) -> (Sphere, Vec3) {
        let rebound = ball.rebound(other, NORMAL, ball.closing(other, NORMAL));
        let impulse = NORMAL * rebound + ball.friction(other, NORMAL, rebound);
        ball.apply_impulse(impulse, NORMAL);
        (ball, impulse)
    }

    #[test]
    fn a_steep_bounce_sticks_and_a_flat_one_slips() {
        let (steep, _) = hit(ball([4.0, 0.5]), &ContactBody::fixed(WALL));
        assert!((steep.velocity.x + 1.2).abs() < 1e-5);
        // The ball rolls along the wall: 5/7 of the speed remains, the rest has become spin.
        assert!((steep.velocity.y - 0.5 * 5.0 / 7.0).abs() < 1e-5, "{steep:?}");
        assert!((steep.spin.z * 0.0215 + 0.5 * 5.0 / 7.0).abs() < 1e-4, "{steep:?}");
        let (flat, _) = hit(ball([1.0, 4.0]), &ContactBody::fixed(WALL));
        let lost = 0.35 * 1.3;
        assert!((flat.velocity.y - (4.0 - lost)).abs() < 1e-5, "{flat:?}");
        assert!((flat.spin.z + 2.5 * lost / 0.0215).abs() < 1e-2, "{flat:?}");
    }

    #[test]
    fn a_robot_recoils_and_momentum_is_conserved() {
        let robot = ContactBody { inverse_mass: 1.0 / 2.7, ..ContactBody::fixed(WALL) };
        let (after, impulse) = hit(ball([2.0, 0.0]), &robot);
        let gained = impulse.x * -robot.inverse_mass;
        assert!((gained - after.velocity.x - 0.3 * 2.0).abs() < 1e-5, "{after:?}");
        assert!((0.046 * (after.velocity.x - 2.0) - 2.7 * -gained).abs() < 1e-6);
    }

    #[test]
    fn slow_contacts_do_not_bounce() {
        let (after, _) = hit(ball([0.05, 0.0]), &ContactBody::fixed(WALL));
        assert!(after.velocity.x.abs() < 1e-7, "{after:?}");
    }
}
