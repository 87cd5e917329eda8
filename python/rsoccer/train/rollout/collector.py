"""Rollouts: decisions of the current policy in its matches."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np
import torch
from torch import Tensor

from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.matches import Matches
from rsoccer.policies.shield import Shield
from rsoccer.reflection import Reflection
from rsoccer.train.clock import Clock
from rsoccer.train.network.actor_critic import ActorCritic
from rsoccer.train.network.evaluator import Evaluator
from rsoccer.train.opponents.policy_mix import PolicyMix
from rsoccer.train.rollout.acting import Acting
from rsoccer.train.rollout.central_inputs import CentralInputs
from rsoccer.train.rollout.episode_stats import EpisodeStats, Row
from rsoccer.train.rollout.running_mean_std import RunningMeanStd, moments
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
        shield: Shield | None = None,
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
            shield: changes actions against rules; None for none.
        """
        self._settings, self._generator, self._shield = settings, generator, shield
        self._evaluator, self._model = evaluator, evaluator.model
        self._clock, self.central = clock, central
        self.obs_rms = RunningMeanStd(self._model.observation_size, reflection=reflection)
        self._acting = Acting(evaluator, self.obs_rms, generator)
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
        self.begin_again()

    def begin_again(self, seed: int | None = None) -> None:
        """Begin new episodes in all matches.

        Args:
            seed: seed of the first world; None lets the random streams of the matches go on.
        """
        matches = self.matches
        self.discounted_returns = np.zeros((matches.worlds, len(matches.agents)), np.float32)
        self.observations = matches.reset(seed)
        self._update_states()

    def collect(self, gamma: float, check_stop: Callable[[], None]) -> Rollout:
        """Play `horizon` decisions in every world.

        Args:
            gamma: discount factor per decision of `discounted_returns`.
            check_stop: called before each decision; an exception that it raises ends the rollout.

        Returns:
            The decisions of all learners in all worlds.
        """
        settings = self._settings
        robots = self.discounted_returns.size
        store = _Store(settings.horizon, robots, self._model, self.states)
        observations: list[Floats] = []
        states: list[Floats] = []
        returns: list[Floats] = []
        self.reward_means = {}
        self._acting.begin()
        for step in range(settings.horizon):
            check_stop()
            observations.append(self.observations)
            if self.states is not None:
                states.append(self.states)
            self._play_decision(store, step, gamma, returns)
        if settings.normalize_rewards:
            self._add_to(self.return_rms, returns)
        if settings.normalize_observations:
            self._add_to(self.obs_rms, observations)
            if self.central is not None:
                self.central.update(states)
        return store.rollout(self._model, float(self.return_rms.std[0]))

    def _play_decision(self, store: _Store, step: int, gamma: float, returns: list[Floats]) -> None:
        """One decision in every world; the discounted returns after it are added to `returns`."""
        actions = store.actions[step]
        with self._clock.measure("acting"):
            flat = self.observations.reshape(len(actions), -1)
            normalized = store.observations[step]
            self._acting.decide(flat, normalized, store.means[step], actions)
            if self.central is not None and self.states is not None:
                assert store.central_inputs is not None, "made for the states"
                store.central_inputs[step] = self.central.join(self.states, normalized)
        with self._clock.measure("matches"):
            shape = (*self.discounted_returns.shape, actions.shape[-1])
            transition = repeat_action(
                self.matches,
                actions.numpy().reshape(shape),
                self._settings.action_repeat,
                with_states=self.central is not None,
                shield=self._shield,
            )
            self._record(transition, gamma)
            returns.append(self.discounted_returns.copy())
            ended = transition.ended | self._draw_truncations()
            last = step == self._settings.horizon - 1
            self._record_next(store, transition, np.ones_like(ended) if last else ended)
            self.discounted_returns[ended] = 0.0
            self.observations = transition.observations
            if ended.any():
                self.observations = self.matches.reset(mask=ended)
            self._update_states()
        agents = shape[1]
        store.rewards[step] = transition.rewards.reshape(-1)
        store.terminated[step] = np.repeat(transition.terminated, agents)
        store.ended[step] = np.repeat(ended, agents)

    def _record_next(self, store: _Store, transition: Transition, needed: Mask) -> None:
        """Keep the next inputs of the value network in the worlds that need them."""
        if not needed.any():
            return
        observations = transition.observations[needed]
        inputs = self._acting.normalized(observations.reshape(-1, observations.shape[-1]))
        if self.central is not None and transition.states is not None:
            inputs = self.central.join(transition.states[needed], inputs)
        store.next_inputs.append(inputs)

    def _add_to(self, rms: RunningMeanStd, arrays: list[Floats]) -> None:
        """Add the arrays of all decisions of a rollout to their statistics."""
        size, found = len(rms.mean), dict[int, tuple[Doubles, Doubles]]()

        def measure(step: int, _: int) -> None:
            # In one order of memory, as sums depend on it: a restored array has another one.
            found[step] = moments(np.ascontiguousarray(arrays[step]).reshape(-1, size))

        jobs = [functools.partial(measure, step) for step in range(len(arrays))]
        self._evaluator.workers.run(jobs)
        for step in range(len(arrays)):
            rms.add(self.discounted_returns.size, *found[step])

    def _draw_truncations(self) -> Mask:
        """Mask (n,) of random truncations, which are treated like time limits."""
        uniform = torch.rand(len(self.discounted_returns), generator=self._generator)
        truncated: Mask = uniform.numpy() < self._settings.random_truncation
        return truncated

    def _record(self, transition: Transition, gamma: float) -> None:
        """Update the discounted returns, and the statistics of rewards and of ended episodes."""
        self.discounted_returns = self.discounted_returns * np.float32(gamma) + transition.rewards
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


class _Store:
    """Memory for the decisions of a rollout."""

    def __init__(
        self,
        horizon: int,
        robots: int,
        model: ActorCritic,
        states: Floats | None,
    ) -> None:
        """Reserve memory for a horizon and some robots."""
        shape, (action_size,) = (horizon, robots), model.log_std.shape
        self.observations = torch.empty((*shape, model.observation_size))
        self.means, self.actions = torch.empty((2, *shape, action_size))
        self.rewards = np.empty(shape, np.float32)
        self.terminated, self.ended = np.empty((2, *shape), np.bool_)
        self.central_inputs: Tensor | None = None
        if states is not None:
            size = states.shape[1] + model.observation_size
            self.central_inputs = torch.empty((*shape, size))
        self.next_inputs: list[Tensor] = []

    @torch.no_grad()
    def rollout(self, model: ActorCritic, scale: float) -> Rollout:
        """The decisions of a model, with rewards divided by a scale."""
        return Rollout(
            self.observations,
            self.actions,
            model.log_prob(self.means, self.actions),
            torch.from_numpy(self.rewards).div_(scale),
            torch.from_numpy(self.terminated),
            torch.from_numpy(self.ended),
            torch.cat(self.next_inputs),
            self.central_inputs,
        )
