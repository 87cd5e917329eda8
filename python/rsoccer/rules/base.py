"""Interface of the rules of a task, and the restart that a rule decides."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.checks import floats
from rsoccer.play import Play

_BALL_SIZE: Final = len(BALL_COLUMNS)


@dataclass(frozen=True, eq=False)
class Restart:
    """States from which play goes on in some worlds, as a referee restarts it.

    The episode continues: its clock, the policies, the memory of the task and the parameters of the
    worlds are kept. `last_frame` becomes equal to `frame`, so the jump is not rewarded.
    """

    worlds: NDArray[np.intp]
    """(k,) indices of worlds, each at most once, in any order."""
    balls: Floats | None = None
    """(k, ball column) new balls, with the columns of `frame.ball.data`, of which position, height,
    velocities and spin are used; the robots keep their state. None with `rows`."""
    rows: Floats | None = None
    """(k, row) new states of all bodies, as for the start of an episode. None with `balls`."""


class Rule(ABC):
    """A rule of a game, judged for n worlds at once after the physics of each step.

    A rule keeps its state of a match in columns of `play.game`, never on itself.
    """

    def columns(self, n: int) -> dict[str, Array]:
        """Create the rule's state at the start of episodes.

        Args:
            n: number of worlds.

        Returns:
            Arrays (n, ...) by name, which `play.game` then has. Default: none.
        """
        return {}

    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:  # noqa: B027  (optional)
        """Fit the rule's state to the frame from which play begins or goes on.

        Called at the start of episodes, and after the restarts of any rule. Default: nothing.

        Args:
            play: state of n worlds; the rule's columns of `play.game` may be changed in place.
            worlds: (k,) indices of the worlds in which play begins.
        """

    @abstractmethod
    def judge(self, play: Play) -> Restart | None:
        """Judge the state that the physics left.

        Args:
            play: state of n worlds. The rule changes its columns of `play.game` in place, and adds
                to `play.events`.

        Returns:
            The worlds in which play restarts, and how; None for no world.
        """


def columns(rules: Sequence[Rule], n: int) -> dict[str, Array]:
    """Return the state of all rules at the start of episodes.

    Args:
        rules: the rules of a task.
        n: number of worlds.

    Returns:
        Arrays (n, ...) by name.

    Raises:
        ValueError: a name that two rules have, or an array whose first axis is not n.
    """
    found: dict[str, Array] = {}
    for rule in rules:
        for name, array in rule.columns(n).items():
            if name in found or name == "score":
                raise ValueError(f"{type(rule).__name__}: the name {name!r} is taken")
            if np.shape(array)[:1] != (n,):
                raise ValueError(
                    f"{type(rule).__name__}: expected ({n}, ...) for {name!r}, "
                    f"got {np.shape(array)}: the first axis is worlds"
                )
            found[name] = array
    return found


def begin(rules: Sequence[Rule], play: Play, worlds: NDArray[np.intp]) -> None:
    """Fit the state of all rules to the frame from which play begins or goes on.

    Args:
        rules: the rules of the task.
        play: state of n worlds; its game may be changed in place.
        worlds: (k,) indices of the worlds in which play begins.
    """
    for rule in rules:
        rule.begin(play, worlds)


def judge(rules: Sequence[Rule], play: Play) -> list[Restart]:
    """Let all rules judge the last step.

    Args:
        rules: the rules of the task, in the order of their precedence.
        play: state of n worlds.

    Returns:
        Restarts, checked, with at most one for each world: that of the first rule that has one.

    Raises:
        TypeError: a rule returned something else, or arrays of another type.
        ValueError: worlds or numbers that do not fit.
    """
    restarts: list[Restart] = []
    taken: Mask | None = None  # worlds that have a restart
    for rule in rules:
        restart = rule.judge(play)
        if restart is None:
            continue
        restart = _checked(type(rule).__name__, restart, play)
        if taken is None:
            taken = np.zeros(len(play.frame), np.bool_)
        restart = select(restart, ~taken)
        taken[restart.worlds] = True
        restarts.append(restart)
    return restarts


def select(restart: Restart, mask: Mask) -> Restart:
    """Return the part of a restart that concerns some worlds.

    Args:
        restart: the restart.
        mask: (n,) the worlds.
    """
    kept = mask[restart.worlds]
    if kept.all():
        return restart
    balls, rows = restart.balls, restart.rows
    return Restart(
        restart.worlds[kept],
        None if balls is None else balls[kept],
        None if rows is None else rows[kept],
    )


def _checked(rule: str, restart: object, play: Play) -> Restart:
    """A restart with worlds in ascending order, after a check of all of its parts."""
    if not isinstance(restart, Restart):
        raise TypeError(f"{rule}.judge: expected a Restart or None, got {restart!r}")
    worlds = _checked_worlds(rule, restart.worlds, len(play.frame))
    order = np.argsort(worlds)
    worlds = worlds[order]
    if (worlds[1:] == worlds[:-1]).any():
        raise ValueError(f"{rule}.judge: expected each world once, got {worlds.tolist()}")
    if (restart.balls is None) == (restart.rows is None):
        raise ValueError(f"{rule}.judge: expected a Restart with either balls or rows")
    if restart.balls is not None:
        shape = (len(worlds), _BALL_SIZE)
        balls = floats(f"{rule}.judge: balls", restart.balls, shape)
        return Restart(worlds, balls=balls[order])
    shape = (len(worlds), play.frame.rows.shape[1])
    rows = floats(f"{rule}.judge: rows", restart.rows, shape)
    return Restart(worlds, rows=rows[order])


def _checked_worlds(rule: str, given: object, n: int) -> NDArray[np.intp]:
    """Indices (k,) of worlds."""
    worlds = np.asarray(given)
    if worlds.shape == (0,):
        worlds = worlds.astype(np.intp)  # an empty list becomes floats
    if worlds.ndim != 1 or worlds.dtype.kind not in "iu":
        raise TypeError(
            f"{rule}.judge: expected whole numbers (k,) for worlds, "
            f"got {worlds.dtype} {worlds.shape}"
        )
    if len(worlds) and not (worlds.min() >= 0 and worlds.max() < n):
        raise ValueError(f"{rule}.judge: expected worlds 0 to {n - 1}, got {worlds.tolist()}")
    return worlds.astype(np.intp)
