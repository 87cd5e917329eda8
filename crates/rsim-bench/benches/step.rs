//! Throughput of the physics alone: control steps (25 ms of 5 ms ticks) per second.
//!
//! League and team sizes x engine x scene x worlds x threads. A scene restarts every 400 steps, so that a
//! crowd does not end in a corner. `cargo bench -p rsim-bench --bench step -- compact` measures the cases
//! with that text in their name.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rsim_bench::{Case, EPISODE, cases};
use rsim_core::scenes::{self, Scene};
use rsim_core::{Batch, EngineKind};

/// Steps in which the contacts of a scene are counted.
const WATCHED: u64 = 2 * EPISODE;

/// A scene that is played repeatedly.
struct Player {
    scene: Scene,
    batch: Batch,
    rows: Vec<f32>,
    commands: Vec<f32>,
    step: u64,
}

impl Player {
    fn new(scene: Scene, worlds: usize, threads: usize) -> Self {
        let (batch, rows) = scene.batch(worlds, threads);
        Self { scene, batch, rows, commands: Vec::new(), step: 0 }
    }

    /// Computes the next commands, outside the timed part.
    fn decide(&mut self) {
        if self.step % EPISODE == 0 {
            let worlds = self.batch.worlds();
            let starts = self.scene.start.repeat(worlds);
            self.batch.place(&vec![true; worlds], &starts, None, &mut self.rows).expect("valid");
        }
        let each = self.rows.chunks_exact(self.scene.config.row_size()).enumerate();
        self.commands.clear();
        self.commands.extend(
            each.flat_map(|(world, row)| self.scene.commands(row, self.step, world as u64 * 7919)),
        );
        self.step += 1;
    }

    fn step(&mut self) {
        self.batch.step(&self.commands, &mut self.rows, None).expect("finite");
    }
}

fn step(criterion: &mut Criterion) {
    for case in cases() {
        for engine in EngineKind::ALL {
            step_with(criterion, &case, engine);
        }
    }
}

/// Measures a case with an engine. `benches/criterion.py` reads the names.
fn step_with(criterion: &mut Criterion, case: &Case, engine: EngineKind) {
    let scene = case.scene_with(engine);
    let (_, seen) = scene.play(&mut scene.world(), WATCHED);
    let name = format!("{}_{}", case.teams, engine.name());
    assert!(case.contacts.contains(&seen), "{name} {}: {seen} contacts", scene.name);
    let mut group = criterion.benchmark_group(name);
    for (worlds, threads) in [(1, 1), (256, 1), (256, 2)] {
        group.throughput(Throughput::Elements(worlds as u64));
        let mut player = Player::new(scene.clone(), worlds, threads);
        let id = BenchmarkId::new(scene.name, format!("{worlds}x{threads}"));
        group.bench_function(id, |bencher| {
            bencher.iter_custom(|iterations| {
                let mut spent = std::time::Duration::ZERO;
                for _ in 0..iterations {
                    player.decide();
                    let start = std::time::Instant::now();
                    player.step();
                    spent += start.elapsed();
                }
                black_box(&player.rows);
                spent
            });
        });
    }
    group.finish();
}

fn place(criterion: &mut Criterion) {
    for scene in [scenes::chase(), scenes::ssl_random(scenes::ssl(11, 11))] {
        let mut world = scene.world();
        let robots = scene.config.n_robots();
        criterion.bench_function(&format!("place_{robots}_robots"), |bencher| {
            bencher.iter(|| world.place(black_box(&scene.start), None).expect("valid"));
        });
    }
}

fn settings() -> Criterion {
    let (warm_up, measure) =
        (std::time::Duration::from_millis(300), std::time::Duration::from_secs(1));
    Criterion::default().warm_up_time(warm_up).measurement_time(measure).sample_size(20)
}

criterion_group! { name = benches; config = settings(); targets = step, place }
criterion_main!(benches);
