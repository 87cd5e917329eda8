//! How deep bodies are in each other, and what a run shows of it.

use rsim_core::columns::ball_column;
use rsim_core::scenes::robots;
use rsim_core::{Body, RobotModel, SimConfig};

/// How deep two robots are in each other, m; 0 or less when apart.
pub(super) fn between_robots(a: (&RobotModel, &[f32]), b: (&RobotModel, &[f32])) -> f32 {
    match (a.0.body, b.0.body) {
        (Body::Round { radius, .. }, Body::Round { radius: other, .. }) => {
            radius + other - (a.1[0] - b.1[0]).hypot(a.1[1] - b.1[1])
        }
        (Body::Square { side }, Body::Square { side: other }) => {
            // The least overlap over the directions of both bodies' sides.
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

/// How deep a ball at `place` on the floor is in a robot, m.
fn of_ball(radius: f32, place: [f32; 2], (model, robot): (&RobotModel, &[f32])) -> f32 {
    let (x, y) = (place[0] - robot[0], place[1] - robot[1]);
    let (ahead, aside) = (x * robot[2] + y * robot[3], (y * robot[2] - x * robot[3]).abs());
    let distance = match model.body {
        Body::Round { radius, front } => {
            let away = ahead.hypot(aside);
            let half = (radius * radius - front * front).sqrt();
            if ahead * radius <= away * front {
                away - radius
            } else if aside <= half {
                ahead - front
            } else {
                (ahead - front).hypot(aside - half)
            }
        }
        Body::Square { side } => {
            let (beyond, beside) = (ahead.abs() - side / 2.0, aside - side / 2.0);
            if beyond > 0.0 && beside > 0.0 { beyond.hypot(beside) } else { beyond.max(beside) }
        }
    };
    radius - distance
}

/// Depths of all contacts in a run, m.
#[derive(Default)]
pub(super) struct Depths {
    robots: Vec<f32>,
    ball: Vec<f32>,
}

/// Below this two do not touch, m.
const APART: f32 = -5e-4;

impl Depths {
    /// Takes note of a state.
    pub(super) fn look(&mut self, config: &SimConfig, row: &[f32]) {
        let all: Vec<_> = config.robots().zip(robots(row)).collect();
        for (nth, first) in all.iter().enumerate() {
            let deep = all[..nth].iter().map(|second| between_robots(*first, *second));
            self.robots.extend(deep.filter(|depth| *depth > APART));
            // What is higher may lie on the robot.
            if row[ball_column("z")] < 0.02 {
                let depth = of_ball(config.ball.radius, [row[0], row[1]], *first);
                self.ball.extend(Some(depth).filter(|depth| *depth > APART));
            }
        }
    }

    /// Says what was seen, and fails if one in a hundred, one in a thousand or the deepest contact is
    /// deeper than `most` (mm) between robots or `most_ball` at the ball.
    pub(super) fn check(mut self, scene: &str, most: [f32; 3], most_ball: [f32; 3]) {
        for (what, depths, most) in
            [("robots", &mut self.robots, most), ("ball", &mut self.ball, most_ball)]
        {
            depths.sort_by(f32::total_cmp);
            let at = |from_top: usize| depths.len().checked_sub(1 + depths.len() / from_top);
            let found = [100, 1000, usize::MAX]
                .map(|from_top| at(from_top).map_or(0.0, |place| depths[place].max(0.0) * 1e3));
            let text = format!(
                "{scene}, {what}: {} contacts; 99% within {:.2} mm, 99.9% {:.2} mm, all {:.2} mm",
                depths.len(),
                found[0],
                found[1],
                found[2]
            );
            eprintln!("{text}");
            assert!(what == "ball" || depths.len() > 300, "{text}: too few to judge");
            let fits = found.iter().zip(most).all(|(found, most)| *found <= most);
            assert!(fits, "{text}: expected at most {most:?} mm");
        }
    }
}
