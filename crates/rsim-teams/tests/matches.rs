//! Whole matches.

use rsim_core::SimConfig;
use rsim_referee::Team;
use rsim_referee::config::Placement;

use crate::arena::Arena;

#[test]
#[ignore = "a tool"]
fn report() {
    let number = |name: &str, default: f32| {
        std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
    };
    let skills = [number("BLUE", 1.0), number("YELLOW", 1.0)];
    let (half, matches) = (number("HALF", 300.0), number("MATCHES", 1.0) as u32);
    let robots = number("ROBOTS", 6.0) as usize;
    let placement =
        if number("PLACE", 0.0) > 0.0 { Placement::Robots } else { Placement::Teleport };
    let mut wins = [0, 0, 0];
    for seed in 0..matches {
        let mut arena =
            Arena::new(SimConfig::ssl(robots, robots), skills, half, placement, seed);
        arena.run();
        let score = Team::BOTH.map(|team| arena.game.score[team]);
        let c = &arena.counts;
        let minutes = f64::from(c.steps) * 0.025 / 60.0;
        let nth = usize::from(score[1] > score[0]) + 2 * usize::from(score[0] == score[1]);
        wins[nth] += 1;
        println!(
            "{score:?} passes {:?} fouls {:?} shots {:?} minutes {minutes:.1} in play {:.2} us/robot {:.2} x real time {:.0}",
            c.passes,
            arena.fouls(),
            Team::BOTH.map(|team| arena.statistics.shots[team]),
            f64::from(c.in_play) / f64::from(c.steps),
            c.acting_seconds * 1e6 / f64::from(c.steps) / (2.0 * robots as f64),
            minutes * 60.0 / c.seconds
        );
        println!("{:?}", c.events);
    }
    println!("wins {wins:?}");
}
