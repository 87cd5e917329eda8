"""Shields: they change actions of a policy that would break a rule.

A policy that has learned to play well may yet lose what it wins to fouls. A shield leaves its
actions alone but for those:

- "vsss" keeps robots of VSSS out of goal areas in which the league allows no more of their team
  (`rsoccer._core.AreaShield`), and has them stand while they may not touch the ball. It acts in
  matches under a referee alone.
- "ssl_attack" brakes the robot of the SSL attack challenges before opponents, the goal area and the
  limits of the half (`rsoccer._core.AttackShield`). It acts where no referee judges, on velocities
  in the axes of the field. Where the robot takes the ball from an opponent it is in the way.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import AreaShield, AttackShield

if TYPE_CHECKING:
    from rsoccer._core import SimConfig
    from rsoccer.arrays import Floats
    from rsoccer.policies.base import MatchState
    from rsoccer.task import Task

SHIELDS: Final = ("vsss", "ssl_attack")
"""Names of shields."""

_CORES: Final[dict[str, type[AreaShield | AttackShield]]] = {
    "vsss": AreaShield,
    "ssl_attack": AttackShield,
}


class Shield:
    """A shield by name, for the robots of any match of its league.

    `shield_error` says whether a task has its rules.

    Attributes:
        name: one of `SHIELDS`.
    """

    def __init__(self, name: str) -> None:
        """Choose the shield.

        Args:
            name: one of `SHIELDS`.

        Raises:
            ValueError: another name.
        """
        if name not in SHIELDS:
            raise ValueError(f"shield: expected one of {SHIELDS}, got {name!r}")
        self.name = name
        self._built: tuple[SimConfig, AreaShield | AttackShield] | None = None

    def apply(self, match: MatchState, actions: Floats) -> None:
        """Change actions that would be against the rules.

        Args:
            match: the match as the robots know it.
            actions: (n, robots, action) actions of its robots; changed in place.

        Raises:
            ValueError: robots with another drive than those of its league.
        """
        if ("referee" in match.game) != (self.name == "vsss"):
            return
        built = self._built
        if built is None or built[0] is not match.config:
            built = self._built = match.config, _CORES[self.name](match.config)
        changed = np.ascontiguousarray(actions, np.float32)
        built[1].apply(match.rows, match.robots.tolist(), changed, match.threads)
        if self.name == "vsss":
            changed[~match.game.may_touch[:, match.robots]] = 0.0
        if changed is not actions:
            actions[...] = changed


def shield_error(name: str, task: Task) -> str | None:
    """Return why policies of a task cannot have a shield; None if they can.

    Args:
        name: name of the shield.
        task: the task to play.
    """
    if name not in SHIELDS:
        return f"expected one of {SHIELDS}, got {name!r}"
    if name == "ssl_attack" and not getattr(task, "half_only", False):
        return f"expected an attack challenge of the SSL, got {task.name}"
    if getattr(task, "velocity_frame", "field") != "field":
        return f"expected a task with velocity_frame 'field', got 'robot' in {task.name}"
    try:
        _CORES[name](task.config)
    except ValueError as error:
        return str(error)
    return None


def check_shield(argument: str, name: str | None, task: Task) -> None:
    """Check that policies of a task can have a shield.

    Args:
        argument: name of the argument, for the error message.
        name: name of the shield; None for none, which passes.
        task: the task to play.

    Raises:
        ValueError: see `shield_error`.
    """
    error = None if name is None else shield_error(name, task)
    if error is not None:
        raise ValueError(f"{argument}: {error}")
