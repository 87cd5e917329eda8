//! The part of a field without walls, as a quick test, and the walls that stand on the floor.

use crate::blocks::{LANES, Lanes, VectorLanes, lanes_of, set_bits};
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
    /// Bounds of the walls, four at once.
    bounds: Vec<BlockBounds>,
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

/// Corners of upright rectangles around four walls, m.
#[derive(Debug, Clone, Copy)]
struct BlockBounds {
    low: VectorLanes,
    high: VectorLanes,
}

impl FloorWall {
    fn of(index: usize, wall: &Wall) -> Self {
        Self { index, outline: wall.placed(), top: wall.top }
    }
}

/// Corners of the smallest upright rectangle around a wall, m.
fn bounds(wall: &Wall) -> [Vector; 2] {
    let (turn, half) = (wall.pose.rotation, wall.half);
    let [cos, sin] = [turn.re.abs(), turn.im.abs()];
    let extent = Vector::new(half.x * cos + half.y * sin, half.x * sin + half.y * cos);
    // Wider by more than any rounding.
    let (center, extent) = (wall.pose.translation, extent + Vector::splat(1e-3));
    [center - extent, center + extent]
}

impl BlockBounds {
    /// Bounds of up to four walls. Nothing meets those of the others.
    fn of(walls: &[[Vector; 2]]) -> Self {
        let corner = |end: usize, none: f32| VectorLanes {
            x: lanes_of(|lane| walls.get(lane).map_or(none, |corners| corners[end].x)),
            y: lanes_of(|lane| walls.get(lane).map_or(none, |corners| corners[end].y)),
        };
        Self { low: corner(0, f32::INFINITY), high: corner(1, f32::NEG_INFINITY) }
    }

    /// The bounds that meet an upright square around a circle, one bit each.
    fn meet(&self, center: VectorLanes, radius: Lanes) -> u64 {
        let near = (center.x + radius).simd_gt(self.low.x)
            & (center.x - radius).simd_lt(self.high.x)
            & (center.y + radius).simd_gt(self.low.y)
            & (center.y - radius).simd_lt(self.high.y);
        u64::from(near.to_bitmask())
    }
}

impl FreeSpace {
    pub(crate) fn of(field: &Field, walls: &[Wall]) -> Self {
        let on_floor = walls.iter().enumerate().filter(|(_, wall)| wall.stands_on_floor());
        let corners: Vec<_> = on_floor.clone().map(|(_, wall)| bounds(wall)).collect();
        assert!(corners.len() <= 64, "one bit for each wall");
        // Goals and corner blocks begin at the goal line, or a corner's leg before it.
        let half_x = field.half_length() - field.corner_leg;
        Self {
            half: Vector::new(half_x, field.max_y()),
            walls: on_floor.map(|(index, wall)| FloorWall::of(index, wall)).collect(),
            bounds: corners.chunks(LANES).map(BlockBounds::of).collect(),
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
        let blocks = if is_free { &[] } else { self.bounds.as_slice() };
        let (centers, radii) = (VectorLanes::splat(center), Lanes::splat(radius));
        let near = blocks
            .iter()
            .enumerate()
            .fold(0, |near, (block, bounds)| near | bounds.meet(centers, radii) << (block * LANES));
        let walls = set_bits(near).map(|wall| &self.walls[wall]);
        walls.filter(move |wall| wall.outline.nearest(center).distance < radius)
    }
}
