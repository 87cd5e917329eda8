//! Shots at the goal of a scripted keeper.

use rsim_core::SimConfig;
use rsim_referee::Team;
use rsim_referee::codes::Command;
use rsim_referee::config::Placement;

use crate::arena::Arena;

/// Place where the keeper can save nothing, m.
const FAR: [f32; 2] = [2.0, -2.5];
/// Shots from 2.5 m before the goal line: place in the goal, m.
const PLACES: [f32; 4] = [-0.3, -0.15, 0.15, 0.3];

/// Goals of yellow by the shots, at a blue goal whose keeper stands at a place.
fn goals(keeper: [f32; 2]) -> i32 {
    let scores = PLACES.map(|y| {
        let config = SimConfig::ssl(2, 2);
        let mut arena = Arena::new(config, [1.0, 1.0], 60.0, Placement::Teleport, 1);
        arena.game.give(Command::ForceStart, None);
        arena.game.in_play = true;
        arena.set_robot(0, keeper);
        arena.set_robot(1, [2.0, 2.5]);
        arena.set_robot(2, [4.2, 0.0]);
        arena.set_robot(3, [2.5, 2.0]);
        arena.set_ball([-2.0, 0.0], [-4.5, 4.5 * y / 2.5]);
        (0..50).for_each(|_| arena.step());
        arena.game.score[Team::Yellow]
    });
    scores.iter().sum()
}

#[test]
fn the_keeper_saves_shots_that_would_go_in() {
    let all = i32::try_from(PLACES.len()).expect("a few");
    assert_eq!(goals(FAR), all, "nobody is in their way");
    assert_eq!(goals([-4.1, 0.0]), 0);
}
