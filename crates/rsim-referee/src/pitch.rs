//! Constants of the world that the rules read: field, sizes of bodies, time step.

use serde::{Deserialize, Serialize};

use crate::lines::Lines;
use crate::vector::Vector;

/// Room between bodies that are placed, m: more than rounding.
pub(crate) const ROOM: f32 = 0.001;

/// Field, sizes of bodies and time step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pitch {
    /// Lines of the field.
    pub lines: Lines,
    /// Radius of a robot, m.
    pub robot_radius: f32,
    /// Radius of the ball, m.
    pub ball_radius: f32,
    /// Duration of a control step, s.
    pub time_step: f32,
}

impl Pitch {
    /// Control steps in a time of at least 0 s; rounded.
    #[allow(clippy::cast_possible_truncation)] // far below 2^31
    pub fn steps(&self, seconds: f32) -> i32 {
        (seconds / self.time_step + 0.5) as i32
    }

    /// Seconds in control steps.
    #[allow(clippy::cast_precision_loss)] // below 2^24
    pub fn seconds(&self, steps: i32) -> f32 {
        steps as f32 * self.time_step
    }

    /// Whether a robot at a place is within the outer walls, and clear of the walls of the goals. A robot in a
    /// goal stays on its line.
    pub(crate) fn has_room(&self, place: Vector) -> bool {
        let radius = self.robot_radius + ROOM;
        let (x, y) = (place.x.abs(), place.y.abs());
        y <= self.lines.boundary_y - radius
            && !self.is_in_corner(x, y, radius)
            && self.is_clear_of_goals(x, y, radius)
    }

    /// Whether a body touches the block in a corner, in the quarter of positive numbers.
    fn is_in_corner(&self, x: f32, y: f32, radius: f32) -> bool {
        let lines = &self.lines;
        let diagonal = lines.half_length + lines.half_width - lines.corner_leg;
        lines.corner_leg > 0.0 && x + y > diagonal - std::f32::consts::SQRT_2 * radius
    }

    /// Whether a body stands before the goal line, in the mouth of a goal, or beside a goal that stands free.
    /// The goals of a table are pockets in its wall.
    fn is_clear_of_goals(&self, x: f32, y: f32, radius: f32) -> bool {
        let lines = &self.lines;
        let from_post = (y - lines.half_goal_width).abs() - lines.goal_wall_thickness;
        let in_mouth = y < lines.half_goal_width && x <= lines.half_length;
        let beside_goal = y > lines.half_goal_width
            && lines.goal_wall_thickness > 0.0
            && x <= lines.boundary_x - radius;
        x + radius <= lines.half_length || from_post >= radius && (in_mouth || beside_goal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lines::tests::SSL_B;

    fn pitch(lines: Lines) -> Pitch {
        Pitch { lines, robot_radius: 0.09, ball_radius: 0.0215, time_step: 0.025 }
    }

    /// Whether a robot has room at a place in all quarters.
    fn has_room(pitch: &Pitch, x: f32, y: f32) -> bool {
        let found =
            [(x, y), (-x, y), (x, -y), (-x, -y)].map(|(x, y)| pitch.has_room(Vector::new(x, y)));
        assert!(found.iter().all(|has| *has == found[0]), "{x} {y}");
        found[0]
    }

    #[test]
    fn robots_have_room_within_the_walls() {
        let pitch = pitch(SSL_B);
        for (x, y, expected) in [
            (0.0, 0.0, true),
            (4.7085, 2.0, true),
            (4.7095, 2.0, false),
            (0.0, 3.2085, true),
            (0.0, 3.2095, false),
            (4.7085, 3.2085, true),
        ] {
            assert_eq!(has_room(&pitch, x, y), expected, "{x} {y}");
        }
    }

    #[test]
    fn robots_have_no_room_in_the_walls_of_goals_and_behind_the_line() {
        let pitch = pitch(SSL_B);
        for (x, y, expected) in [
            (4.4085, 0.5, true),
            (4.4095, 0.5, false),
            (4.45, 0.45, false),
            (4.45, 0.3885, true),
            (4.45, 0.3895, false),
            (4.50, 0.0, true),
            (4.51, 0.0, false),
            (4.60, 0.6105, false),
            (4.60, 0.6115, true),
        ] {
            assert_eq!(has_room(&pitch, x, y), expected, "{x} {y}");
        }
    }

    #[test]
    fn robots_have_no_room_in_corners_with_blocks() {
        let leg = 0.5;
        let pitch = pitch(Lines { corner_leg: leg, ..SSL_B });
        // The middle of the block's face, and a step toward the center of the field.
        let middle = Vector::new(4.5 - leg / 2.0, 3.0 - leg / 2.0);
        for (way, expected) in [(0.0, false), (0.08, false), (0.10, true)] {
            let aside = way * std::f32::consts::FRAC_1_SQRT_2;
            assert_eq!(has_room(&pitch, middle.x - aside, middle.y - aside), expected, "{way}");
        }
        assert!(has_room(&pitch, 0.0, 2.9) && has_room(&pitch, 4.3, 0.0));
    }

    #[test]
    fn times_are_rounded_to_steps() {
        let pitch = pitch(SSL_B);
        assert_eq!([0.0, 0.012, 0.013, 10.0].map(|seconds| pitch.steps(seconds)), [0, 0, 1, 400]);
        assert!((pitch.seconds(400) - 10.0).abs() < 1e-6);
    }
}
