//! One match, from the kick-off until the first goal: `cargo run --release --example one_match`.

use rsim_core::columns::{ball_column, crossing_name};
use rsim_core::scenes;

#[allow(clippy::print_stdout)] // it talks to the person who runs it
fn main() {
    let scene = scenes::chase();
    let mut world = scene.world();
    let mut row = scene.start.clone();
    for step in 0..4000 {
        world.step(&scene.commands(&row, step, 3)).expect("the state stays finite");
        world.write_row(&mut row);
        let crossed = row[ball_column("crossed")];
        if crossed != 0.0 {
            let seconds = step as f32 * scene.config.time_step;
            println!("{} crossed after {seconds:.1} s", crossing_name(crossed));
            return;
        }
    }
    println!("no goal");
}
