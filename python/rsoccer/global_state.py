"""The whole game as one flat vector, for critics that may see everything."""

from __future__ import annotations

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.frame import Floats

LIMIT = 5.0
"""Largest magnitude shown: a ball at five times a robot's top speed."""


class StateEncoder:
    """Turns rows (n, row) into states (n, state): absolute, scaled to about 1, clipped to LIMIT.

    Positions by the field's half length, velocities by a robot's top speed, turn rates by that of
    a robot spinning at top speed. What the ball crossed is left out: it is an event and not a
    place, and it ends the episode.
    """

    def __init__(self, config: SimConfig) -> None:
        """Find by name the columns to show."""
        fastest = max(config.robots, key=lambda robot: robot.top_speed)
        top_speed, half_length = fastest.top_speed, config.field.half_length
        scales = {"x": half_length, "y": half_length, "v_x": top_speed, "v_y": top_speed}
        turns = {"cos": 1.0, "sin": 1.0, "v_theta": fastest.top_turn_rate}
        if any(robot.has_mouth for robot in config.robots):
            scales |= {"z": half_length, "v_z": top_speed}
            turns["infrared"] = 1.0
        columns = [*BALL_COLUMNS, *ROBOT_COLUMNS * config.n_robots]
        shown = [(place, name) for place, name in enumerate(columns) if name in scales | turns]
        self._columns = np.array([place for place, _ in shown])
        self._factors = np.array([1.0 / (scales | turns)[name] for _, name in shown], np.float32)

    @property
    def size(self) -> int:
        """Numbers in a state."""
        return len(self._columns)

    def states(self, rows: Floats) -> Floats:
        """A new array (n, state): ball, then blue robots, then yellow ones."""
        states: Floats = np.clip(rows[:, self._columns] * self._factors, -LIMIT, LIMIT)
        return states
