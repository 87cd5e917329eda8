//! Observations of the self-play and match tasks, in the layouts that policy files name.
//!
//! The features are the core's and the referee's. What `python/rsoccer/tasks/` adds is here again: order, last
//! action, bounds. `make check-wasm` compares with Python's observations, number for number.

use std::fmt::Write;

use rsim_core::{EgoFeatures, Observer, SimConfig};
use rsim_referee::features::FEATURES;
use rsim_referee::game::Game;
use rsim_referee::{Referee, Team};

use crate::error::MatchError;

/// Bounds of the blocks, as `OBSERVATION_LIMITS` of `python/rsoccer/tasks/soccer.py` has them.
const LIMITS: [(&str, f32); 14] = [
    ("ball", 4.0),
    ("ego", 2.0),
    ("teammates", 2.0),
    ("opponents", 2.0),
    ("action", 1.0),
    ("ball_polar", 3.0),
    ("goal_polar", 3.0),
    ("shot", 1.0),
    ("own_goal_polar", 3.0),
    ("own_goal_shot", 1.0),
    ("body_velocities", 4.0),
    ("body_positions", 3.0),
    ("presence", 1.0),
    ("game", 3.0),
];

/// Observations of one layout, for the robots of a configuration.
#[derive(Debug, Clone)]
pub struct Observations {
    features: EgoFeatures,
    /// By robot, in the order of a row.
    observers: Vec<Observer>,
    action_size: usize,
    /// Whether the state of the match is observed.
    has_game: bool,
    text: String,
    high: Vec<f32>,
}

impl Observations {
    /// The layouts of the self-play tasks and of the match tasks, for robots with actions of these sizes.
    pub(crate) fn all(config: &SimConfig, action_sizes: &[usize]) -> Vec<Self> {
        let each = action_sizes.iter().flat_map(|size| [false, true].map(|game| (*size, game)));
        each.map(|(size, game)| Self::new(config, size, game)).collect()
    }

    /// A layout: with presence and the state of the match if `has_game`.
    ///
    /// # Panics
    /// If the configuration has no robots.
    pub fn new(config: &SimConfig, action_size: usize, has_game: bool) -> Self {
        let (blue, yellow) = (config.blue.len(), config.yellow.len());
        let largest = blue.max(yellow);
        let (teammates, opponents) = (largest - 1, largest);
        let robot = config.robots().next().expect("a configuration of a match has robots");
        let features = EgoFeatures::new(&config.field, robot, teammates, opponents, has_game);
        let observers =
            (0..blue + yellow).map(|robot| observer(robot, blue, yellow, largest)).collect();
        let mut blocks = features.blocks();
        blocks.push(("action", vec![action_size]));
        if has_game {
            blocks.push(("game", vec![FEATURES.len()]));
        }
        let mut text = String::new();
        let mut high = Vec::new();
        for (name, shape) in &blocks {
            let sizes: Vec<String> = shape.iter().map(ToString::to_string).collect();
            let comma = if text.is_empty() { "" } else { ", " };
            write!(text, "{comma}{name} {}", sizes.join("x")).expect("a string takes all");
            let limit = LIMITS.iter().find(|(of, _)| of == name).expect("each block has a limit").1;
            high.extend(std::iter::repeat_n(limit, shape.iter().product()));
        }
        if action_size == 6 {
            text.push_str("; chip kick");
        }
        Self { features, observers, action_size, has_game, text, high }
    }

    /// Blocks and their shapes, as policy files have them.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Numbers in an observation.
    pub fn size(&self) -> usize {
        self.high.len()
    }

    /// Bounds of the numbers.
    pub fn high(&self) -> &[f32] {
        &self.high
    }

    /// Numbers in an action.
    pub fn action_size(&self) -> usize {
        self.action_size
    }

    /// Whether the state of the match is observed.
    pub fn has_game(&self) -> bool {
        self.has_game
    }

