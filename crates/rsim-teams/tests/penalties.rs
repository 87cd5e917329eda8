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
        all.goals += arena.counts.of("GOAL");
        all.offenses += arena.counts.offenses.iter().sum::<u32>();
        all.offenses += arena.counts.of("UNSPORTING_BEHAVIOR_MINOR");
    }
    all
}

/// Share of the kicks that are goals. Nobody commits an offense.
fn share(skills: [f32; 2], robots: usize) -> f32 {
    let found = kicks(skills, robots);
    assert_eq!(found.offenses, 0, "{skills:?} {robots}: {found:?}");
    found.goals as f32 / KICKS as f32
}

#[test]
fn some_kicks_are_scored_and_some_saved() {
    for robots in [1, 2, 6] {
        let scored = share([1.0, 1.0], robots);
        assert!((0.5..=0.95).contains(&scored), "{robots} robots: {scored}");
    }
}

#[test]
fn better_kickers_score_more_and_better_keepers_save_more() {
    let equal = share([1.0, 1.0], 2);
    let worse_keeper = share([1.0, 0.2], 2);
    let worse_kicker = share([0.5, 1.0], 2);
    assert!(worse_keeper > equal, "{worse_keeper} {equal}");
    assert!(worse_kicker < equal, "{worse_kicker} {equal}");
}
