//! Throughput of the physics alone: control steps (25 ms of 5 ms ticks) per second.
//!
//! League and team sizes x scene x worlds x threads. A scene restarts every 400 steps, so that a crowd
//! does not end in a corner.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{Batch, Field, SimConfig};

/// Steps between two starts of a scene.
const EPISODE: u64 = 400;

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

/// A scene with the range of its contacts: a benchmark of a crowd must have a crowd.
struct Case {
    /// League and team sizes.
    teams: &'static str,
    scene: Scene,
    /// Range of the number of contacts in the first steps.
    contacts: std::ops::RangeInclusive<usize>,
}

fn cases() -> Vec<Case> {
    let most = usize::MAX;
    let mut cases = vec![
        Case { teams: "vss_3v3", scene: scenes::vss_free(), contacts: 0..=0 },
        Case { teams: "vss_3v3", scene: scenes::random_play(), contacts: 50..=most },
        Case { teams: "vss_3v3", scene: scenes::chase(), contacts: 1000..=most },
    ];
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
    for driver in [Driver::Random, Driver::Chase] {
        let (name, contacts) = named(&driver, 50, 1000);
        let scene = Scene::lined_up(name, vss_5v5.clone(), driver);
        cases.push(Case { teams: "vss_5v5", scene, contacts: contacts..=most });
    }
    let ssl_a = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    for (teams, config, random, crowd) in [
        ("ssl_1v1", scenes::ssl(1, 1), 1, 20),
        ("ssl_6v6", scenes::ssl(6, 6), 20, 1000),
        ("ssl_11v11", ssl_a, 20, 2000),
    ] {
        for driver in [Driver::STILL, Driver::Random, Driver::Chase] {
            let (name, contacts) = named(&driver, random, crowd);
            let free = driver == Driver::STILL;
            let mut scene = Scene::lined_up(name, config.clone(), driver);
            if free {
                scene.set_ball([0.0, 0.3], [0.0, 1.0]);
            }
            let contacts = if free { 0..=0 } else { contacts..=most };
            cases.push(Case { teams, scene, contacts });
        }
    }
    cases
}

/// Label of a driver, and the minimum number of contacts: `random` in random play, `crowd` in a crowd.
fn named(driver: &Driver, random: usize, crowd: usize) -> (&'static str, usize) {
    match driver {
        Driver::Constant(_) => ("free", 0),
        Driver::Random => ("random", random),
        Driver::Chase => ("crowd", crowd),
    }
}

fn step(criterion: &mut Criterion) {
    for Case { teams, scene, contacts } in cases() {
        let (_, seen) = scene.play(&mut scene.world(), WATCHED);
        assert!(contacts.contains(&seen), "{teams} {}: {seen} contacts", scene.name);
        let mut group = criterion.benchmark_group(format!("{teams}_step"));
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
        (std::time::Duration::from_millis(500), std::time::Duration::from_secs(2));
    Criterion::default().warm_up_time(warm_up).measurement_time(measure).sample_size(20)
}

criterion_group! { name = benches; config = settings(); targets = step, place }
criterion_main!(benches);
