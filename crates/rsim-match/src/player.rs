//! A network that plays a team: stacked observations, held actions, noise.

use rsim_core::SimConfig;
use rsim_core::streams::{normals, words};

use crate::area_shield::AreaShield;
use crate::error::MatchError;
use crate::network::Network;
use crate::observations::Observations;

/// Spreads keys of decisions over all words: an odd number without a pattern.
const SPREAD: u64 = 0xD134_2543_DE82_EF95;

/// A network with its memory of the robots of a team.
#[derive(Debug, Clone)]
pub struct Player {
    network: Network,
    observations: Observations,
    seed: u64,
    /// Control steps played.
    age: u64,
    robots: Vec<Robot>,
    shield: Option<AreaShield>,
}

/// Memory of a robot.
#[derive(Debug, Clone)]
struct Robot {
    held: Vec<f32>,
    /// Action of the last control step: the held one, as a shield has changed it.
    last: Vec<f32>,
    /// Observations before the current one, and the actions between, the newest first.
    observations: Vec<Vec<f32>>,
    actions: Vec<Vec<f32>>,
}

impl Player {
    /// A network for teams of at most `robots` robots in matches of a configuration.
    ///
    /// # Errors
    /// A network with other observations or actions than those of the self-play and match tasks.
    pub(crate) fn new(
        network: Network,
        config: &SimConfig,
        action_sizes: &[usize],
        robots: usize,
        seed: u64,
    ) -> Result<Self, MatchError> {
        let (size, actions) = (network.plain_size(), network.action_size());
        let mut layouts = Observations::all(config, action_sizes);
        let fits = |layout: &Observations| {
            let same_text = network.layout().is_none_or(|text| text == layout.text());
            same_text && layout.size() == size && layout.action_size() == actions
        };
        let Some(nth) = layouts.iter().position(fits) else {
            let known: Vec<&str> = layouts.iter().map(Observations::text).collect();
            return Err(MatchError::Policy(format!(
                "a network trained on {:?} observes {}, but this match has {}",
                network.task(),
                network.layout().map_or_else(|| format!("{size} numbers"), str::to_owned),
                known.join(" -- or -- ")
            )));
        };
        let observations = layouts.swap_remove(nth);
        let past = network.history() - 1;
        let robot = Robot {
            held: vec![0.0; actions],
            last: vec![0.0; actions],
            observations: vec![vec![0.0; size]; past],
            actions: vec![vec![0.0; actions]; past],
        };
        let shield = network.is_shielded().then(|| AreaShield::new(config)).transpose()?;
        Ok(Self { network, observations, seed, age: 0, robots: vec![robot; robots], shield })
    }

    /// Observations that the network decides from.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// The network.
    pub fn network(&self) -> &Network {
        &self.network
    }

    /// Last action of a robot of the team.
    pub(crate) fn last_action(&self, robot: usize) -> &[f32] {
        &self.robots[robot].last
    }

    /// Whether the next control step brings new decisions.
    fn is_due(&self) -> bool {
        self.age % u64::from(self.network.action_repeat()) == 0
    }

    /// Decides for a robot of the team, and remembers: `observation` is the current one. `free` is false for
    /// a robot that has to stand still, whose action is 0. `shielded` is the index of the robot in a state row
    /// and the row that it knows, where a shield may change its action.
    pub(crate) fn act(
        &mut self,
        robot: usize,
        observation: &[f32],
        free: bool,
        shielded: Option<(usize, &[f32])>,
    ) -> &[f32] {
        let due = self.is_due();
        if self.age == 0 {
            let past = &mut self.robots[robot];
            past.observations.iter_mut().for_each(|old| old.copy_from_slice(observation));
            past.actions.iter_mut().for_each(|old| old.fill(0.0));
        }
        if due {
            let stacked = self.stacked(robot, observation);
            let action = self.drawn(robot, self.network.means(&stacked));
            self.robots[robot].held = action;
        }
        let robot = &mut self.robots[robot];
        robot.last.copy_from_slice(&robot.held);
        if let (Some(shield), Some((index, row))) = (&self.shield, shielded) {
            shield.apply(row, index, &mut robot.last);
        }
        if !free {
            robot.last.fill(0.0);
        }
        if !robot.observations.is_empty() {
            robot.observations.rotate_right(1);
            robot.observations[0].copy_from_slice(observation);
            robot.actions.rotate_right(1);
            robot.actions[0].copy_from_slice(&robot.last);
        }
        &robot.last
    }

