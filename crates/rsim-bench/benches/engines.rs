//! Speed and memory of both contact engines, in one run: rounds alternate between the engines, so that
//! other load on the machine meets both.
//!
//! Arguments name scenes to measure, such as `vss_3v3_random`; without them all are measured.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use rsim_core::scenes::{Driver, Scene};
use rsim_core::{Batch, EngineKind, Field, SimConfig};

/// Worlds stepped together on one thread.
const WORLDS: usize = 64;

/// Control steps of a round, from the start of the scene.
const STEPS: u64 = 150;

const ROUNDS: usize = 7;

/// The system's allocator, which counts bytes in use and allocations.
struct Counting;

static IN_USE: AtomicUsize = AtomicUsize::new(0);
static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// SAFETY: all memory is the system allocator's; the counters change nothing about it.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        IN_USE.fetch_add(layout.size(), Ordering::Relaxed);
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Matches of one scene under one engine.
struct Player {
    scene: Scene,
    /// Start of each world: robots at random places, so that no single crowd decides.
    starts: Vec<f32>,
    batch: Batch,
    rows: Vec<f32>,
    /// Bytes of a world.
    memory: usize,
    /// Allocations within all timed steps but those of the first round.
    allocations: usize,
    spent: Vec<Duration>,
}

impl Player {
    fn new(mut scene: Scene, engine: EngineKind) -> Self {
        scene.config.engine = engine;
        let bytes_of = |worlds: usize| {
            let before = IN_USE.load(Ordering::Relaxed);
            let batch = scene.batch(worlds, 1);
            (batch, IN_USE.load(Ordering::Relaxed) - before)
        };
        let (_, one) = bytes_of(1);
        let ((batch, rows), all) = bytes_of(WORLDS);
        let memory = (all - one) / (WORLDS - 1);
        let starts = (0..WORLDS as u64).flat_map(|seed| {
            let mut scene = scene.clone();
            scene.scatter(seed);
            scene.start
        });
        let starts = starts.collect();
        Self { scene, starts, batch, rows, memory, allocations: 0, spent: Vec::new() }
    }

    /// Plays a round, with the computation of commands outside the timed part.
    fn round(&mut self) {
        self.batch.place(&[true; WORLDS], &self.starts, None, &mut self.rows).expect("valid");
        let (mut spent, mut commands) = (Duration::ZERO, Vec::new());
        for step in 0..STEPS {
            commands.clear();
            let rows = self.rows.chunks_exact(self.scene.config.row_size()).enumerate();
            commands.extend(
                rows.flat_map(|(world, row)| self.scene.commands(row, step, world as u64 * 7919)),
            );
            let (start, allocations) = (Instant::now(), ALLOCATIONS.load(Ordering::Relaxed));
            self.batch.step(&commands, &mut self.rows, None).expect("finite");
            spent += start.elapsed();
            if !self.spent.is_empty() {
                self.allocations += ALLOCATIONS.load(Ordering::Relaxed) - allocations;
            }
        }
        self.spent.push(spent);
    }

    /// Median time of a control step of one world, ns.
    fn median(&mut self) -> f64 {
        self.spent.sort();
        let median = self.spent[self.spent.len() / 2];
        median.as_secs_f64() * 1e9 / (STEPS as f64 * WORLDS as f64)
    }
}

fn all() -> Vec<(String, Scene)> {
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..SimConfig::vss(5, 5) };
    let ssl_a = SimConfig { field: Field::SSL_A, ..SimConfig::ssl(11, 11) };
    let teams = [
        ("vss_3v3", SimConfig::vss(3, 3)),
        ("vss_5v5", vss_5v5),
        ("ssl_1v1", SimConfig::ssl(1, 1)),
        ("ssl_6v6", SimConfig::ssl(6, 6)),
        ("ssl_11v11", ssl_a),
    ];
    let drivers = [("random", Driver::Random), ("chase", Driver::Chase)];
    let scene = |name: &str, config: &SimConfig, (kind, driver): &(&'static str, Driver)| {
        (format!("{name}_{kind}"), Scene::lined_up(kind, config.clone(), driver.clone()))
    };
    teams
        .iter()
        .flat_map(|(name, config)| drivers.iter().map(move |driver| scene(name, config, driver)))
        .collect()
}

#[allow(clippy::print_stdout)] // the table is what it is for
fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with('-')).collect();
    println!(
        "| scene | rapier, ns a step | compact | ratio | rapier, bytes a world | compact | rapier, allocations a world-step | compact |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    for (name, scene) in all() {
        if !named.is_empty() && !named.contains(&name) {
            continue;
        }
        let mut players = EngineKind::ALL.map(|engine| Player::new(scene.clone(), engine));
        for _ in 0..ROUNDS {
            players.iter_mut().for_each(Player::round);
        }
        let [rapier, compact] = players.each_mut().map(Player::median);
        let [memory_rapier, memory] = players.each_ref().map(|player| player.memory);
        let world_steps = ((ROUNDS - 1) * WORLDS) as f64 * STEPS as f64;
        let [allocations_rapier, allocations] =
            players.each_ref().map(|player| player.allocations as f64 / world_steps);
        println!(
            "| {name} | {rapier:.0} | {compact:.0} | {:.2} | {memory_rapier} | {memory} | {allocations_rapier:.2} | {allocations:.2} |",
            rapier / compact
        );
    }
}
