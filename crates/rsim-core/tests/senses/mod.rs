//! Senses and commands of robots, measured from outside against what was asked for.

mod actuation;
mod cameras;
mod driven;
mod forecast;
mod held;
mod state;

use rsim_core::columns::robot_column;
use rsim_core::scenes::Scene;
use rsim_core::{Batch, Sensing};

/// Keys of many matches.
fn keys(worlds: usize) -> Vec<u64> {
    (0..worlds as u64).map(|world| 1000 + world).collect()
}

/// Many matches of a scene with these senses, and the rows of their starts.
fn begin(scene: &Scene, sensing: Sensing, worlds: usize) -> (Batch, Vec<f32>) {
    let mut scene = scene.clone();
    scene.config.sensing = Some(sensing);
    let (mut batch, rows) = scene.batch(worlds, 1);
    batch.begin_senses(&vec![true; worlds], &keys(worlds), None).expect("valid");
    (batch, rows)
}

/// True and sensed rows of many matches after each step.
struct Played {
    size: usize,
    truth: Vec<Vec<f32>>,
    sensed: Vec<Vec<f32>>,
}

impl Played {
    /// Plays a scene with senses.
    fn new(scene: &Scene, sensing: Sensing, worlds: usize, steps: u64) -> Self {
        let (mut batch, mut rows) = begin(scene, sensing, worlds);
        let size = scene.config.row_size();
        let (mut truth, mut sensed) = (Vec::new(), Vec::new());
        for step in 0..steps {
            let each = rows.chunks_exact(size);
            let commands: Vec<f32> = each.flat_map(|row| scene.commands(row, step, 0)).collect();
            batch.step(&commands, &mut rows, None).expect("finite");
            let mut known = vec![0.0; rows.len()];
            batch.sense(&mut known, None);
            truth.push(rows.clone());
            sensed.push(known);
        }
        Self { size, truth, sensed }
    }

    /// A column of the ball (`None`) or of a robot in all matches, true and sensed, by step.
    fn column(&self, robot: Option<usize>, name: &str) -> Vec<Vec<[f32; 2]>> {
        let at = match robot {
            None => rsim_core::columns::ball_column(name),
            Some(robot) => rsim_core::columns::row_size(robot) + robot_column(name),
        };
        let steps = self.truth.iter().zip(&self.sensed);
        let worlds = |rows: &[f32]| -> Vec<f32> {
            rows.chunks_exact(self.size).map(|row| row[at]).collect()
        };
        steps
            .map(|(truth, sensed)| {
                worlds(truth).into_iter().zip(worlds(sensed)).map(|(a, b)| [a, b]).collect()
            })
            .collect()
    }
}

/// Mean and standard deviation.
fn moments(numbers: impl IntoIterator<Item = f32>) -> (f64, f64) {
    let numbers: Vec<f64> = numbers.into_iter().map(f64::from).collect();
    let count = f64::from(u32::try_from(numbers.len()).expect("few"));
    let mean = numbers.iter().sum::<f64>() / count;
    let variance = numbers.iter().map(|number| (number - mean).powi(2)).sum::<f64>() / count;
    (mean, variance.sqrt())
}

/// Asserts that a measured number is within `part` of an expected one.
fn assert_near(measured: f64, expected: f64, part: f64) {
    assert!((measured / expected - 1.0).abs() <= part, "{measured} instead of {expected}");
}
