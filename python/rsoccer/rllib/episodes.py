"""Rollouts as arrays, cut into RLlib's episodes."""

from __future__ import annotations

import time
import uuid
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from ray.rllib.core.columns import Columns
from ray.rllib.env.multi_agent_episode import MultiAgentEpisode
from ray.rllib.env.single_agent_episode import SingleAgentEpisode
from ray.rllib.env.utils.infinite_lookback_buffer import InfiniteLookbackBuffer

from rsoccer.arrays import Array, Floats
from rsoccer.matches import Outcome

EpisodeSlice = tuple[int, int, int]
"""World, first step and end of a part of an episode within a rollout."""


@dataclass
class Running:
    """An episode in progress: its identity, which all of its parts share."""

    modules: dict[str, str]
    """RLModule of each agent."""
    id_: str = field(default_factory=lambda: uuid.uuid4().hex)
    """Identity of the episode in RLlib."""
    steps: int = 0
    """Steps in the parts that were returned."""
    began: float = field(default_factory=time.perf_counter)
    """Clock at its first step, s."""


@dataclass
class Part:
    """A part of an episode within one rollout, steps `first` to `end - 1` of a world."""

    episode: Running
    """The episode that it belongs to."""
    world: int
    """Index of its world."""
    first: int
    """First step in the rollout."""
    end: int
    """Step after the last one."""
    final_observations: Floats | None = None
    """(agents, o) last observations, if the episode ended."""
    terminated: bool = False
    """The task ended the episode. An episode that ended otherwise is truncated."""
    info: dict[str, float] = field(default_factory=dict)
    """Metrics of the task at the end."""


class Rollout:
    """Results of consecutive steps of n worlds.

    Attributes:
        observations: (n, agents, o) current observations.
    """

    def __init__(
        self, observations: Floats, agents: Sequence[str], spaces: Mapping[str, Any]
    ) -> None:
        """Begin a rollout.

        Args:
            observations: (n, agents, o) first observations.
            agents: names of the agents.
            spaces: `observation_space` and `action_space` of one agent.
        """
        self.observations = observations
        self._agents, self._spaces = agents, spaces
        self._observations: list[Floats] = [observations]
        self._rewards: list[Floats] = []
        self._columns: list[dict[str, Array]] = []
        self._parts: list[Part] = []
        self._first = np.zeros(len(observations), np.intp)

    def __len__(self) -> int:
        """Return the number of steps."""
        return len(self._rewards)

    def add(self, columns: dict[str, Array], outcome: Outcome) -> None:
        """Record a step.

        Args:
            columns: (n, agents, ...) actions and other outputs of the modules, by RLlib's names.
            outcome: results of the step.
        """
        self.observations = outcome.observations
        self._observations.append(outcome.observations)
        self._rewards.append(outcome.rewards)
        self._columns.append(columns)

    def end(self, world: int, episode: Running, outcome: Outcome, info: dict[str, float]) -> None:
        """Cut an episode that ended in the last step.

        Args:
            world: its world.
            episode: the episode.
            outcome: results of the last step.
            info: metrics of the task.
        """
        self._parts.append(
            Part(
                episode,
                world,
                int(self._first[world]),
                len(self),
                outcome.final_observations[world],
                bool(outcome.terminated[world]),
                info,
            )
        )
        self._first[world] = len(self)

    def episodes(
        self,
        running: Sequence[Running],
        frozen: frozenset[str],
        mapping: Any,  # noqa: ANN401
    ) -> Iterator[tuple[Part, Any]]:
        """Yield all parts of episodes: those that ended in order of their ends, then the others.

        Args:
            running: (n,) episodes in progress, whose `steps` are raised.
            frozen: modules whose agents are left out.
            mapping: RLlib's `policy_mapping_fn`.

        Yields:
            A part and its `MultiAgentEpisode`, in NumPy's form.
        """
        self._parts += [
            Part(episode, world, int(self._first[world]), len(self))
            for world, episode in enumerate(running)
            if self._first[world] < len(self)
        ]
        if not self._parts:
            return
        observations = np.stack(self._observations, axis=2)
        rewards = np.stack(self._rewards, axis=2)
        columns = {
            name: np.stack([step[name] for step in self._columns], axis=2)
            for name in self._columns[0]
        }
        for part in self._parts:
            yield part, self._episode(part, observations, rewards, columns, frozen, mapping)

    def _episode(
        self,
        part: Part,
        observations: Floats,
        rewards: Floats,
        columns: Mapping[str, Array],
        frozen: frozenset[str],
        mapping: Any,  # noqa: ANN401
    ) -> Any:  # noqa: ANN401
        """One part as a `MultiAgentEpisode`; arrays are (n, agents, steps, ...)."""
        running, world = part.episode, part.world
        length, started = part.end - part.first, running.steps
        ended = part.final_observations is not None
        running.steps += length
        whole = MultiAgentEpisode(
            id_=running.id_,
            env_t_started=started,
            agent_t_started=dict.fromkeys(self._agents, started),
            agent_module_ids=dict(running.modules),
            agent_to_module_mapping_fn=mapping,
            len_lookback_buffer=0,
            **{key: dict.fromkeys(self._agents, space) for key, space in self._spaces.items()},
        )
        whole.env_t = started + length
        whole.is_terminated, whole.is_truncated = part.terminated, ended and not part.terminated
        infos: list[dict[str, float]] = [{}] * length + [part.info]
        steps = slice(part.first, part.end)
        for index, (agent, module) in enumerate(running.modules.items()):
            if module in frozen:
                continue
            observed = observations[world, index, part.first : part.end + 1]
            if part.final_observations is not None:
                observed = observed.copy()
                observed[-1] = part.final_observations[index]
            outputs = {name: values[world, index, steps] for name, values in columns.items()}
            whole.agent_episodes[agent] = SingleAgentEpisode(
                id_=f"{running.id_}_{agent}",
                agent_id=agent,
                module_id=module,
                multi_agent_episode_id=running.id_,
                observations=observed,
                infos=list(infos),
                actions=outputs.pop(Columns.ACTIONS),
                rewards=rewards[world, index, steps],
                terminated=whole.is_terminated,
                truncated=whole.is_truncated,
                extra_model_outputs=outputs,
                t_started=started,
                len_lookback_buffer=0,
                **self._spaces,
            )
            ages = list(range(started, started + length + 1))
            whole.env_t_to_agent_t[agent] = InfiniteLookbackBuffer(ages)
        return whole
