"""A rule that decides a list of restarts, and matches with it."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer import Matches
from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.play import Play
from rsoccer.rules import Crossings, Restart, Rule
from rsoccer.tasks import VssSelfPlay
from tests.helpers import begun


class Listed(Rule):
    """Returns the results of a list, the last first; keeps the calls of `begin`."""

    def __init__(self, results: list[Any]) -> None:
        self.results = results
        self.begun: list[list[int]] = []

    def columns(self, n: int) -> dict[str, Array]:
        return {"judged": np.zeros(n, np.int64)}

    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        self.begun.append(worlds.tolist())

    def judge(self, play: Play) -> Restart | None:
        play.game.judged[:] += 1
        result: Restart | None = self.results.pop() if self.results else None
        return result


@dataclass(frozen=True)
class ListedVss(VssSelfPlay):
    """VSSS matches with a listed rule."""

    rule: Listed = field(default_factory=lambda: Listed([]))

    @property
    def rules(self) -> Sequence[Rule]:
        return Crossings(), self.rule


def vss_matches(worlds: int = 4, **settings: Any) -> tuple[Matches, list[Any]]:  # noqa: ANN401
    """VSSS matches in progress, and the list of their next restarts."""
    task = ListedVss()
    return begun(task, worlds, **settings), task.rule.results


def line_ups(*shifts: float) -> Floats:
    """VSSS state rows (k, row) with all bodies in a line, shifted along y."""
    frame = Frame.empty(len(shifts), 3, 3)
    x = np.linspace(-0.5, 0.5, 7)
    y = np.array(shifts)[:, None]
    frame.ball.position[:] = np.concatenate([np.full_like(y, x[0]), y], axis=1)
    frame.robots.position[..., 0] = x[1:]
    frame.robots.position[..., 1] = y
    return frame.rows


def balls(*positions: tuple[float, float]) -> Floats:
    """Balls at rest (k, ball column) at given positions."""
    rows = np.zeros((len(positions), Frame.empty(1, 1, 1).ball.data.shape[1]), np.float32)
    rows[:, :2] = np.reshape(positions, (-1, 2))
    return rows
