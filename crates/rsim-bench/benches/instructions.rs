//! One scene for `valgrind --tool=callgrind`: `python -m benches.instructions` runs it and prints a table.
//!
//! Arguments: a case, such as `vss_3v3_random`, an engine and a number of steps. [`step`] is the
//! function to count. The output is the number of counted ticks, and of those without the solver.

use std::hint::black_box;

use rsim_bench::cases;
use rsim_core::scenes::Scene;
use rsim_core::{Batch, EngineKind};

/// Steps a batch of one world and writes its row.
#[inline(never)]
fn step(batch: &mut Batch, commands: &[f32], row: &mut [f32]) {
    batch.step(commands, row, None).expect("the state stays finite");
}

fn play(scene: &Scene, steps: u64) {
    let (mut batch, mut row) = scene.batch(1, 1);
    for n in 0..steps {
        let commands = scene.commands(&row, n, 0);
        step(&mut batch, &commands, &mut row);
    }
    black_box(&row);
}

#[allow(clippy::print_stdout)] // the numbers are what it is for
fn main() {
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let [name, engine, steps] = &arguments[..] else {
        println!("arguments: a case, an engine and a number of steps");
        return;
    };
    let engine = EngineKind::named(engine).expect("the second argument names an engine");
    let steps: u64 = steps.parse().expect("the third argument is a number");
    let case =
        cases().into_iter().find(|case| *name == format!("{}_{}", case.teams, case.scene.name));
    let scene = case.expect("the first argument names a case").scene_with(engine);
    play(&scene, steps);
    // The same once more, outside the counted function.
    let mut world = scene.world();
    scene.play(&mut world, steps);
    let ticks = steps * scene.config.ticks_per_step() as u64;
    println!("{ticks} {}", world.contact_free_ticks());
}
