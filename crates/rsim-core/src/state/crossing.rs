//! The line that the ball crossed during a control step. This is geometry; the caller has the rules.
//! Positions at the ends of a step are not enough, so every tick is checked.

use serde::{Deserialize, Serialize};

use crate::math::Vec3;
use crate::models::field::Field;

/// The first line that the ball's center crossed outward in the running control step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Crossing {
    /// Position in [`crate::columns::CROSSINGS`].
    pub(crate) code: u8,
    /// Point of the crossing, m; `z` is the ball's lowest point.
    pub(crate) at: Vec3,
}

const GOALS: [u8; 2] = [1, 2];
const GOAL_LINES: [u8; 2] = [3, 4];
const TOUCH_LINES: [u8; 2] = [5, 6];

impl Crossing {
    /// Updates the crossing with the ball's motion in one tick.
    pub(crate) fn update(&mut self, field: &Field, before: Vec3, after: Vec3) {
        if self.code != 0 {
            return;
        }
        let [half_length, half_width] = [field.half_length(), field.half_width()];
        if after.x.abs() <= half_length && after.y.abs() <= half_width {
            return; // in most ticks
        }
        let ends = crossed(before.x, after.x, half_length).map(|(side, fraction)| {
            let at = before.lerp(after, fraction);
            let in_goal = at.y.abs() < field.goal_width / 2.0 && at.z < field.goal_height;
            let on_line = at.y.abs() <= half_width;
            (on_line, fraction, if in_goal { GOALS[side] } else { GOAL_LINES[side] }, at)
        });
        let sides = crossed(before.y, after.y, half_width).map(|(side, fraction)| {
            let at = before.lerp(after, fraction);
            (at.x.abs() <= half_length, fraction, TOUCH_LINES[side], at)
        });
        let first = [ends, sides]
            .into_iter()
            .flatten()
            .filter(|(on_line, ..)| *on_line)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        if let Some((_, _, code, at)) = first {
            *self = Self { code, at };
        }
    }
}

/// The end (0 is +) through which a coordinate left [-line, line], and the fraction of its motion before
/// that; `None` if it did not.
fn crossed(before: f32, after: f32, line: f32) -> Option<(usize, f32)> {
    for (side, sign) in [(0, 1.0), (1, -1.0)] {
        let (from, to) = (before * sign, after * sign);
        if from <= line && to > line {
            return Some((side, (line - from) / (to - from)));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::crossing_name;

    fn crossed(field: &Field, before: [f32; 3], after: [f32; 3]) -> (&'static str, Vec3) {
        let mut crossing = Crossing::default();
        crossing.update(field, before.into(), after.into());
        (crossing_name(f32::from(crossing.code)), crossing.at)
    }

    #[test]
    fn a_goal_has_its_side_and_point() {
        let vss = |before, after| crossed(&Field::VSS_3V3, before, after);
        assert_eq!(vss([0.74, 0.1, 0.0], [0.76, 0.1, 0.0]).0, "goal_right");
        assert_eq!(vss([-0.74, 0.0, 0.0], [-0.76, 0.1, 0.0]).0, "goal_left");
        let (_, at) = vss([0.74, 0.0, 0.0], [0.76, 0.1, 0.0]);
        assert!((at - Vec3::new(0.75, 0.05, 0.0)).length() < 1e-5);
    }

    #[test]
    fn every_line_has_its_own_code() {
        let ssl = |before, after| crossed(&Field::SSL_B, before, after).0;
        assert_eq!(ssl([4.49, 1.0, 0.0], [4.51, 1.0, 0.0]), "goal_line_right");
        assert_eq!(ssl([-4.49, -1.0, 0.0], [-4.51, -1.0, 0.0]), "goal_line_left");
        assert_eq!(ssl([4.49, 0.1, 0.2], [4.51, 0.1, 0.2]), "goal_line_right", "over the bar");
        assert_eq!(ssl([4.49, 0.1, 0.1], [4.51, 0.1, 0.1]), "goal_right");
        assert_eq!(ssl([1.0, 2.99, 0.0], [1.0, 3.01, 0.0]), "touch_line_left");
        assert_eq!(ssl([1.0, -2.99, 0.0], [1.0, -3.01, 0.0]), "touch_line_right");
        // At a corner the first of the two lines counts.
        assert_eq!(ssl([4.49, 2.98, 0.0], [4.51, 3.02, 0.0]), "goal_line_right");
        assert_eq!(ssl([4.46, 2.99, 0.0], [4.52, 3.01, 0.0]), "touch_line_left");
    }

    #[test]
    fn a_line_is_crossed_once_and_outward() {
        let vss = |before, after| crossed(&Field::VSS_3V3, before, after).0;
        assert_eq!(vss([0.76, 0.1, 0.0], [0.77, 0.1, 0.0]), "none", "already behind the line");
        assert_eq!(vss([0.76, 0.1, 0.0], [0.74, 0.1, 0.0]), "none", "on its way back");
    }
}
