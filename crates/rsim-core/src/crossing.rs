//! What the ball crossed during a control step. Geometry, not rules: whether it counts is for the
//! caller to say. The ends of a step cannot tell it, so every tick is watched.

use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use crate::Field;

/// The first thing that the ball's centre crossed in the running control step.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Crossing {
    /// Position in [`crate::columns::CROSSINGS`].
    pub(crate) code: u8,
    /// Where, m.
    pub(crate) at: Vector,
}

const GOAL_RIGHT: u8 = 1;
const GOAL_LEFT: u8 = 2;

impl Crossing {
    /// Looks at one tick of the ball's way.
    pub(crate) fn watch(&mut self, field: &Field, before: Vector, after: Vector) {
        if self.code != 0 {
            return;
        }
        for (code, line) in [(GOAL_RIGHT, field.half_length()), (GOAL_LEFT, -field.half_length())] {
            let (from, to) = (before.x * line.signum(), after.x * line.signum());
            if from <= line.abs() && to > line.abs() {
                let at = before.lerp(after, (line.abs() - from) / (to - from));
                if at.y.abs() < field.goal_width / 2.0 {
                    *self = Self { code, at };
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossed(before: [f32; 2], after: [f32; 2]) -> Crossing {
        let mut crossing = Crossing::default();
        crossing.watch(&Field::VSS_3V3, before.into(), after.into());
        crossing
    }

    #[test]
    fn a_goal_is_told_by_side_and_place() {
        assert_eq!(crossed([0.74, 0.1], [0.76, 0.1]).code, GOAL_RIGHT);
        assert_eq!(crossed([-0.74, 0.0], [-0.76, 0.1]).code, GOAL_LEFT);
        assert!((crossed([0.74, 0.0], [0.76, 0.1]).at - Vector::new(0.75, 0.05)).length() < 1e-5);
    }

    #[test]
    fn a_line_is_crossed_once_outward_and_in_the_mouth() {
        assert_eq!(crossed([0.76, 0.1], [0.77, 0.1]).code, 0, "already behind the line");
        assert_eq!(crossed([0.76, 0.1], [0.74, 0.1]).code, 0, "on its way back");
        assert_eq!(crossed([0.74, 0.3], [0.76, 0.3]).code, 0, "beside the goal");
    }
}
