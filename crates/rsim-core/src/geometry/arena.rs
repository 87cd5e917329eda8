//! Solid parts of a field: walls, goals, corner blocks, and an outer fence.

use crate::geometry::outline::{Outline, PlacedOutline};
use crate::math::{Pose, Vector};
use crate::models::ball::{BallModel, Surface};
use crate::models::field::Field;

/// A fixed block that stands on the floor, or a bar above it.
#[derive(Debug, Clone)]
pub(crate) struct Wall {
    pub(crate) pose: Pose,
    /// Half sides, m.
    pub(crate) half: Vector,
    /// Heights of the lower and the upper edge, m.
    pub(crate) bottom: f32,
    pub(crate) top: f32,
    part: Part,
}

/// Kind of a wall, which decides the ball's contact coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Part {
    Wall,
    GoalBack,
}

impl Wall {
    pub(crate) fn outline(&self) -> Outline {
        Outline::Box { half: self.half }
    }

    /// The outline at its place.
    pub(crate) fn placed(&self) -> PlacedOutline {
        let (position, heading) = (self.pose.translation, self.pose.rotation);
        PlacedOutline { outline: self.outline(), position, heading }
    }

    /// Whether a ball on the floor can touch the wall.
    pub(crate) fn stands_on_floor(&self) -> bool {
        self.bottom == 0.0
    }

    /// Contact coefficients of the ball against the wall.
    pub(crate) fn surface(&self, ball: &BallModel) -> Surface {
        match self.part {
            Part::Wall => ball.wall_surface(),
            Part::GoalBack => ball.goal_back_surface(),
        }
    }
}

/// Thickness of the outer walls, m: more than the maximum motion in a tick, so that a body pushed into a
/// wall does not come out on the far side.
const THICKNESS: f32 = 0.3;

/// Upper edge of a wall that no ball can fly over.
const SKY: f32 = f32::INFINITY;

/// The walls of a field. All are rectangles, the cheapest shape after the disc.
pub(crate) fn walls(field: &Field) -> Vec<Wall> {
    let mut walls = Vec::new();
    for side in [1.0, -1.0] {
        walls.push(side_wall(field, side));
        for end in [1.0, -1.0] {
            walls.push(goal_side(field, end, side));
            if field.corner_leg > 0.0 {
                walls.push(corner_block(field, end, side));
            }
        }
    }
    for end in [1.0, -1.0] {
        walls.push(goal_back(field, end));
        if field.goal_wall_thickness > 0.0 {
            walls.push(end_wall(field, end));
            walls.push(goal_bar(field, end));
        }
    }
    if field.wall_height > 0.0 {
        walls.extend(fence(field));
    }
    walls
}

/// Height of the upper edge of the outer walls, m.
fn wall_top(field: &Field) -> f32 {
    if field.wall_height > 0.0 { field.wall_height } else { SKY }
}

/// Outer corner of the outer walls, m.
fn outer(field: &Field) -> Vector {
    Vector::new(field.max_x(), field.max_y()) + Vector::splat(THICKNESS)
}

fn side_wall(field: &Field, side: f32) -> Wall {
    let outer = outer(field);
    between([-outer.x, side * field.max_y()], [outer.x, side * outer.y], wall_top(field))
}

/// The wall behind a free-standing goal.
fn end_wall(field: &Field, end: f32) -> Wall {
    let (inner, outer) = (field.max_x(), outer(field));
    between([end * inner, -outer.y], [end * outer.x, outer.y], wall_top(field))
}

/// The wall beside a goal's opening: the table's end wall, or the goal's own side, up to the wall behind
/// the goal.
fn goal_side(field: &Field, end: f32, side: f32) -> Wall {
    let mouth = field.goal_width / 2.0;
    let near = [end * field.half_length(), side * mouth];
    if field.goal_wall_thickness > 0.0 {
        let far = [end * field.max_x(), side * (mouth + field.goal_wall_thickness)];
        between(near, far, field.goal_height + field.goal_wall_thickness)
    } else {
        between(near, [end * outer(field).x, side * field.half_width()], wall_top(field))
    }
}

fn goal_back(field: &Field, end: f32) -> Wall {
    let mouth = field.goal_width / 2.0;
    let (back, top) = (field.half_length() + field.goal_depth, wall_top(field));
    let (far, top) = if field.goal_wall_thickness > 0.0 {
        (field.max_x(), field.goal_height + field.goal_wall_thickness)
    } else {
        (outer(field).x, top)
    };
    let wall = between([end * back, -mouth], [end * far, mouth], top);
    Wall { part: Part::GoalBack, ..wall }
}

/// The crossbar of a goal and the net above it, as one plate.
fn goal_bar(field: &Field, end: f32) -> Wall {
    let mouth = field.goal_width / 2.0;
    let near = [end * field.half_length(), -mouth];
    let far = [end * (field.half_length() + field.goal_depth), mouth];
    let wall = between(near, far, field.goal_height + field.goal_wall_thickness);
    Wall { bottom: field.goal_height, ..wall }
}

/// The fence around walls that a ball can fly over.
fn fence(field: &Field) -> [Wall; 4] {
    let inner = outer(field);
    let outer = inner + Vector::splat(THICKNESS);
    [
        between([-outer.x, inner.y], [outer.x, outer.y], SKY),
        between([-outer.x, -outer.y], [outer.x, -inner.y], SKY),
        between([inner.x, -outer.y], [outer.x, outer.y], SKY),
        between([-outer.x, -outer.y], [-inner.x, outer.y], SKY),
    ]
    // The fence stands on the walls: bodies on the floor never touch it.
    .map(|wall| Wall { bottom: field.wall_height, ..wall })
}

/// The axis-aligned block with these opposite corners.
fn between(a: [f32; 2], b: [f32; 2], top: f32) -> Wall {
    let (a, b) = (Vector::from(a), Vector::from(b));
    Wall {
        pose: Pose::from_translation((a + b) / 2.0),
        half: (b - a).abs() / 2.0,
        bottom: 0.0,
        top,
        part: Part::Wall,
    }
}

/// A rectangle rotated by 45 degrees, whose inner face cuts off the corner.
fn corner_block(field: &Field, end: f32, side: f32) -> Wall {
    let face = field.corner_leg * std::f32::consts::SQRT_2;
    let inset = field.corner_leg / 2.0;
    let corner = Vector::new(field.half_length() + field.goal_line_margin, field.max_y());
    let middle = corner - Vector::splat(inset);
    let outward = Vector::splat(std::f32::consts::FRAC_1_SQRT_2);
    // Its depth is the distance from the face to the corner, so it ends inside the walls.
    let half_depth = face / 2.0;
    let center = middle + outward * half_depth;
    Wall {
        pose: Pose::new(
            Vector::new(end * center.x, side * center.y),
            end * side * std::f32::consts::FRAC_PI_4,
        ),
        half: Vector::new(half_depth, face / 2.0),
        bottom: 0.0,
        top: wall_top(field),
        part: Part::Wall,
    }
}

/// Distance of the outermost wall from the center along x, m.
pub(crate) fn outermost_x(field: &Field) -> f32 {
    outer(field).x + THICKNESS
}

/// Maximum distance of a body at height `z` from the center, m; above a low wall it can be beyond the
/// wall.
pub(crate) fn position_limit(field: &Field, z: f32) -> Vector {
    let walls = Vector::new(field.max_x(), field.max_y());
    if z < wall_top(field) { walls } else { walls + Vector::splat(THICKNESS) }
}
