"""Rollouts: decisions of the current policy in its matches."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Floats, Mask
from rsoccer.matches import Matches
from rsoccer.reflection import Reflection
from rsoccer.train.clock import Clock
from rsoccer.train.network.actor_critic import OBSERVATION_CLIP
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.opponents.policy_mix import PolicyMix
from rsoccer.train.rollout.central_inputs import CentralInputs
from rsoccer.train.rollout.episode_stats import EpisodeStats, Row
from rsoccer.train.rollout.running_mean_std import RunningMeanStd
from rsoccer.train.rollout.samples import Rollout
from rsoccer.train.rollout.settings import RolloutSettings
from rsoccer.train.rollout.transition import Transition, repeat_action


class RolloutCollector:
    """Plays matches with the current policy and records its decisions.

    Attributes:
        matches: the matches in progress.
        observations: (n, agents, o) current observations, not normalized.
        discounted_returns: (n, agents) discounted sums of past rewards; their standard deviation
            scales the rewards.
        states: (n, s) current global states; None without a centralized critic.
        central: inputs of a centralized critic; None if the critic reads the observations.
        obs_rms: running mean and standard deviation of the observations.
        return_rms: running standard deviation of `discounted_returns`.
        episode_stats: statistics of the episodes that ended.
        reward_means: mean reward per decision in the last rollout, and of each reward term.
    """

    def __init__(
        self,
        settings: RolloutSettings,
        evaluator: Evaluator,
        generator: torch.Generator,
        clock: Clock,
        kinds: tuple[str, ...] = (),
        *,
        central: CentralInputs | None = None,
        reflection: Reflection | None = None,
    ) -> None:
        """Create a collector; `enter` gives it matches.

        Args:
            settings: settings of the rollouts.
            evaluator: evaluates the policy that acts.
            generator: draws actions and truncations.
            clock: measures the time of acting and of the matches.
            kinds: names of the kinds of opponents; without a mix all are of the first kind.
            central: inputs of a centralized critic; None if the critic reads the observations.
            reflection: reflection of an observation that the statistics do not change under; None
                for none.
        """
        self._settings, self._generator = settings, generator
        self._evaluator, self._model = evaluator, evaluator.model
        self._clock, self.central = clock, central
        self.obs_rms = RunningMeanStd(self._model.observation_size, reflection=reflection)
        self.states: Floats | None = None
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

    def collect(self, gamma: float, check_stop: Callable[[], None]) -> Rollout:
        """Play `horizon` decisions in every world.

        Args:
            gamma: discount factor per decision of `discounted_returns`.
            check_stop: called before each decision; an exception that it raises ends the rollout.

        Returns:
            The decisions of all learners in all worlds.
        """
        decisions: list[tuple[Tensor, ...]] = []
        observations: list[Floats] = []
        states: list[Floats] = []
        self.reward_means = {}
        for _ in range(self._settings.horizon):
            check_stop()
            observations.append(self.observations)
            if self.states is not None:
                states.append(self.states)
            decisions.append(self._play_decision(gamma))
        if self._settings.normalize_observations:
            size = self._model.observation_size
            self.obs_rms.update(np.concatenate(observations).reshape(-1, size))
            if self.central is not None:
                self.central.update(states)
        played = Rollout(*(torch.stack(parts) for parts in zip(*decisions, strict=True)))
        scale = float(self.return_rms.std[0])
        return dataclasses.replace(played, rewards=played.rewards / scale)

    @torch.no_grad()
    def _play_decision(self, gamma: float) -> tuple[Tensor, ...]:
        """One decision in every world: the fields of a `Rollout`, (worlds x agents, ...)."""
        with self._clock.measure("acting"):
            observations = self._normalize(self.observations)
            mean = self._evaluator.mean(observations)
            noise = torch.randn(mean.shape, generator=self._generator)
            actions = mean + noise * self._model.log_std.exp()
            log_probs = self._model.log_prob(mean, actions)
            inputs = self._critic_inputs(observations, self.states)
        with self._clock.measure("matches"):
            shape = (*self.discounted_returns.shape, actions.shape[-1])
            transition = repeat_action(
                self.matches,
                actions.numpy().reshape(shape),
                self._settings.action_repeat,
                with_states=self.central is not None,
            )
            self._record(transition, gamma)
            ended = transition.ended | self._draw_truncations()
            self.discounted_returns[ended] = 0.0
            self.observations = transition.observations
            if ended.any():
                self.observations = self.matches.reset(mask=ended)
            self._update_states()
        agents = self.discounted_returns.shape[1]
        return (
            observations,
            actions,
            log_probs,
            torch.tensor(transition.rewards.reshape(-1)),
            self._critic_inputs(self._normalize(transition.observations), transition.states),
            torch.tensor(np.repeat(transition.terminated, agents)),
            torch.tensor(np.repeat(ended, agents)),
            *([] if self.central is None else [inputs]),
        )

    def _draw_truncations(self) -> Mask:
        """Mask (n,) of random truncations, which are treated like time limits."""
        uniform = torch.rand(len(self.discounted_returns), generator=self._generator)
        return (uniform < self._settings.random_truncation).numpy()

    def _record(self, transition: Transition, gamma: float) -> None:
        """Update the statistics of rewards and of ended episodes."""
        self.discounted_returns = self.discounted_returns * np.float32(gamma) + transition.rewards
        if self._settings.normalize_rewards:
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
        horizon = self._settings.horizon
        for name, mean in {**means, "reward": float(transition.rewards.mean())}.items():
            self.reward_means[name] = self.reward_means.get(name, 0.0) + mean / horizon

    def _update_states(self) -> None:
        """Read the current global states, if a centralized critic needs them."""
        if self.central is not None:
            self.states = self.matches.states()

    def _critic_inputs(self, observations: Tensor, states: Floats | None) -> Tensor:
        """Inputs of the value network (worlds x agents, s + o) of normalized observations."""
        if self.central is None or states is None:
            return observations
        return self.central.join(states, observations)

    def _normalize(self, observations: Floats) -> Tensor:
        """Normalized observations (worlds x agents, o) of observations (n, agents, o)."""
        mean, std = self.obs_rms.as_float32()
        flat = observations.reshape(-1, observations.shape[-1])
        clipped = np.clip((flat - mean) / std, -OBSERVATION_CLIP, OBSERVATION_CLIP)
        return torch.tensor(clipped) * self._model.mask
