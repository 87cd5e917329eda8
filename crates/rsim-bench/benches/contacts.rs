//! Cost of contacts under both engines: `cargo bench -p rsim-bench --bench contacts` prints a table.
//!
//! Two teams face each other in lanes. In some lanes they push each other head on, in the others they
//! stand still, far apart: the matches of a league differ by their contacts alone.

use std::time::{Duration, Instant};

use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{EngineKind, Field, SimConfig, World};

/// Steps until pushing robots rest against each other, and timed steps after that.
const SETTLING: usize = 40;
const TIMED: usize = 50;
/// Number of times that every match is played, in turns; the table has medians.
const ROUNDS: usize = 201;

/// A match of a league in which `pairs` pairs of robots push each other.
struct Match {
    pairs: usize,
    /// The match after the settling steps.
    world: World,
    commands: Vec<f32>,
}

impl Match {
    /// `ahead` is the command that drives a robot straight ahead.
    fn new(config: &SimConfig, ahead: &[f32], pairs: usize) -> Self {
        let scene = lanes(config, ahead, pairs);
        let mut world = scene.world();
        // A match without contacts would go without the solver.
        world.disable_contact_free_ticks();
        let commands = scene.commands(&scene.start, 0, 0);
        for _ in 0..SETTLING {
            world.step(&commands).expect("the state stays finite");
        }
        Self { pairs, world, commands }
    }

    /// Time of a step, us.
    fn play(&self) -> f64 {
        let (mut world, mut spent) = (self.world.clone(), Duration::ZERO);
        for _ in 0..TIMED {
            let start = Instant::now();
            world.step(&self.commands).expect("the state stays finite");
            spent += start.elapsed();
            assert_eq!(world.contacts(), self.pairs, "pairs that push, and nothing else, touch");
        }
        spent.as_secs_f64() * 1e6 / TIMED as f64
    }
}

/// Scene in which the robots of the first lanes nearly touch and drive at each other; the others stand
/// still.
fn lanes(config: &SimConfig, ahead: &[f32], pairs: usize) -> Scene {
    let (field, robots) = (&config.field, config.blue.len());
    let lane = field.width / (robots + 1) as f32;
    let (near, far) = (config.blue[0].bounding_radius() + 0.001, field.length / 4.0);
    let pose = |index: usize, side: f32, heading: f32| {
        let x = if index < pairs { near } else { far };
        [side * x, (index + 1) as f32 * lane - field.half_width(), heading]
    };
    let blue = (0..robots).map(|index| pose(index, -1.0, 0.0));
    let yellow = (0..robots).map(|index| pose(index, 1.0, 180.0));
    let poses: Vec<_> = blue.chain(yellow).collect();
    let command = |index| if index % robots < pairs { ahead.to_vec() } else { Vec::new() };
    let driver = Driver::Constant((0..2 * robots).map(command).collect());
    let mut scene = Scene::at("lanes", config.clone(), &poses, driver);
    scene.set_ball([0.0, field.half_width() - lane / 2.0], [0.0, 0.0]);
    scene
}

/// Rows of a league and an engine; the first match is the one without contacts.
fn rows(teams: &str, engine: EngineKind, matches: &[Match]) -> Vec<String> {
    let rounds: Vec<Vec<f64>> =
        (0..ROUNDS).map(|_| matches.iter().map(Match::play).collect()).collect();
    let without = median(rounds.iter().map(|times| times[0]));
    let row = |(index, played): (usize, &Match)| {
        let step = median(rounds.iter().map(|times| times[index]));
        // Ratios are taken within a round, so that a machine that slows down does not bias them.
        let ratio = median(rounds.iter().map(|times| times[index] / times[0]));
        let adds = match played.pairs {
            0 => String::new(),
            contacts => format!("{:.1}", (ratio - 1.0) * without / contacts as f64),
        };
        let engine = engine.name();
        format!("| {teams} | `{engine}` | {} | {step:.1} | {ratio:.2} | {adds} |", played.pairs)
    };
    matches.iter().enumerate().map(row).collect()
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[allow(clippy::print_stdout)] // the table is what it is for
fn main() {
    println!("| match | engine | contacts | step, us | relative | per contact, us |");
    println!("| --- | --- | ---: | ---: | ---: | ---: |");
    for engine in EngineKind::ALL {
        let vss = SimConfig { field: Field::VSS_5V5, engine, ..scenes::vss(5, 5) };
        let vss = [0, 1, 2, 3, 4, 5].map(|pairs| Match::new(&vss, &[46.0, 46.0], pairs));
        let ssl = SimConfig { field: Field::SSL_A, engine, ..scenes::ssl(11, 11) };
        let ssl = [0, 1, 3, 5, 7, 9, 11].map(|pairs| Match::new(&ssl, &[3.7], pairs));
        for row in [rows("VSSS 5 v 5", engine, &vss), rows("SSL 11 v 11", engine, &ssl)].concat() {
            println!("{row}");
        }
    }
}
