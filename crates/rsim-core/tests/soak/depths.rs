//! Overlaps of bodies, collected over a run.

use rsim_core::SimConfig;
use rsim_core::columns::ball_column;
use rsim_core::scenes::{ball_gap, robot_depth, robots};

/// Depths of all contacts in a run, m.
#[derive(Default)]
pub(super) struct Depths {
    robots: Vec<f32>,
    ball: Vec<f32>,
}

/// Overlap below which two bodies do not touch, m.
const APART: f32 = -5e-4;

impl Depths {
    /// Adds the overlaps of a state.
    pub(super) fn look(&mut self, config: &SimConfig, row: &[f32]) {
        let all: Vec<_> = config.robots().zip(robots(row)).collect();
        for (nth, first) in all.iter().enumerate() {
            let deep = all[..nth].iter().map(|second| robot_depth(*first, *second));
            self.robots.extend(deep.filter(|depth| *depth > APART));
            // A higher ball may lie on the robot.
            if row[ball_column("z")] < 0.02 {
                let depth = -ball_gap(first.0, first.1, [row[0], row[1]], config.ball.radius);
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
