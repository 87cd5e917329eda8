"""Shields: they change actions of a policy that would break a rule of the referee.

A policy that has learned without a referee may play well and yet lose what it wins to fouls. A
shield leaves its actions alone but for those: "vsss" keeps robots of VSSS out of goal areas in
which the league allows no more of their team (`rsoccer._core.AreaShield`), and has them stand
while they may not touch the ball. It acts in matches under a referee alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import AreaShield

if TYPE_CHECKING:
    from rsoccer._core import SimConfig
    from rsoccer.arrays import Floats
    from rsoccer.policies.base import MatchState

SHIELDS: Final = ("vsss",)
"""Names of shields."""


class Shield:
    """A shield by name, for the robots of any match of its league."""

    def __init__(self, name: str) -> None:
        """Choose the shield.

        Args:
            name: one of `SHIELDS`.

        Raises:
            ValueError: another name.
        """
        if name not in SHIELDS:
            raise ValueError(f"shield: expected one of {SHIELDS}, got {name!r}")
        self._built: tuple[SimConfig, AreaShield] | None = None

    def apply(self, match: MatchState, actions: Floats) -> None:
        """Change actions where the referee would be against them.

        Args:
            match: the match as the robots know it.
            actions: (n, robots, action) actions of its robots; changed in place.

        Raises:
            ValueError: robots without a differential drive.
        """
        if "referee" not in match.game:
            return
        built = self._built
        if built is None or built[0] is not match.config:
            built = self._built = match.config, AreaShield(match.config)
        changed = np.ascontiguousarray(actions, np.float32)
        built[1].apply(match.rows, match.robots.tolist(), changed, match.threads)
        changed[~match.game.may_touch[:, match.robots]] = 0.0
        if changed is not actions:
            actions[...] = changed
