//! Throughput of the physics alone: control steps (25 ms of 5 ms ticks) per second, one thread.
//!
//! Scene x worlds. A scene starts over every 400 steps, so that a crowd does not end in a corner.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rsim_core::Batch;
use rsim_core::scenes::{self, Scene};

/// Steps between two starts of a scene.
const EPISODE: u64 = 400;

/// A scene that is played over and over, and what it has seen so far.
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

    /// Decides what the robots do next: not part of what is timed.
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

/// A benchmark of a crowd without a crowd would be worth nothing.
fn assert_contacts(scene: &Scene, at_least: usize) {
    let (_, contacts) = scene.play(&mut scene.world(), EPISODE);
    assert!(contacts >= at_least, "{}: {contacts} contacts in {EPISODE} steps", scene.name);
}

fn step(criterion: &mut Criterion) {
    let scenes = [(scenes::random_play(), 50), (scenes::chase(), 1000)];
    let mut group = criterion.benchmark_group("vss_3v3_step");
    for (scene, contacts) in scenes {
        assert_contacts(&scene, contacts);
        for worlds in [1, 256] {
            group.throughput(Throughput::Elements(worlds as u64));
            let mut player = Player::new(scene.clone(), worlds, 1);
            group.bench_function(BenchmarkId::new(scene.name, worlds), |bencher| {
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
    }
    group.finish();
}

fn place(criterion: &mut Criterion) {
    let scene = scenes::chase();
    let mut world = scene.world();
    criterion.bench_function("vss_3v3_place", |bencher| {
        bencher.iter(|| world.place(black_box(&scene.start), None).expect("valid"));
    });
}

criterion_group!(benches, step, place);
criterion_main!(benches);
