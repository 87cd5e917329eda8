//! Skill of a team: one number from 0 to 1 sets a few limits of people and robots.

use crate::tactics::Tactics;

/// Limits of a team's play.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Skill {
    /// Control steps for which a robot without the ball keeps a decision: its reaction time.
    pub(crate) reaction_steps: i32,
    /// Standard deviation of the direction of a kick, rad.
    pub(crate) aim_error: f32,
    /// Share of the robot's maximum speed that it uses with the tactics set by hand, and of its acceleration when it
    /// gets faster.
    pub(crate) speed: f32,
    /// Speed and acceleration of turns, as a share of those of a skilled team.
    pub(crate) turning: f32,
    /// Likelihood from which a pass is tried with these tactics.
    pub(crate) pass_threshold: f32,
}

/// Longest reaction time, s: more than twice that of people.
const MAX_REACTION: f32 = 0.5;
/// Largest standard deviation of the direction of a kick, rad: at 3 m it misses a goal 1 m wide as often as not.
const MAX_AIM_ERROR: f32 = 0.2;
/// Smallest one, rad: half a degree. It also keeps two sides from playing the same rally forever.
const MIN_AIM_ERROR: f32 = 0.01;
/// Smallest share of the maximum speed.
const MIN_SPEED: f32 = 0.3;
/// Smallest share of the speed of turns.
const MIN_TURNING: f32 = 0.4;

impl Skill {
    /// Share of the robot's maximum speed that a team with some tactics uses.
    pub(crate) fn speed_with(&self, tactics: &Tactics) -> f32 {
        self.speed * (tactics.speed_share / Tactics::DEFAULT.speed_share)
    }

    /// Share of the robot's maximum acceleration that a team with some tactics uses when it gets faster.
    pub(crate) fn acceleration_with(&self, tactics: &Tactics) -> f32 {
        self.speed * (tactics.acceleration_share / Tactics::DEFAULT.acceleration_share)
    }

    /// Likelihood from which a team with some tactics tries a pass.
    pub(crate) fn pass_threshold_with(&self, tactics: &Tactics) -> f32 {
        self.pass_threshold * (tactics.pass_threshold / Tactics::DEFAULT.pass_threshold)
    }

    /// Limits of a skill from 0 to 1. All of them change evenly with it.
    #[allow(clippy::cast_possible_truncation)] // few steps
    pub(crate) fn new(skill: f32, time_step: f32) -> Self {
        let missing = 1.0 - skill;
        let between = |at_none: f32, at_full: f32| at_full + (at_none - at_full) * missing;
        Self {
            reaction_steps: (between(MAX_REACTION, 0.0) / time_step).round().max(1.0) as i32,
            aim_error: between(MAX_AIM_ERROR, MIN_AIM_ERROR),
            speed: between(MIN_SPEED, Tactics::DEFAULT.speed_share),
            turning: between(MIN_TURNING, 1.0),
            pass_threshold: between(0.9, Tactics::DEFAULT.pass_threshold),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_skill_is_faster_and_more_accurate() {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|skill| Skill::new(skill, 0.025));
        assert_eq!((low.reaction_steps, high.reaction_steps), (20, 1));
        for (worse, better) in [(low, middle), (middle, high)] {
            assert!(worse.reaction_steps > better.reaction_steps);
            assert!(worse.aim_error > better.aim_error && worse.speed < better.speed);
            assert!(worse.turning < better.turning);
        }
        assert!((high.aim_error - 0.01).abs() < 1e-6);
    }
}
