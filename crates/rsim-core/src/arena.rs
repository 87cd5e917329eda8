//! The solid parts of a field: side walls, end walls, goal pockets, corner blocks.

use rapier2d::math::{Pose, Vector};
use rapier2d::parry::shape::Cuboid;

use crate::Field;

/// A fixed rectangle.
#[derive(Debug, Clone)]
pub(crate) struct Wall {
    pub(crate) shape: Cuboid,
    pub(crate) pose: Pose,
}

/// How far walls reach outward. More than anything travels in a tick, so that nothing that is
/// pushed into a wall comes out of its far side.
const THICKNESS: f32 = 0.3;

/// The walls of a field. Rectangles only: the cheapest shape after the disc, and all that a VSSS
/// field needs.
pub(crate) fn walls(field: &Field) -> Vec<Wall> {
    let (half_length, half_width) = (field.half_length(), field.half_width());
    let outer_x = half_length + field.goal_depth + THICKNESS;
    let outer_y = half_width + THICKNESS;
    let mouth = field.goal_width / 2.0;
    let back = half_length + field.goal_depth;
    let mut walls = Vec::new();
    for side in [1.0, -1.0] {
        walls.push(between([-outer_x, side * half_width], [outer_x, side * outer_y]));
        walls.push(between([side * back, -mouth], [side * outer_x, mouth]));
        for end in [1.0, -1.0] {
            walls.push(between(
                [end * half_length, side * mouth],
                [end * outer_x, side * half_width],
            ));
            walls.push(corner_block(field, end, side));
        }
    }
    walls
}

/// The axis-aligned rectangle with these opposite corners.
fn between(a: [f32; 2], b: [f32; 2]) -> Wall {
    let (a, b) = (Vector::from(a), Vector::from(b));
    Wall { shape: Cuboid::new((b - a).abs() / 2.0), pose: Pose::from_translation((a + b) / 2.0) }
}

/// A rectangle turned by 45 degrees, whose inner face cuts the corner off.
fn corner_block(field: &Field, end: f32, side: f32) -> Wall {
    let face = field.corner * std::f32::consts::SQRT_2;
    let inset = field.corner / 2.0;
    let middle = Vector::new(field.half_length() - inset, field.half_width() - inset);
    let outward = Vector::splat(std::f32::consts::FRAC_1_SQRT_2);
    // As deep as the corner is far from the face: it ends inside the walls.
    let half_depth = face / 2.0;
    let center = middle + outward * half_depth;
    Wall {
        shape: Cuboid::new(Vector::new(half_depth, face / 2.0)),
        pose: Pose::new(
            Vector::new(end * center.x, side * center.y),
            end * side * std::f32::consts::FRAC_PI_4,
        ),
    }
}
