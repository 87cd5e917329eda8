"""Episodes of matches as the robots in the place of learners saw them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, sensing_text
from rsoccer._core import Sensing
from rsoccer.arrays import Floats
from rsoccer.evaluate.episodes import LearnerPolicy
from rsoccer.evaluate.schedule import processors
from rsoccer.frame import team_of
from rsoccer.lineup import lineup
from rsoccer.matches import Matches
from rsoccer.policies import PolicyLike, check_policy_like, make_policy, name_of
from rsoccer.randomization import Ranges
from rsoccer.registry import as_task
from rsoccer.sources import SensingSource
from rsoccer.task import LEARN, Task
from rsoccer.view import SIDES


@dataclass(frozen=True)
class LearnerEpisode:
    """One episode of one robot, with t control steps."""

    policy: str
    """name or file of the policy that played"""
    robot: str
    """name of the robot"""
    seed: int
    """seed of the match"""
    observations: Floats
    """(t + 1, o) observations, the last one at the end of the episode"""
    actions: Floats
    """(t, action) actions in [-1, 1], one for each control step"""
    rewards: Floats
    """(t,) sums of the weighted reward terms"""
    terminated: bool
    """whether the task ended the episode; otherwise its time limit did"""
    metrics: dict[str, float]
    """metrics of the task at the end of the match, by name"""
    opponent: str = ""
    """policy of the other team; empty for the task's own"""
    sensing: str = ""
    """senses of the robots, such as "rc2021, forecast=1"; empty where they knew the true state"""
    randomization: Mapping[str, Any] = field(default_factory=dict)
    """numbers that each episode drew, by name"""

    def __len__(self) -> int:
        return len(self.actions)


def record_episodes(
    policy: PolicyLike,
    task: Task | str,
    matches: int,
    seed: int = 0,
    *,
    opponent: PolicyLike | None = None,
    worlds: int = 50,
    threads: int | None = None,
    sensing: SensingSource | None = None,
    randomization: Ranges | None = None,
) -> list[LearnerEpisode]:
    """Play matches with a policy in the place of the learners, and keep what they saw and did.

    Actions are those that the robots carried out: a policy that repeats its actions has equal ones
    in a row. In tasks in which both teams learn the policy plays for blue.

    Args:
        policy: a policy, its name, its file or "module:name".
        task: the task or its name.
        matches: number of matches, at least 1. Each has an episode for each robot of the policy.
        seed: match i has the seed `seed + i`, as in `Matches`.
        opponent: policy of the other team; None for the task's own, and `ou` for learners.
        worlds: matches played at once, at least 1.
        threads: threads of the simulator; by default one per available processor.
        sensing: what robots know of the true state, as for `Matches`.
        randomization: numbers that each episode draws, as for `Matches`.

    Returns:
        The episodes, match by match.

    Raises:
        TypeError: an argument of the wrong type.
        ValueError: a number out of range, a policy that does not fit the task, or a discrete task.
    """
    check_policy_like("policy", policy)
    task = as_task(task)
    check_continuous(task)
    matches = checks.integer("matches", matches, 1)
    seed = checks.integer("seed", seed, 0)
    worlds = checks.integer("worlds", worlds, 1)
    own = make_policy(policy, task)
    other = None if opponent is None else make_policy(opponent, task)
    controllers = lineup(task, LEARN, other, SIDES[0] if task.two_sided else None)
    episodes: list[LearnerEpisode] = []
    for first in range(seed, seed + matches, worlds):
        world = Matches(
            task,
            min(worlds, seed + matches - first),
            first,
            processors() if threads is None else threads,
            controllers=controllers,
            autoreset="disabled",
            sensing=sensing,
            forecasting=own,
            randomization=randomization,
        )
        recorded = _Recorded.of(world, LearnerPolicy(own, world, first))
        against = "" if opponent is None else name_of(opponent)
        episodes += [
            replace(
                episode,
                opponent=against,
                sensing=_senses(world),
                randomization=world.randomization,
            )
            for episode in recorded.episodes(name_of(policy), world, first)
        ]
    return episodes


def check_continuous(task: Task) -> None:
    """Refuse a discrete task: episodes have the rows of its table as actions, and no indices.

    Args:
        task: the task.

    Raises:
        ValueError: it is discrete.
    """
    if task.action_table is not None:
        raise ValueError(f"task: expected continuous actions, got {task.name} with discrete ones")


def _senses(matches: Matches) -> str:
    """Senses of the learners in words, with the forecast that their policy needs."""
    sensing = matches.sensing
    if sensing is None:
        return ""
    if isinstance(sensing, Sensing):
        forecasts = set(matches.forecasting) & {team_of(agent) for agent in matches.agents}
        return sensing_text.describe(
            sensing_text.with_number(sensing, "forecast", 1.0) if forecasts else sensing
        )
    return sensing if isinstance(sensing, str) else type(sensing).__name__


@dataclass(frozen=True)
class _Recorded:
    """All steps of n matches with their k learners, until the last match has ended."""

    observations: list[Floats]
    """(n, k, o) before each step, and after the last one"""
    actions: list[Floats]
    """(n, k, action)"""
    rewards: list[Floats]
    """(n, k)"""
    lengths: NDArray[np.int64]
    """(n,) number of steps"""
    terminated: NDArray[np.bool_]
    """(n,)"""
    metrics: dict[str, Floats]
    """(n,) by name"""

    @classmethod
    def of(cls, matches: Matches, policy: LearnerPolicy) -> _Recorded:
        """Play matches that have not begun to their ends."""
        n = matches.worlds
        made = cls([matches.reset()], [], [], np.zeros(n, np.int64), np.zeros(n, np.bool_), {})
        while not matches.done.all():
            playing = ~matches.done
            actions = np.clip(policy.act(made.observations[-1]), -1.0, 1.0).astype(np.float32)
            outcome = matches.step(actions)
            made.observations.append(outcome.observations)
            made.actions.append(actions)
            made.rewards.append(outcome.rewards)
            made.lengths[playing] += 1
            made.terminated[:] |= outcome.terminated & playing
            ending = outcome.ended & playing
            for name, values in outcome.metrics.items():
                made.metrics.setdefault(name, np.zeros(n, np.float32))[ending] = values[ending]
        return made

    def episodes(self, policy: str, matches: Matches, seed: int) -> list[LearnerEpisode]:
        """Episodes of each match and each learner."""
        observations, actions, rewards = map(
            np.stack, (self.observations, self.actions, self.rewards)
        )
        return [
            LearnerEpisode(
                policy=policy,
                robot=robot,
                seed=seed + world,
                observations=observations[: length + 1, world, index].copy(),
                actions=actions[:length, world, index].copy(),
                rewards=rewards[:length, world, index].copy(),
                terminated=bool(self.terminated[world]),
                metrics={name: float(values[world]) for name, values in self.metrics.items()},
            )
            for world, length in enumerate(self.lengths.tolist())
            for index, robot in enumerate(matches.agents)
        ]
