//! Places of absent robots: each team's behind its own goal, beyond all walls.

use crate::geometry::arena::outermost_x;
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::field::Field;

/// Distance of the first place from the outermost wall, and between places, m: more than bodies can reach
/// within a tick, so that nothing ever meets an absent robot.
const SPACING: f32 = 2.0;

/// The place of robot `index` of a team. It lies on the x axis, so that reflected and rotated matches have
/// reflected and rotated places.
pub(crate) fn bench_place(field: &Field, is_blue: bool, index: usize) -> Motion {
    let side = if is_blue { -1.0 } else { 1.0 };
    let x = side * (outermost_x(field) + SPACING * (index + 1) as f32);
    Motion::at_rest(Vector::new(x, 0.0), Vector::new(-side, 0.0))
}
