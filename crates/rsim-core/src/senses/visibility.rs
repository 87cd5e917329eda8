//! The ball as a camera at a height sees it: its place on the floor, and the part that no robot hides.

use crate::math::Vector;

/// A camera that looks down from a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lens {
    /// Point of the floor below the camera, m.
    pub(super) below: Vector,
    /// m, above 0.
    pub(super) height: f32,
}

/// A robot that may stand between the camera and the ball.
#[derive(Debug, Clone, Copy)]
pub(super) struct Obstacle {
    pub(super) position: Vector,
    pub(super) radius: f32,
    pub(super) height: f32,
}

/// Height of a camera above a body at height `z`, m. Bodies near the height of the camera are taken to be below it by
/// a tenth.
fn room_above(camera: f32, z: f32) -> f32 {
    (camera - z).max(camera / 10.0)
}

impl Lens {
    /// Bound of the length of the shadows of obstacles up to a height (m) on the floor, by their distance from the
    /// point below the camera.
    pub(super) fn shadow(self, highest: f32) -> f32 {
        highest / room_above(self.height, highest)
    }

    /// The point of the floor where the ray to a body at height `z` meets it.
    pub(super) fn on_floor(self, position: Vector, z: f32) -> Vector {
        let room = room_above(self.height, z);
        self.below + (position - self.below) * (self.height / room)
    }

    /// The part of a ball of `radius` around `position`, with its center at height `z`, that an obstacle
    /// leaves to see.
    ///
    /// At the height of the ball's center an upright cylinder hides what lies within its radius of the line
    /// from its foot to the shadow of its top.
    pub(super) fn visible_part(
        self,
        position: Vector,
        z: f32,
        radius: f32,
        obstacle: Obstacle,
    ) -> f32 {
        let above = obstacle.height - z;
        if above <= 0.0 {
            return 1.0;
        }
        let room = room_above(self.height, obstacle.height);
        let shadow = (obstacle.position - self.below) * (above / room);
        let offset = position - obstacle.position;
        let along = offset.dot(shadow) / shadow.length_squared().max(f32::MIN_POSITIVE);
        let distance = (offset - shadow * along.clamp(0.0, 1.0)).length();
        (0.5 + (distance - obstacle.radius) / (2.0 * radius)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENS: Lens = Lens { below: Vector::ZERO, height: 4.0 };
    const RADIUS: f32 = 0.0215;

    fn part(robot: Vector, ball: Vector, z: f32) -> f32 {
        let obstacle = Obstacle { position: robot, radius: 0.09, height: 0.15 };
        LENS.visible_part(ball, z, RADIUS, obstacle)
    }

    #[test]
    fn a_flying_ball_is_seen_farther_away_from_the_camera() {
        let seen = LENS.on_floor(Vector::new(2.0, 1.0), 1.0);
        assert!((seen - Vector::new(2.0, 1.0) * (4.0 / 3.0)).length() < 1e-6);
        assert_eq!(LENS.on_floor(Vector::new(2.0, 1.0), 0.0), Vector::new(2.0, 1.0));
        assert!(LENS.on_floor(Vector::new(2.0, 1.0), 5.0).is_finite());
    }

    #[test]
    fn a_robot_hides_the_ball_behind_it_and_not_the_one_before_it() {
        let robot = Vector::new(2.0, 0.0);
        let touching = 0.09 + RADIUS;
        assert!(part(robot, Vector::new(2.0 + touching, 0.0), RADIUS) < 0.1);
        assert!((part(robot, Vector::new(2.0 - touching, 0.0), RADIUS) - 1.0).abs() < 1e-5);
        assert!((part(robot, Vector::new(2.0, touching), RADIUS) - 1.0).abs() < 1e-5);
        assert!((part(robot, Vector::new(2.3, 0.0), RADIUS) - 1.0).abs() < 1e-5, "the shadow ends");
    }

    #[test]
    fn the_part_grows_with_the_distance_and_a_high_ball_is_seen() {
        let parts = [0.07, 0.09, 0.1, 0.2].map(|y| part(Vector::ZERO, Vector::new(0.0, y), RADIUS));
        assert!(parts.windows(2).all(|pair| pair[0] <= pair[1]), "{parts:?}");
        assert!((parts[1] - 0.5).abs() < 1e-5);
        assert!((part(Vector::ZERO, Vector::ZERO, 0.16) - 1.0).abs() < 1e-6);
    }
}
