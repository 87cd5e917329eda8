//! Kick-offs and throw-ins of scripted sides under the referee.

use rsim_core::SimConfig;
use rsim_referee::config::Placement;

use crate::arena::Arena;

/// Offenses at a restart.
const AT_RESTARTS: [&str; 5] = [
    "ATTACKER_DOUBLE_TOUCHED_BALL",
    "ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA",
    "BOT_TOO_FAST_IN_STOP",
    "DEFENDER_TOO_CLOSE_TO_KICK_POINT",
    "BOT_INTERFERED_PLACEMENT",
];
/// Time in which a kick-off has to be taken, s.
const KICKOFF: f32 = 20.0;

fn arena(skill: f32, seed: u32) -> Arena {
    Arena::new(SimConfig::ssl(6, 6), [skill; 2], 90.0, Placement::Teleport, seed)
}

#[test]
fn kick_offs_are_taken_in_time_and_with_one_touch() {
    for (skill, seed) in [(1.0, 0), (1.0, 1), (0.5, 0), (0.0, 0)] {
        let mut arena = arena(skill, seed);
        while !arena.game.in_play {
            arena.step();
            let seconds = arena.counts.steps as f32 * arena.config.time_step;
            assert!(seconds < KICKOFF, "no kick-off at skill {skill}");
        }
        (0..120).for_each(|_| arena.step());
        let events = &arena.counts.events;
        assert_eq!(arena.counts.of("ATTACKER_DOUBLE_TOUCHED_BALL"), 0, "{skill}: {events:?}");
        assert_eq!(arena.counts.of("NO_PROGRESS_IN_GAME"), 0, "{skill}: {events:?}");
    }
}

#[test]
fn throw_ins_are_taken_without_a_foul() {
    for skill in [1.0, 0.3] {
        let mut arena = arena(skill, 3);
        arena.run();
        let counts = &arena.counts;
        assert!(counts.of("BALL_LEFT_FIELD_TOUCH_LINE") > 2, "{:?}", counts.events);
        let fouls: u32 = AT_RESTARTS.iter().map(|event| counts.of(event)).sum();
        assert_eq!(fouls, 0, "skill {skill}: {:?}", counts.events);
    }
}
