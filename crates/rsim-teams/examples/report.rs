//! Matches of scripted sides: `cargo run --release -p rsim-teams --example report -- 1.0 0.5 10` plays ten of
//! two halves of five minutes between sides of skill 1.0 and 0.5.

#[path = "../tests/arena/mod.rs"]
mod arena;

use std::time::Instant;

use arena::Arena;
use rsim_core::SimConfig;
use rsim_referee::Team;
use rsim_referee::config::Placement;

#[allow(clippy::print_stdout)] // it talks to the person who runs it
fn main() {
    let numbers: Vec<f32> =
        std::env::args().skip(1).map(|text| text.parse().expect("a number")).collect();
    let [blue, yellow, matches, by_robots @ ..] = &numbers[..] else {
        println!("usage: report BLUE_SKILL YELLOW_SKILL MATCHES [1 for placements by robots]");
        return;
    };
    let placement = if by_robots.is_empty() { Placement::Teleport } else { Placement::Robots };
    let mut results = [0; 3];
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small number
    for seed in 0..*matches as u32 {
        let config = SimConfig::ssl(6, 6);
        let time_step = f64::from(config.time_step);
        let mut arena = Arena::new(config, [*blue, *yellow], 300.0, placement, seed);
        let begin = Instant::now();
        arena.run();
        let seconds = begin.elapsed().as_secs_f64();
        let [ours, theirs] = Team::BOTH.map(|team| arena.game.score[team]);
        results[usize::from(ours <= theirs) + usize::from(ours < theirs)] += 1;
        let counts = &arena.counts;
        let played = f64::from(counts.steps) * time_step;
        println!(
            "{ours}:{theirs}, passes {:?}, offenses {:?}, {:.1} minutes, {:.0} % in play, {:.0} x real time, {} bytes a row",
            counts.passes,
            counts.offenses,
            played / 60.0,
            100.0 * f64::from(counts.in_play) / f64::from(counts.steps),
            played / seconds,
            4 * arena.row.len()
        );
        println!("{:?}", counts.events);
    }
    println!("won, drawn, lost by blue: {results:?}");
}
