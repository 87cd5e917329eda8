//! Clearance of a flying ball: the distance of a sphere beside, above or below upright bodies.

use crate::geometry::outline::NearestPoint;
use crate::math::Vec3;

/// An obstacle of a flying ball.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Obstacle {
    Floor,
    Wall(usize),
    Robot(usize),
}

/// Distance of the ball's surface from an obstacle, with its direction.
pub(crate) struct Clearance {
    /// m; negative inside.
    pub(crate) distance: f32,
    /// Unit vector from the obstacle to the ball.
    pub(crate) normal: Vec3,
}

impl Clearance {
    /// Clearance of a ball of `radius`, whose center is at height `z`, from an upright body between two
    /// heights; `nearest` is the nearest point of the body's outline.
    pub(crate) fn of_upright(
        nearest: &NearestPoint,
        [bottom, top]: [f32; 2],
        z: f32,
        radius: f32,
    ) -> Self {
        // Height above the top, or negative below the bottom; 0 beside the body.
        let beyond = if z > top { z - top } else { (z - bottom).min(0.0) };
        if beyond == 0.0 {
            return Clearance {
                distance: nearest.distance - radius,
                normal: nearest.normal.extend(0.0),
            };
        }
        if nearest.distance <= 0.0 {
            let normal = Vec3::Z * 1.0_f32.copysign(beyond);
            return Clearance { distance: beyond.abs() - radius, normal };
        }
        let offset = (nearest.normal * nearest.distance).extend(beyond);
        let distance = offset.length();
        Clearance { distance: distance - radius, normal: offset / distance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vector;

    /// A ball of 20 mm beside a body from 0 to 0.1 m.
    fn clearance(distance: f32, z: f32) -> Clearance {
        Clearance::of_upright(&NearestPoint { distance, normal: Vector::X }, [0.0, 0.1], z, 0.02)
    }

    #[test]
    fn beside_above_and_over_the_edge() {
        let beside = clearance(0.05, 0.09);
        assert!((beside.distance - 0.03).abs() < 1e-6 && beside.normal == Vec3::X);
        let above = clearance(-0.01, 0.13);
        assert!((above.distance - 0.01).abs() < 1e-6 && above.normal == Vec3::Z);
        let edge = clearance(0.03, 0.14);
        assert!((edge.distance - 0.03).abs() < 1e-6, "{}", edge.distance);
        assert!((edge.normal - Vec3::new(0.6, 0.0, 0.8)).length() < 1e-5, "{}", edge.normal);
    }

    #[test]
    fn a_crossbar_is_touched_from_below() {
        let bar = NearestPoint { distance: -0.01, normal: Vector::X };
        let below = Clearance::of_upright(&bar, [0.16, 0.18], 0.12, 0.02);
        assert!((below.distance - 0.02).abs() < 1e-6 && below.normal == -Vec3::Z);
    }
}
