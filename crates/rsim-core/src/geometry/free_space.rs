//! The part of a field without walls, as a quick test, and the walls that stand on the floor.

use crate::blocks::{Lanes, VectorLanes};
use crate::geometry::arena::Wall;
use crate::geometry::outline::PlacedOutline;
use crate::math::Vector;
use crate::models::field::Field;

/// The part of a field without walls, and the walls around it.
#[derive(Debug, Clone)]
pub(crate) struct FreeSpace {
    /// Half sides of a rectangle without walls, m.
    half: Vector,
    walls: Vec<FloorWall>,
}

/// A wall that stands on the floor.
#[derive(Debug, Clone)]
pub(crate) struct FloorWall {
    /// Index among all walls.
    pub(crate) index: usize,
    pub(crate) outline: PlacedOutline,
    /// Height of the upper edge, m.
    pub(crate) top: f32,
    /// Corners of the smallest upright rectangle around the wall, m.
    bounds: [Vector; 2],
}

impl FloorWall {
    fn of(index: usize, wall: &Wall) -> Self {
        let (turn, half) = (wall.pose.rotation, wall.half);
        let [cos, sin] = [turn.re.abs(), turn.im.abs()];
        let extent = Vector::new(half.x * cos + half.y * sin, half.x * sin + half.y * cos);
        // Wider by more than any rounding.
        let (center, extent) = (wall.pose.translation, extent + Vector::splat(1e-3));
        let bounds = [center - extent, center + extent];
        Self { index, outline: wall.placed(), top: wall.top, bounds }
    }

    /// Whether the wall reaches into a circle.
    fn meets(&self, center: Vector, radius: f32) -> bool {
        let [low, high] = self.bounds;
        let is_near = center.x + radius > low.x
            && center.x - radius < high.x
            && center.y + radius > low.y
            && center.y - radius < high.y;
        is_near && self.outline.nearest(center).distance < radius
    }
}

impl FreeSpace {
    pub(crate) fn of(field: &Field, walls: &[Wall]) -> Self {
        let on_floor = walls.iter().enumerate().filter(|(_, wall)| wall.stands_on_floor());
        // Goals and corner blocks begin at the goal line, or a corner's leg before it.
        let half_x = field.half_length() - field.corner_leg;
        Self {
            half: Vector::new(half_x, field.max_y()),
            walls: on_floor.map(|(index, wall)| FloorWall::of(index, wall)).collect(),
        }
    }

    /// Whether circles around the bodies of a block leave the rectangle without walls, one bit each.
    pub(crate) fn left_by(&self, center: VectorLanes, radius: Lanes) -> u64 {
        let inside = (center.x.abs() + radius).simd_lt(Lanes::splat(self.half.x))
            & (center.y.abs() + radius).simd_lt(Lanes::splat(self.half.y));
        u64::from((!inside).to_bitmask())
    }

    /// Walls that reach into a circle.
    pub(crate) fn walls_near(
        &self,
        center: Vector,
        radius: f32,
    ) -> impl Iterator<Item = &FloorWall> {
        let extent = center.abs() + Vector::splat(radius);
        let is_free = extent.x < self.half.x && extent.y < self.half.y;
        let walls = if is_free { &[] } else { self.walls.as_slice() };
        walls.iter().filter(move |wall| wall.meets(center, radius))
    }
}
