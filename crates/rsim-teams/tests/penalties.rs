//! Penalty kicks of scripted sides against scripted keepers.

use rsim_core::SimConfig;
use rsim_referee::Team;
use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::Placement;

use crate::arena::Arena;

/// Kicks that a share is of.
const KICKS: u32 = 40;
/// Time in which a kick has to be decided, s: the stop, the preparation and the kick.
const PATIENCE: f32 = 40.0;

/// Results of penalty kicks.
#[derive(Debug, Default)]
struct Kicks {
    goals: u32,
    /// Offenses of both teams.
    offenses: u32,
}

/// Kicks of blue of a skill against a keeper of a skill, of teams of some robots.
fn kicks([blue, yellow]: [f32; 2], robots: usize) -> Kicks {
    let mut all = Kicks::default();
    for seed in 0..KICKS {
        let config = SimConfig::ssl(robots, robots);
        let mut arena = Arena::new(config, [blue, yellow], 300.0, Placement::Teleport, seed);
        arena.game.stage = Stage::FirstHalf;
        arena.game.stage_steps_left = 10_000;
        arena.game.give(Command::Stop, Some(Command::PreparePenalty(Team::Blue)));
        arena.game.designated_position = arena.penalty_mark(Team::Blue);
        let is_decided =
            |arena: &Arena| arena.counts.of("GOAL") + arena.counts.of("PENALTY_KICK_FAILED") > 0;
        while !is_decided(&arena) {
            arena.step();
            let seconds = arena.counts.steps as f32 * arena.config.time_step;
            assert!(seconds < PATIENCE, "no end of kick {seed}: {:?}", arena.counts.events);
        }
        if arena.counts.offenses != [0, 0] || arena.counts.of("UNSPORTING_BEHAVIOR_MINOR") > 0 { println!("{seed} {:?}", arena.counts.events); }
        all.goals += arena.counts.of("GOAL");
        all.offenses += arena.counts.offenses.iter().sum::<u32>();
        all.offenses += arena.counts.of("UNSPORTING_BEHAVIOR_MINOR");
    }
    all
}

#[test]
fn kickers_score_beside_the_keeper_and_the_better_keeper_saves_more() {
    for (skills, robots) in [([1.0, 1.0], 2), ([1.0, 1.0], 6), ([0.5, 0.5], 2), ([0.2, 0.2], 2), ([1.0, 0.2], 2), ([0.2, 1.0], 2)] {
        println!("{skills:?} {robots}: {:?} of {KICKS}", kicks(skills, robots));
    }
}
