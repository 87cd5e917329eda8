//! What a flying ball can meet, and how near it is to that: a sphere beside, above or below upright
//! bodies.

use rapier2d::glamx::Vec3;

use crate::outline::Nearest;

/// What the ball can meet.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Obstacle {
    Floor,
    Wall(usize),
    Robot(usize),
}

/// Where the ball's surface is nearest to an obstacle.
pub(crate) struct Near {
    /// m; negative inside.
    pub(crate) distance: f32,
    /// From the obstacle to the ball.
    pub(crate) normal: Vec3,
}

impl Near {
    /// Of a ball of `radius`, whose centre is at height `z`, to an upright body between two heights;
    /// `nearest` is what its outline has nearest.
    pub(crate) fn of_upright(
        nearest: &Nearest,
        [bottom, top]: [f32; 2],
        z: f32,
        radius: f32,
    ) -> Self {
        // Above the top or under the bottom, else level with it.
        let beyond = if z > top { z - top } else { (z - bottom).min(0.0) };
        if beyond == 0.0 {
            return Near {
                distance: nearest.distance - radius,
                normal: nearest.normal.extend(0.0),
            };
        }
        if nearest.distance <= 0.0 {
            let normal = Vec3::Z * 1.0_f32.copysign(beyond);
            return Near { distance: beyond.abs() - radius, normal };
        }
        let offset = (nearest.normal * nearest.distance).extend(beyond);
        let distance = offset.length();
        Near { distance: distance - radius, normal: offset / distance }
    }
}

#[cfg(test)]
mod tests {
    use rapier2d::math::Vector;

    use super::*;

    /// A ball of 20 mm beside a body from 0 to 0.1 m.
    fn near(distance: f32, z: f32) -> Near {
        Near::of_upright(&Nearest { distance, normal: Vector::X }, [0.0, 0.1], z, 0.02)
    }

    #[test]
    fn beside_above_and_over_the_edge() {
        let beside = near(0.05, 0.09);
        assert!((beside.distance - 0.03).abs() < 1e-6 && beside.normal == Vec3::X);
        let above = near(-0.01, 0.13);
        assert!((above.distance - 0.01).abs() < 1e-6 && above.normal == Vec3::Z);
        let edge = near(0.03, 0.14);
        assert!((edge.distance - 0.03).abs() < 1e-6, "{}", edge.distance);
        assert!((edge.normal - Vec3::new(0.6, 0.0, 0.8)).length() < 1e-5, "{}", edge.normal);
    }

    #[test]
    fn a_bar_is_met_from_below() {
        let bar = Nearest { distance: -0.01, normal: Vector::X };
        let below = Near::of_upright(&bar, [0.16, 0.18], 0.12, 0.02);
        assert!((below.distance - 0.02).abs() < 1e-6 && below.normal == -Vec3::Z);
    }
}
