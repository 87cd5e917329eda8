//! Where robots are in a world that nobody has placed yet.

use rapier2d::math::Vector;

use crate::engine::Motion;
use crate::{RobotModel, SimConfig};

/// Ball at the centre, each team in a line across the middle of its half, facing the other's goal.
pub(crate) fn line_up(config: &SimConfig) -> Vec<Motion> {
    let still = |position, heading| Motion { position, heading, velocity: Vector::ZERO, spin: 0.0 };
    let widest = config.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max);
    let even = config.field.width / (config.field.max_robots + 1) as f32;
    let spacing = even.max(2.2 * widest);
    let mut motions = vec![still(Vector::ZERO, Vector::X)];
    for (team, side) in [(&config.blue, -1.0), (&config.yellow, 1.0)] {
        for index in 0..team.len() {
            let y = (index as f32 - (team.len() as f32 - 1.0) / 2.0) * spacing;
            let x = side * config.field.length / 4.0;
            motions.push(still(Vector::new(x, y), Vector::new(-side, 0.0)));
        }
    }
    motions
}