    /// Ends a control step.
    pub(crate) fn end_step(&mut self) {
        self.age += 1;
    }

    /// The observation with those before it, and the actions between.
    pub(crate) fn stacked(&self, robot: usize, observation: &[f32]) -> Vec<f32> {
        let robot = &self.robots[robot];
        let past = robot.observations.iter().chain(&robot.actions).flatten();
        observation.iter().chain(past).copied().collect()
    }

    /// An action around its mean, from -1 to 1. The numbers follow from seed, step and robot alone.
    fn drawn(&self, robot: usize, mut action: Vec<f32>) -> Vec<f32> {
        if let Some(deviations) = self.network.action_std() {
            let step = self.age.wrapping_mul(64).wrapping_add(robot as u64);
            let key = self.seed ^ step.wrapping_mul(SPREAD);
            let keys = [key];
            let noise = words(&keys, deviations.len()).map(normal);
            for ((action, deviation), noise) in action.iter_mut().zip(deviations).zip(noise) {
                *action += deviation * noise;
            }
        }
        for number in &mut action {
            *number = number.clamp(-1.0, 1.0);
        }
        action
    }
}

/// A number of the standard normal distribution of a word.
fn normal(word: u64) -> f32 {
    normals(word)[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::tests::file;

    fn player(extra: &[(&str, &str)], inputs: usize) -> Result<Player, MatchError> {
        let network = Network::read(&file(inputs, 2, extra)).expect("a policy");
        Player::new(network, &SimConfig::vss(3, 3), &[2], 3, 7)
    }

    #[test]
    fn noise_is_normal() {
        let numbers: Vec<f32> = words(&[3], 20_000).map(normal).collect();
        let mean = numbers.iter().sum::<f32>() / 20_000.0;
        let variance = numbers.iter().map(|number| number * number).sum::<f32>() / 20_000.0;
        assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
    }

    #[test]
    fn actions_are_held_and_robots_have_their_own_noise() {
        let mut player = player(&[("action_repeat", "3")], 80).expect("it fits");
        let mut seen = Vec::new();
        for step in 0..7 {
            let observation = vec![0.1 * step as f32; 80];
            let first = player.act(0, &observation, true, None).to_vec();
            let second = player.act(1, &observation, true, None).to_vec();
            assert_ne!(first, second);
            player.end_step();
            seen.push(first);
        }
        assert!(seen[0] == seen[2] && seen[3] == seen[5]);
        assert!(seen[2] != seen[3] && seen[5] != seen[6]);
        let still = player.act(0, &[0.0; 80], false, None);
        assert!(still.iter().all(|number| number.abs() < 1e-9));
    }

    #[test]
    fn a_stack_has_the_newest_first() {
        let mut player = player(&[("history", "2")], 2 * 80 + 2).expect("it fits");
        let (first, second) = (vec![0.25; 80], vec![0.5; 80]);
        let begun = [first.clone(), first.clone()].concat();
        let action = player.act(0, &first, true, None).to_vec();
        player.end_step();
        assert_eq!(player.stacked(0, &second), [second, first, action].concat());
        assert_eq!(begun.len(), 160);
    }

    #[test]
    fn other_observations_are_refused_with_both_layouts() {
        let error = player(&[], 79).expect_err("79 numbers").to_string();
        assert!(error.contains("79 numbers") && error.contains("teammates 2x7"), "{error}");
        let error = player(&[("layout", "ball 80")], 80).expect_err("a layout").to_string();
        assert!(error.contains("ball 80"), "{error}");
    }
}
