//! Accuracy and cost of both solvers' sub-steps and of the length of a tick:
//! `cargo bench -p rsim-bench --bench solver` prints a table for each.
//!
//! The overlap of bodies measures the error of the contacts. Costs are per second of play, so that ticks of
//! different length compare, and relative to the default.

use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

use rsim_core::scenes::{self, Driver, Scene, robots};
use rsim_core::{EngineKind, RobotModel, SimConfig, World};

const SUB_STEPS: [usize; 5] = [1, 2, 3, 4, 8];
const TICKS: [f32; 3] = [0.001, 0.002_5, 0.005];
/// Default number, `SUB_STEPS` of the engine.
const DEFAULT_SUB_STEPS: usize = 4;

/// Steps of a scene, and number of times that it is played; the fastest counts.
const STEPS: u64 = 400;
const ROUNDS: usize = 15;

/// Measurements of a scene.
#[derive(Default)]
struct Measured {
    /// Overlaps of pairs in all steps, m.
    depths: Vec<f32>,
    fastest: Option<Duration>,
}

impl Measured {
    fn worst(&self) -> f32 {
        self.depths.iter().copied().fold(0.0, f32::max)
    }

    /// The 99th percentile of overlaps, m.
    fn percentile(&mut self) -> f32 {
        self.depths.sort_by(f32::total_cmp);
        self.depths.get(self.depths.len() * 99 / 100).copied().unwrap_or(0.0)
    }
}

fn play(scene: &Scene, sub_steps: usize, depths: impl Fn(&[f32]) -> Vec<f32>) -> Measured {
    let mut measured = Measured::default();
    for _ in 0..ROUNDS {
        let mut world: World = scene.world();
        world.set_sub_steps(NonZeroUsize::new(sub_steps).expect("some"));
        let mut row = scene.start.clone();
        let mut spent = Duration::ZERO;
        for step in 0..STEPS {
            let commands = scene.commands(&row, step, 0);
            let start = Instant::now();
            world.step(&commands).expect("the state stays finite");
            spent += start.elapsed();
            world.write_row(&mut row);
            measured.depths.extend(depths(&row).into_iter().filter(|depth| *depth > 0.0));
        }
        measured.fastest = Some(measured.fastest.map_or(spent, |fastest| fastest.min(spent)));
    }
    measured
}

/// Overlaps of round robots, m.
fn between_discs(row: &[f32]) -> Vec<f32> {
    let all: Vec<&[f32]> = robots(row).collect();
    let apart = 2.0 * RobotModel::SSL_GENERIC.bounding_radius();
    let pairs = all.iter().enumerate().flat_map(|(i, a)| all[..i].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| apart - (a[0] - b[0]).hypot(a[1] - b[1])).collect()
}

/// Overlap of two square robots that push head on, m.
fn between_two(row: &[f32]) -> Vec<f32> {
    let [a, b] = [0, 1].map(|index| robots(row).nth(index).expect("two robots")[0]);
    vec![2.0 * RobotModel::VSS_440RPM.front_distance() - (b - a)]
}

fn head_on(config: SimConfig) -> Scene {
    let driver = Driver::Constant(vec![vec![46.0, 46.0]; 2]);
    let mut scene = Scene::at("head_on", config, &[[-0.1, 0.0, 0.0], [0.1, 0.0, 180.0]], driver);
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    scene
}

#[allow(clippy::print_stdout)] // the tables are what it is for
fn main() {
    for engine in EngineKind::ALL {
        println!("{}", engine.name());
        print_table(engine);
    }
}

#[allow(clippy::print_stdout)]
fn print_table(engine: EngineKind) {
    let settings = TICKS.iter().flat_map(|tick| SUB_STEPS.map(|sub_steps| (sub_steps, *tick)));
    let measured: Vec<_> = settings
        .map(|(sub_steps, tick)| {
            let of = |config: SimConfig| SimConfig { tick, engine, ..config };
            let vss = Scene { config: of(scenes::vss(3, 3)), ..scenes::chase() };
            let ssl = scenes::ssl_chase(of(scenes::ssl(6, 6)));
            let crowd = play(&vss, sub_steps, |_| Vec::new());
            let swarm = play(&ssl, sub_steps, between_discs);
            let pushing = play(&head_on(of(scenes::vss(1, 1))), sub_steps, between_two);
            ((sub_steps, tick), crowd, swarm, pushing)
        })
        .collect();
    let time = |measured: &Measured| measured.fastest.expect("played").as_secs_f64();
    let default = (DEFAULT_SUB_STEPS, scenes::vss(3, 3).tick);
    let (_, crowd, swarm, _) =
        measured.iter().find(|(setting, ..)| *setting == default).expect("among them");
    let (usual_crowd, usual_swarm) = (time(crowd), time(swarm));
    println!(
        "| sub-steps | tick, ms | 6v6 crowd: 99th percentile | 6v6 crowd: maximum | head on: maximum | time, 3v3 crowd | time, 6v6 crowd |"
    );
    println!("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for ((sub_steps, tick), crowd, mut swarm, pushing) in measured {
        println!(
            "| {sub_steps} | {:.1} | {:.2} | {:.1} | {:.2} | {:.2} | {:.2} |",
            tick * 1e3,
            swarm.percentile() * 1e3,
            swarm.worst() * 1e3,
            pushing.worst() * 1e3,
            time(&crowd) / usual_crowd,
            time(&swarm) / usual_swarm,
        );
    }
}
