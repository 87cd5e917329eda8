"""Pauses between the kicks of a robot whose simulator kicks with every packet."""

from __future__ import annotations

import math

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats
from rsoccer.protocols.commands import CommandRow, motion


class KickPauses:
    """Times of the robots' last kicks.

    Commands are sent again with each frame, so a kick that lasts for a control step would go out
    once or twice. A kick that is left out is not made up for.
    """

    def __init__(self, config: SimConfig, seconds: float) -> None:
        """Begin without kicks.

        Args:
            config: the match.
            seconds: least time between two kicks of a robot, s; 0 for none.
        """
        self._config, self._seconds = config, seconds
        self._kicked = [-math.inf] * config.n_robots

    def applied(self, now: float, commands: Floats) -> Floats:
        """Return commands without the kicks that come too early, and note the others.

        Args:
            now: present time on the wall, s.
            commands: (robots, command) commands, finite.

        Returns:
            (robots, command) the commands themselves if all kicks are kept.
        """
        if self._seconds <= 0.0:
            return commands
        kept = commands
        for slot, model in enumerate(self._config.robots):
            if not any(motion(model, commands[slot]).kick):
                continue
            if now - self._kicked[slot] >= self._seconds:
                self._kicked[slot] = now
                continue
            if kept is commands:
                kept = np.array(commands, np.float32)
            CommandRow(model, kept[slot]).kick(0.0, 0.0)
        return kept