    /// Writes the observation of a robot: of the row that its team knows, and of the robot's last action.
    ///
    /// # Errors
    /// A row of another length.
    pub fn observe(
        &self,
        row: &[f32],
        (referee, game): (&Referee, &Game),
        robot: usize,
        action: &[f32],
        out: &mut [f32],
    ) -> Result<(), MatchError> {
        let (ego, rest) = out.split_at_mut(self.features.size());
        self.features.encode(&self.observers[robot], row, ego);
        let (last, of_game) = rest.split_at_mut(self.action_size);
        last.copy_from_slice(action);
        if self.has_game {
            referee.features(game, row)?.write(robot, of_game);
        }
        for (number, high) in out.iter_mut().zip(&self.high) {
            *number = number.clamp(-high, *high);
        }
        Ok(())
    }
}

/// A robot that observes: itself, its teammates in the order of a ring, its opponents.
fn observer(robot: usize, blue: usize, yellow: usize, largest: usize) -> Observer {
    let (all_blue, all_yellow) = (0..blue, blue..blue + yellow);
    let rotated = robot >= blue;
    let (own, others) = if rotated { (all_yellow, all_blue) } else { (all_blue, all_yellow) };
    let mut slots: Vec<Option<usize>> =
        (robot..own.end).chain(own.start..robot).map(Some).collect();
    slots.resize(largest, None);
    slots.extend(others.map(Some));
    slots.resize(2 * largest, None);
    Observer { rotated, slots }
}

/// The robots of a team, in the order of a row.
pub(crate) fn robots_of(team: Team, config: &SimConfig) -> std::ops::Range<usize> {
    match team {
        Team::Blue => 0..config.blue.len(),
        Team::Yellow => config.blue.len()..config.n_robots(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_those_of_the_tasks() {
        // `tests/test_match_crate.py` compares these texts with the tasks'.
        let cases = [
            (
                Observations::all(&SimConfig::vss(3, 3), &[2]),
                vec![
                    "ball 4, ego 7, teammates 2x7, opponents 3x7, ball_polar 3, goal_polar 3, shot 4, \
                     own_goal_polar 3, own_goal_shot 3, body_velocities 2x2, body_positions 6x2, action 2",
                    "ball 4, ego 7, teammates 2x7, opponents 3x7, ball_polar 3, goal_polar 3, shot 4, \
                     own_goal_polar 3, own_goal_shot 3, body_velocities 2x2, body_positions 6x2, presence 6, \
                     action 2, game 29",
                ],
            ),
            (
                Observations::all(&SimConfig::ssl(3, 3), &[5, 6]),
                vec![
                    "ball 6, ego 8, teammates 2x8, opponents 3x8, ball_polar 3, goal_polar 3, shot 4, \
                     body_velocities 2x2, body_positions 6x2, action 5",
                    "ball 6, ego 8, teammates 2x8, opponents 3x8, ball_polar 3, goal_polar 3, shot 4, \
                     body_velocities 2x2, body_positions 6x2, presence 6, action 5, game 29",
                    "ball 6, ego 8, teammates 2x8, opponents 3x8, ball_polar 3, goal_polar 3, shot 4, \
                     body_velocities 2x2, body_positions 6x2, action 6; chip kick",
                    "ball 6, ego 8, teammates 2x8, opponents 3x8, ball_polar 3, goal_polar 3, shot 4, \
                     body_velocities 2x2, body_positions 6x2, presence 6, action 6, game 29; chip kick",
                ],
            ),
        ];
        for (layouts, texts) in cases {
            assert_eq!(layouts.iter().map(Observations::text).collect::<Vec<_>>(), texts);
        }
        let sizes = [(SimConfig::vss(3, 3), 2), (SimConfig::ssl(3, 3), 5)]
            .map(|(config, action_size)| Observations::new(&config, action_size, false).size());
        assert_eq!(sizes, [80, 85]);
    }

    #[test]
    fn smaller_teams_leave_slots_empty() {
        let observer = observer(4, 3, 2, 3);
        assert_eq!(observer.slots, [Some(4), Some(3), None, Some(0), Some(1), Some(2)]);
        assert!(observer.rotated);
    }
}
