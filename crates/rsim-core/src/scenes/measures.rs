//! Measurements of states for tests: gaps, overlaps, energy.

use super::{Scene, robots, steps};
use crate::columns::{ball_column, robot_column};
use crate::models::config::SimConfig;
use crate::models::robot::{Body, RobotModel};

/// Gap between the outline of a robot and a ball on the floor, m; negative inside.
///
/// `robot` has its columns of a row.
pub fn ball_gap(model: &RobotModel, robot: &[f32], center: [f32; 2], radius: f32) -> f32 {
    let (x, y) = (center[0] - robot[0], center[1] - robot[1]);
    let (ahead, aside) = (x * robot[2] + y * robot[3], (y * robot[2] - x * robot[3]).abs());
    let outside = |x: f32, y: f32| if x > 0.0 && y > 0.0 { x.hypot(y) } else { x.max(y) };
    let gap = match model.body {
        Body::Square { side_length: side } => outside(ahead.abs() - side / 2.0, aside - side / 2.0),
        Body::Round { radius, front_distance: front } => {
            let half = (radius * radius - front * front).sqrt();
            // In front of the flat front the front or its corner is nearest, elsewhere the arc.
            if ahead * half > aside * front {
                outside(ahead - front, aside - half)
            } else {
                ahead.hypot(aside) - radius
            }
        }
    };
    gap - radius
}

/// Overlap of two robots of one shape, m; negative if they are apart, for squares a bound of the
/// distance.
///
/// # Panics
/// If one is round and the other is square.
pub fn robot_depth(a: (&RobotModel, &[f32]), b: (&RobotModel, &[f32])) -> f32 {
    match (a.0.body, b.0.body) {
        (Body::Round { radius, .. }, Body::Round { radius: other, .. }) => {
            radius + other - (a.1[0] - b.1[0]).hypot(a.1[1] - b.1[1])
        }
        (Body::Square { side_length: side }, Body::Square { side_length: other }) => {
            // The minimum overlap over the directions of both bodies' sides.
            let directions =
                [a, b].into_iter().flat_map(|(_, at)| [[at[2], at[3]], [-at[3], at[2]]]);
            let reach = |side: f32, at: &[f32], to: [f32; 2]| {
                let (along, across) =
                    (at[2] * to[0] + at[3] * to[1], at[2] * to[1] - at[3] * to[0]);
                side / 2.0 * (along.abs() + across.abs())
            };
            let overlap = directions.map(|to| {
                let apart = (a.1[0] - b.1[0]) * to[0] + (a.1[1] - b.1[1]) * to[1];
                reach(side, a.1, to) + reach(other, b.1, to) - apart.abs()
            });
            overlap.fold(f32::INFINITY, f32::min)
        }
        _ => unreachable!("leagues are not mixed"),
    }
}

/// Maximum overlap of two robots of a row, m; negative if all are apart.
pub fn deepest_robots(config: &SimConfig, row: &[f32]) -> f32 {
    let all: Vec<_> = config.robots().zip(robots(row)).collect();
    let pairs = (0..all.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
    let depths = pairs.map(|(first, second)| robot_depth(all[first], all[second]));
    depths.fold(f32::NEG_INFINITY, f32::max)
}

/// Maximum overlap of a ball on the floor with a robot, m; negative if it touches none.
pub fn deepest_ball(config: &SimConfig, row: &[f32]) -> f32 {
    let all = config.robots().zip(robots(row));
    let gaps = all.map(|(model, at)| ball_gap(model, at, [row[0], row[1]], config.ball.radius));
    -gaps.fold(f32::INFINITY, f32::min)
}

/// Kinetic energy of all robots, and of the ball without its spin, J.
pub fn kinetic_energy(config: &SimConfig, row: &[f32]) -> f32 {
    let square = |columns: &[f32]| columns.iter().map(|part| part * part).sum::<f32>();
    let v_x = ball_column("v_x");
    let ball = config.ball.mass * square(&row[v_x..v_x + 3]);
    let (v_x, v_theta) = (robot_column("v_x"), robot_column("v_theta"));
    let robots = config.robots().zip(robots(row)).map(|(model, at)| {
        model.mass * square(&at[v_x..v_x + 2]) + model.inertia() * at[v_theta] * at[v_theta]
    });
    f32::midpoint(ball, robots.sum())
}

impl Scene {
    /// The row at the start and after each tick for `seconds`.
    pub fn every_tick(&self, seconds: f32) -> Vec<Vec<f32>> {
        let mut scene = self.clone();
        scene.config.time_step = scene.config.tick;
        let (rows, _) = scene.play(&mut scene.world(), steps(seconds, scene.config.tick));
        let rows = rows.chunks_exact(scene.config.row_size()).map(<[f32]>::to_vec);
        std::iter::once(scene.start.clone()).chain(rows).collect()
    }
}
