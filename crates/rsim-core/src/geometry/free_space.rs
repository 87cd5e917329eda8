//! The part of a field without walls, as a quick test, and the walls that stand on the floor.

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
}

impl FreeSpace {
    pub(crate) fn of(field: &Field, walls: &[Wall]) -> Self {
        let on_floor = walls.iter().enumerate().filter(|(_, wall)| wall.stands_on_floor());
        // Goals and corner blocks begin at the goal line, or a corner's leg before it.
        let half_x = field.half_length() - field.corner_leg;
        Self {
            half: Vector::new(half_x, field.max_y()),
            walls: on_floor
                .map(|(index, wall)| FloorWall { index, outline: wall.placed(), top: wall.top })
                .collect(),
        }
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
        walls.iter().filter(move |wall| wall.outline.nearest(center).distance < radius)
    }
}
