"""Matches behind an environment: they can be copied, and they know score and clock."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, Array
from rsoccer.matches import Matches, Outcome
from rsoccer.task import Task


class EnvMatches(Matches):
    """Matches that can be copied: a copy, or one in another process, goes on with the same."""

    def __init__(self, task: Task, worlds: int, seed: int, **settings: Any) -> None:  # noqa: ANN401
        """Prepare matches; `settings` are the others of `Matches`."""
        super().__init__(task, worlds, seed, **settings)
        self._settings = settings

    @property
    def begun(self) -> bool:
        """Whether every match has begun an episode."""
        return bool(np.count_nonzero(self._begun) == self.worlds)

    def check_turn(self) -> None:
        """RuntimeError unless every match has begun and none has ended."""
        hint = "call reset() to begin an episode"
        if not self.begun:
            raise RuntimeError(f"step before reset: {hint}")
        if np.count_nonzero(self._done):
            where = "" if self.worlds == 1 else f" in worlds {np.flatnonzero(self._done).tolist()}"
            raise RuntimeError(f"step after the end of the episode{where}: {hint}")

    def score(self, world: int = 0) -> tuple[int, int]:
        """Goals of blue and of yellow in a match: 0 to 0 until a goal ends it."""
        crossed = self.frame.ball.crossed[world]
        return int(crossed == GOAL_RIGHT), int(crossed == GOAL_LEFT)

    def clock(self, world: int = 0) -> float:
        """Seconds played of a match."""
        return float(self.play.steps[world]) * self.task.config.time_step

    def __reduce__(self) -> tuple[Any, ...]:
        """All that the future depends on."""
        return _resumed, (self.task, self.worlds, self._settings, self.state_dict())


class SingleLearner:
    """What both of Gymnasium's environments tell of who plays what."""

    _matches: EnvMatches

    @property
    def task(self) -> Task:
        """The task that is played."""
        return self._matches.task

    @property
    def learner(self) -> str:
        """The robot that learns."""
        return str(self._matches.agents[0])


def episode_info(outcome: Outcome, matches: Matches) -> dict[str, float]:
    """What there is to tell of a lone match that ended: the task's metrics, and steps."""
    told = {name: float(fact[0]) for name, fact in outcome.metrics.items()}
    return {**told, "steps": float(matches.play.steps[0])}


def _resumed(
    task: Task, worlds: int, settings: Mapping[str, Any], state: Mapping[str, Array]
) -> EnvMatches:
    matches = EnvMatches(task, worlds, 0, **settings)
    matches.load_state_dict(state)
    return matches
