//! Contact points of two outlines within one sub-step.
//!
//! Bodies move straight in a sub-step. A contact is where two outlines first touch on their paths, so
//! bodies that pass each other are not stopped, and none is missed. Outlines that touch already have
//! the contact of least depth.

use crate::math::Vector;

/// Gap up to which outlines count as touching, m, whatever their velocities: contacts of robots that
/// push each other keep their impulses from one sub-step to the next.
pub(in crate::engine) const TOUCHING: f32 = 5e-5;

/// Contact points of a pair, at most two.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Manifold {
    /// Unit vector from the first to the second.
    pub(in crate::engine) normal: Vector,
    points: [Point; 2],
    count: usize,
}

#[derive(Debug, Clone, Copy, Default)]
pub(in crate::engine) struct Point {
    /// From both bodies' centers to the point when they touch, m.
    pub(in crate::engine) arms: [Vector; 2],
    /// Now, along the normal, m; negative for overlapping outlines.
    pub(in crate::engine) separation: f32,
    /// Identifies the point from one sub-step to the next.
    pub(in crate::engine) feature: u32,
}

impl Manifold {
    /// A manifold without points.
    pub(in crate::engine) fn empty(normal: Vector) -> Self {
        Self { normal, points: [Point::default(); 2], count: 0 }
    }

    pub(in crate::engine) fn of_point(normal: Vector, arms: [Vector; 2], separation: f32) -> Self {
        let mut manifold = Self::empty(normal);
        manifold.push(Point { arms, separation, feature: 1 });
        manifold
    }

    pub(in crate::engine) fn push(&mut self, point: Point) {
        self.points[self.count] = point;
        self.count += 1;
    }

    pub(in crate::engine) fn points(&self) -> &[Point] {
        &self.points[..self.count]
    }

    /// The manifold with first and second exchanged.
    pub(in crate::engine) fn reversed(mut self) -> Self {
        self.points.iter_mut().for_each(|point| point.arms.reverse());
        Self { normal: -self.normal, ..self }
    }
}

/// Bounds of the search for a contact.
#[derive(Debug, Clone, Copy)]
pub(in crate::engine) struct Window {
    /// Length of the sub-step, s.
    pub(in crate::engine) time: f32,
    /// Gap up to which bodies have a contact though their paths do not meet, m: others may push them
    /// together within the sub-step.
    pub(in crate::engine) reach: f32,
}
