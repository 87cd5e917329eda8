//! Default line-up, for a world before its first placement.

use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::config::SimConfig;
use crate::models::robot::RobotModel;

/// Motions of ball and robots: the ball at the center, each team in a line across the middle of its
/// half, facing the other goal.
pub(super) fn line_up(config: &SimConfig) -> Vec<Motion> {
    let widest = config.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max);
    let even = config.field.width / (config.field.max_robots + 1) as f32;
    let spacing = even.max(2.2 * widest);
    let mut motions = vec![Motion::at_rest(Vector::ZERO, Vector::X)];
    for (team, side) in [(&config.blue, -1.0), (&config.yellow, 1.0)] {
        for index in 0..team.len() {
            let y = (index as f32 - (team.len() as f32 - 1.0) / 2.0) * spacing;
            let x = side * config.field.length / 4.0;
            motions.push(Motion::at_rest(Vector::new(x, y), Vector::new(-side, 0.0)));
        }
    }
    motions
}
