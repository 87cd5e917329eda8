"""Rollouts: decisions of the current policy, recorded as a batch for PPO."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Floats, Mask
from rsoccer.matches import Matches
from rsoccer.task import Task
from rsoccer.train.args import Args
from rsoccer.train.batch import Batch
from rsoccer.train.central_critic import CentralInputs
from rsoccer.train.discount import discount_per_decision
from rsoccer.train.gae import compute_gae
from rsoccer.train.log import EpisodeStats, Row
from rsoccer.train.networks import OBSERVATION_CLIP, ActorCritic
from rsoccer.train.policy_mix import PolicyMix
from rsoccer.train.running_mean_std import RunningMeanStd
from rsoccer.train.timing import Clock
from rsoccer.train.transition import Transition, repeat_action


class RolloutCollector:
    """Plays matches with the current policy and records batches of samples.

    Attributes:
        matches: the matches in progress.
        observations: (n, agents, o) current observations, not normalised.
        discounted_returns: (n, agents) discounted sums of past rewards; their standard deviation
            scales the rewards.
        states: (n, s) current global states; None without a centralized critic.
        central: inputs of a centralized critic; None if the critic reads the observations.
        obs_rms: running mean and standard deviation of the observations.
        return_rms: running standard deviation of `discounted_returns`.
        gamma: discount factor per decision, which the trainer may change between rollouts.
        episode_stats: statistics of the episodes that ended.
        reward_means: mean reward per decision in the last rollout, and of each reward term.
    """

    def __init__(
        self,
        args: Args,
        task: Task,
        model: ActorCritic,
        generator: torch.Generator,
        clock: Clock,
        kinds: tuple[str, ...] = (),
    ) -> None:
        """Create a collector; `enter` gives it matches.

        Args:
            args: settings of the run.
            task: the task to train on.
            model: the policy that acts, and the value network.
            generator: draws actions and truncations.
            clock: measures the time of acting, of the matches and of the value network.
            kinds: names of the kinds of opponents; without a mix all are of the first kind.
        """
        self._args, self._model, self._generator, self._clock = args, model, generator, clock
        self.gamma = discount_per_decision(args, progress=0.0)
        reflection = task.layout.reflection if args.mirror_augmentation else None
        self.obs_rms = RunningMeanStd(model.observation_size, reflection=reflection)
        self.central: CentralInputs | None = None
        self.states: Floats | None = None
        if args.central_critic:
            self.central = CentralInputs(task, symmetric=args.mirror_augmentation)
        self.return_rms = RunningMeanStd(1, min_std=1e-6)
        self.episode_stats = EpisodeStats(kinds)
        self.reward_means: Row = {}

    def enter(self, matches: Matches, opponents: PolicyMix | None) -> None:
        """Start to play some matches.

        Args:
            matches: matches without automatic resets.
            opponents: the mix of policies that controls the opponents, if one does.
        """
        self.matches, self._opponents = matches, opponents
        self.discounted_returns = np.zeros((matches.worlds, len(matches.agents)), np.float32)
        self.observations = matches.reset()
        self._update_states()

    def collect(self, check_stop: Callable[[], None]) -> Batch:
        """Play `horizon` decisions in every world.

        Args:
            check_stop: called before each decision; an exception that it raises ends the rollout.

        Returns:
            Batch of horizon x worlds x agents samples.
        """
        transitions: list[tuple[Tensor, ...]] = []
        observations: list[Floats] = []
        states: list[Floats] = []
        self.reward_means = {}
        for _ in range(self._args.horizon):
            check_stop()
            observations.append(self.observations)
            if self.states is not None:
                states.append(self.states)
            transitions.append(self._play_decision())
        if self._args.normalise_observations:
            size = self._model.observation_size
            self.obs_rms.update(np.concatenate(observations).reshape(-1, size))
            if self.central is not None:
                self.central.update(states)
        return self._make_batch(*(torch.stack(parts) for parts in zip(*transitions, strict=True)))

    @torch.no_grad()
    def _play_decision(self) -> tuple[Tensor, ...]:
        """One decision in every world: the arguments of `_make_batch`, (worlds x agents, ...)."""
        with self._clock.measure("acting"):
            observations = self._normalise(self.observations)
            mean = self._model.actor(observations)
            noise = torch.randn(mean.shape, generator=self._generator)
            actions = mean + noise * self._model.log_std.exp()
            log_probs = self._model.log_prob(mean, actions)
            inputs = self._critic_inputs(observations, self.states)
        with self._clock.measure("matches"):
            shape = (*self.discounted_returns.shape, actions.shape[-1])
            transition = repeat_action(
                self.matches,
                actions.numpy().reshape(shape),
                self._args.action_repeat,
                with_states=self.central is not None,
            )
            self._record(transition)
            ended = transition.ended | self._draw_truncations()
            self.discounted_returns[ended] = 0.0
            self.observations = transition.observations
            if ended.any():
                self.observations = self.matches.reset(mask=ended)
            self._update_states()
        agents = self.discounted_returns.shape[1]
        final = transition.terminated if self._args.bootstrap_time_limits else ended
        return (
            observations,
            actions,
            log_probs,
            torch.tensor(transition.rewards.reshape(-1)),
            self._critic_inputs(self._normalise(transition.observations), transition.states),
            torch.tensor(np.repeat(final, agents)),
            torch.tensor(np.repeat(ended, agents)),
            *([] if self.central is None else [inputs]),
        )

    def _draw_truncations(self) -> Mask:
        """Mask (n,) of random truncations, which are treated like time limits."""
        uniform = torch.rand(len(self.discounted_returns), generator=self._generator)
        return (uniform < self._args.random_truncation).numpy()

    def _record(self, transition: Transition) -> None:
        """Update the statistics of rewards and of ended episodes."""
        self.discounted_returns = (
            self.discounted_returns * np.float32(self.gamma) + transition.rewards
        )
        if self._args.normalise_rewards:
            self.return_rms.update(self.discounted_returns.reshape(-1, 1))
        ended = transition.ended
        kinds = np.zeros(len(ended), int)
        if self._opponents is not None:
            kinds = self._opponents.kinds_of(self._opponents.drawn)
            if self.matches.task.success in transition.metrics:
                scores = transition.metrics[self.matches.task.success]
                self._opponents.record(ended, scores)
        metrics = {name: values[ended] for name, values in transition.metrics.items()}
        self.episode_stats.add(kinds[ended], metrics)
        means = {f"reward_{name}": mean for name, mean in transition.terms.items()}
        for name, mean in {**means, "reward": float(transition.rewards.mean())}.items():
            self.reward_means[name] = self.reward_means.get(name, 0.0) + mean / self._args.horizon

    def _make_batch(
        self,
        observations: Tensor,
        actions: Tensor,
        log_probs: Tensor,
        rewards: Tensor,
        next_inputs: Tensor,
        terminated: Tensor,
        ended: Tensor,
        central_inputs: Tensor | None = None,
    ) -> Batch:
        """Batch of the decisions of a rollout, each tensor (horizon, worlds x agents, ...)."""
        with self._clock.measure("learning"), torch.no_grad():
            inputs = observations if central_inputs is None else central_inputs
            values = self._model.value(inputs)
            next_values = self._model.value(next_inputs)
            scaled_rewards = rewards / float(self.return_rms.std[0])
            advantages = compute_gae(
                scaled_rewards,
                values,
                next_values,
                terminated,
                ended,
                self.gamma,
                self._args.gae_lambda,
            )
            batch = [observations, actions, log_probs, advantages, advantages + values]
            batch += [] if central_inputs is None else [central_inputs]
            return Batch(*(part.flatten(0, 1) for part in batch))

    def _update_states(self) -> None:
        """Read the current global states, if a centralized critic needs them."""
        if self.central is not None:
            self.states = self.matches.states()

    def _critic_inputs(self, observations: Tensor, states: Floats | None) -> Tensor:
        """Inputs of the value network (worlds x agents, s + o) of normalised observations."""
        if self.central is None or states is None:
            return observations
        return self.central.join(states, observations)

    def _normalise(self, observations: Floats) -> Tensor:
        """Normalised observations (worlds x agents, o) of observations (n, agents, o)."""
        mean, std = self.obs_rms.as_float32()
        flat = observations.reshape(-1, observations.shape[-1])
        clipped = np.clip((flat - mean) / std, -OBSERVATION_CLIP, OBSERVATION_CLIP)
        normalised = torch.tensor(clipped)
        return normalised * self._model.mask if self._args.masked_observations else normalised
