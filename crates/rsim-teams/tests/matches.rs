//! Matches of scripted sides.

use rsim_core::{Field, SimConfig};
use rsim_referee::Team;
use rsim_referee::config::Placement;

use crate::arena::Arena;

fn six(skills: [f32; 2], half_seconds: f32, placement: Placement, seed: u32) -> Arena {
    Arena::new(SimConfig::ssl(6, 6), skills, half_seconds, placement, seed)
}

#[test]
fn skilled_teams_pass_and_obey_the_rules() {
    let mut arena = six([1.0, 1.0], 120.0, Placement::Teleport, 1);
    arena.run();
    let counts = &arena.counts;
    let minutes = counts.steps as f32 * arena.config.time_step / 60.0;
    let passes: u32 = counts.passes.iter().sum();
    let offenses: u32 = counts.offenses.iter().sum();
    assert!(passes as f32 > 4.0 * minutes, "{passes} passes in {minutes} minutes");
    assert!((offenses as f32) < minutes, "{offenses} in {minutes} minutes: {:?}", counts.events);
    assert!(2 * counts.in_play > counts.steps, "{counts:?}");
}

#[test]
fn unskilled_teams_obey_the_rules_too() {
    let mut arena = six([0.0, 0.0], 120.0, Placement::Teleport, 2);
    arena.run();
    let minutes = arena.counts.steps as f32 * arena.config.time_step / 60.0;
    let offenses: u32 = arena.counts.offenses.iter().sum();
    assert!((offenses as f32) < minutes, "{offenses}: {:?}", arena.counts.events);
}

#[test]
fn robots_place_the_ball_wherever_it_lies() {
    let mut arena = six([1.0, 0.5], 90.0, Placement::Robots, 3);
    arena.run();
    let placed = arena.counts.of("PLACEMENT_SUCCEEDED");
    let failed = arena.counts.of("PLACEMENT_FAILED");
    assert!(placed > 5 && 10 * failed <= placed, "{placed} placed, {failed} failed");
}

#[test]
fn skill_wins() {
    let mut goals = [0, 0];
    for seed in 0..2 {
        let mut arena = six([1.0, 0.2], 150.0, Placement::Teleport, seed);
        arena.run();
        for team in Team::BOTH {
            goals[team.index()] += arena.game.score[team];
        }
    }
    assert!(goals[0] >= goals[1] + 3, "{goals:?}");
}

#[test]
fn a_match_goes_on_from_its_rows_bit_for_bit() {
    let mut arena = six([1.0, 0.3], 60.0, Placement::Teleport, 4);
    (0..400).for_each(|_| arena.step());
    let mut copy = arena.clone();
    for _ in 0..400 {
        arena.step();
        copy.step();
    }
    assert_eq!(arena.row, copy.row);
    assert_eq!(arena.game, copy.game);
}

#[test]
fn teams_of_all_sizes_play() {
    let large = SimConfig { field: Field::SSL_A, ..SimConfig::ssl(11, 11) };
    for config in [SimConfig::ssl(1, 1), SimConfig::ssl(2, 3), SimConfig::ssl(6, 1), large] {
        let sizes = (config.blue.len(), config.yellow.len());
        let seeds = if sizes.0 > 6 { 2 } else { 20 };
        let mut stalls = 0;
        for seed in 0..seeds {
            let mut arena = Arena::new(config.clone(), [1.0, 1.0], 20.0, Placement::Teleport, seed);
            (0..1200).for_each(|_| arena.step());
            stalls += arena.counts.of("NO_PROGRESS_IN_GAME") / 2; // an event of both teams
            assert!(arena.counts.in_play > 200, "{sizes:?}: {:?}", arena.counts);
        }
        assert!(10 * stalls <= seeds, "{sizes:?}: nobody plays the ball, {stalls} times");
    }
}
