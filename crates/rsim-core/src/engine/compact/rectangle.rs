//! Rectangles on their paths, and their faces.

use super::body::SolverBody;
use crate::math::Vector;

/// A rectangle on its straight path.
#[derive(Clone, Copy)]
pub(in crate::engine) struct Rectangle<'a> {
    pub(in crate::engine) body: &'a SolverBody,
    /// Half sides, m.
    pub(in crate::engine) half: Vector,
    /// Distance of the corners from the center, m.
    pub(in crate::engine) radius: f32,
}

/// A face of one of two rectangles, as the direction between them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Face {
    /// 0 for the faces along the box's x axis, 1 for y.
    pub(super) axis: usize,
    /// Now, m.
    pub(super) separation: f32,
    /// Time after which the boxes overlap along this direction, s, at most twice the sub-step; 0 if
    /// they do now.
    pub(super) after: f32,
}

/// The face of one of two rectangles that they meet at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met {
    pub(super) face: Face,
    /// Whether it is of the second.
    pub(super) of_second: bool,
}

impl Rectangle<'_> {
    pub(super) fn axes(&self) -> [Vector; 2] {
        [self.body.heading, self.body.heading.perp()]
    }

    /// The farthest corner in a direction, from the center, m.
    pub(super) fn corner(&self, direction: Vector) -> Vector {
        let [x, y] = self.axes();
        let along = |axis: Vector, half: f32| axis * half.copysign(axis.dot(direction));
        along(x, self.half.x) + along(y, self.half.y)
    }
}
