"""Check that robots know the sensed state, and that rewards and rules judge the true one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.senses import ModelSenses
from rsoccer.task import Play, Task
from rsoccer.testing.errors import TaskError
from rsoccer.testing.method_results import (
    DURING_EPISODES,
    RULES_BEGIN,
    Method,
    Results,
    differing,
    fields_of,
)


class _Given:
    """A sensor model whose result is given."""

    def columns(self, n: int) -> dict[str, Array]:
        """Return no columns."""
        return {}

    def begin(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        """Leave the sensed state as it is."""

    def sense(self, frame: Frame, sensed: Frame, state: Mapping[str, Array], rng: WorldRng) -> None:
        """Leave the sensed state as it is."""


def check_senses(task: Task, play: Play) -> None:
    """Check which methods read `play.sensed`, and which `play.frame`.

    Args:
        task: the task.
        play: state of n worlds, at least 2; it does not change.

    Raises:
        TaskError: a method reads the other state.
    """
    others = np.roll(np.arange(len(play.frame)), 1)
    sensing = replace(_copy(play), senses=ModelSenses.new(_Given(), play.frame, play.rng[others]))
    sensing.frame, sensing.last_frame = play.frame.take(others), play.last_frame.take(others)
    judging = replace(
        _copy(play), senses=ModelSenses.new(_Given(), play.frame.take(others), play.rng)
    )
    for method in (RULES_BEGIN, *DURING_EPISODES):
        if method.reads == "sensed":
            _compare(task, method, play, sensing, "it reads the true state; robots know")
        elif method.reads == "truth":
            _compare(task, method, play, judging, "it reads what robots sense instead of")


def _compare(task: Task, method: Method, play: Play, other: Play, fault: str) -> None:
    """Raise if a method returns something else for a state that it should not tell apart."""
    results = (_results(task, method, _copy(each)) for each in (play, other))
    if names := differing(*results):
        known = "play.sensed" if method.reads == "sensed" else "play.frame"
        listed = ", ".join(map(repr, names))
        raise TaskError(f"{method.name}: {listed}: {fault} {known} and its view")


def _results(task: Task, method: Method, play: Play) -> Results:
    """Results of a method, with the fields that it may change."""
    results = method.call(task, play)
    for field in method.updates:
        results |= fields_of(play, field)
    return results


def _copy(play: Play) -> Play:
    return play.take(np.arange(len(play.frame)))
