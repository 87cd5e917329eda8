//! What a ball and what it hits do to each other in an instant: Coulomb's law in closed form, with
//! friction and bounce solved together, momentum kept.

use rapier2d::glamx::Vec3;
use rapier2d::math::Vector;

use crate::ball_model::Surface;

/// Closing speed below which nothing bounces, m/s: pushing must not rattle.
const BOUNCE_SPEED: f32 = 0.1;

/// A ball at the instant of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    pub(crate) velocity: Vec3,
    pub(crate) spin: Vec3,
    pub(crate) radius: f32,
    pub(crate) mass: f32,
}

/// What the ball is in contact with, at the point of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Other {
    /// m/s, of the point's surface.
    pub(crate) velocity: Vec3,
    /// From its centre of mass to the point.
    pub(crate) arm: Vector,
    /// 1/kg; 0 for what cannot move. Nothing but the ball moves up or down.
    pub(crate) inverse_mass: f32,
    /// 1/(kg m²).
    pub(crate) inverse_inertia: f32,
    pub(crate) surface: Surface,
}

impl Other {
    /// A thing that does not move.
    pub(crate) fn fixed(surface: Surface) -> Self {
        Self {
            velocity: Vec3::ZERO,
            arm: Vector::ZERO,
            inverse_mass: 0.0,
            inverse_inertia: 0.0,
            surface,
        }
    }

    /// Velocity that a unit impulse along `direction` gives the point, along that direction.
    fn yields(&self, direction: Vec3) -> f32 {
        let direction = direction.truncate();
        let turn = self.arm.perp_dot(direction);
        direction.length_squared() * self.inverse_mass + turn * turn * self.inverse_inertia
    }
}

impl Sphere {
    /// Velocity of the ball's surface against the other's, where `normal` (from the other to the
    /// ball) meets it.
    fn slip(&self, other: &Other, normal: Vec3) -> Vec3 {
        self.velocity + self.spin.cross(normal * -self.radius) - other.velocity
    }

    /// Speed at which the two come closer.
    pub(crate) fn closing(&self, other: &Other, normal: Vec3) -> f32 {
        -(self.velocity - other.velocity).dot(normal)
    }

    /// Impulse along the normal that leaves what `surface` gives back of `closing`, the speed at
    /// which the two came together.
    pub(crate) fn rebound(&self, other: &Other, normal: Vec3, closing: f32) -> f32 {
        let back = if closing > BOUNCE_SPEED { other.surface.restitution * closing } else { 0.0 };
        let missing = back + self.closing(other, normal);
        (missing / (1.0 / self.mass + other.yields(normal))).max(0.0)
    }

    /// Friction impulse on the ball that goes with an impulse of `pressing` along the normal:
    /// enough to stop the slip, or as much as there is.
    pub(crate) fn friction(&self, other: &Other, normal: Vec3, pressing: f32) -> Vec3 {
        let slip = self.slip(other, normal);
        let slip = slip - normal * slip.dot(normal);
        let speed = slip.length();
        if speed <= 0.0 {
            return Vec3::ZERO;
        }
        let direction = slip / speed;
        // A solid sphere's surface gives way 3.5 times as easily as its centre.
        let stop = speed / (3.5 / self.mass + other.yields(direction));
        direction * -stop.min(other.surface.friction * pressing)
    }

    /// Takes an impulse at the point that `normal` meets.
    pub(crate) fn take(&mut self, impulse: Vec3, normal: Vec3) {
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

    fn hit(mut ball: Sphere, other: &Other) -> (Sphere, Vec3) {
        let pressing = ball.rebound(other, NORMAL, ball.closing(other, NORMAL));
        let impulse = NORMAL * pressing + ball.friction(other, NORMAL, pressing);
        ball.take(impulse, NORMAL);
        (ball, impulse)
    }

    #[test]
    fn a_steep_bounce_sticks_and_a_flat_one_slips() {
        let (steep, _) = hit(ball([4.0, 0.5]), &Other::fixed(WALL));
        assert!((steep.velocity.x + 1.2).abs() < 1e-5);
        // Rolls along the wall: 5/7 of the speed is left, the rest has become spin.
        assert!((steep.velocity.y - 0.5 * 5.0 / 7.0).abs() < 1e-5, "{steep:?}");
        assert!((steep.spin.z * 0.0215 + 0.5 * 5.0 / 7.0).abs() < 1e-4, "{steep:?}");
        let (flat, _) = hit(ball([1.0, 4.0]), &Other::fixed(WALL));
        let lost = 0.35 * 1.3;
        assert!((flat.velocity.y - (4.0 - lost)).abs() < 1e-5, "{flat:?}");
        assert!((flat.spin.z + 2.5 * lost / 0.0215).abs() < 1e-2, "{flat:?}");
    }

    #[test]
    fn a_robot_gives_way_and_momentum_is_kept() {
        let robot = Other { inverse_mass: 1.0 / 2.7, ..Other::fixed(WALL) };
        let (after, impulse) = hit(ball([2.0, 0.0]), &robot);
        let gained = impulse.x * -robot.inverse_mass;
        assert!((gained - after.velocity.x - 0.3 * 2.0).abs() < 1e-5, "{after:?}");
        assert!((0.046 * (after.velocity.x - 2.0) - 2.7 * -gained).abs() < 1e-6);
    }

    #[test]
    fn slow_contacts_do_not_bounce() {
        let (after, _) = hit(ball([0.05, 0.0]), &Other::fixed(WALL));
        assert!(after.velocity.x.abs() < 1e-7, "{after:?}");
    }
}
