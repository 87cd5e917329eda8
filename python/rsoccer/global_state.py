"""The global state: a whole match as one flat vector, for centralized critics."""

from __future__ import annotations

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.arrays import Floats
from rsoccer.reflection import Reflection

LIMIT = 5.0
"""Largest magnitude of a number in a state, such as a ball at five times a robot's top speed."""


class StateEncoder:
    """An encoder of rows (n, row) as global states (n, state), scaled to about 1.

    A state has the columns below, first the ball's, then each robot's, blue first. Numbers are
    absolute and clipped to -`LIMIT` to `LIMIT`. Those of an absent robot are 0, its heading too.
    Left out are the ball's spin, last touch, crossings, touches of robots and the step count.

    | body | columns | unit |
    | --- | --- | --- |
    | ball, robot | `x`, `y` | half length of the field |
    | ball, robot | `v_x`, `v_y` | top speed of the fastest robot |
    | ball | `z`, `v_z`; only if a robot has a mouth | as `x` and `v_x` |
    | robot | `cos`, `sin` of the heading | 1 |
    | robot | `v_theta` | top angular velocity of the fastest robot |
    | robot | `infrared`; only if a robot has a mouth | 1 if the ball cuts the beam |

    The columns stand in the order of `BALL_COLUMNS` and `ROBOT_COLUMNS`.
    """

    def __init__(self, config: SimConfig) -> None:
        """Select columns and scales.

        Args:
            config: the configuration of the rows.
        """
        fastest = max(config.robots, key=lambda robot: robot.top_speed)
        top_speed, half_length = fastest.top_speed, config.field.half_length
        scales = {"x": half_length, "y": half_length, "v_x": top_speed, "v_y": top_speed}
        robot_scales = {"cos": 1.0, "sin": 1.0, "v_theta": fastest.top_angular_velocity}
        if any(robot.has_mouth for robot in config.robots):
            scales |= {"z": half_length, "v_z": top_speed}
            robot_scales["infrared"] = 1.0
        scales |= robot_scales
        columns = [*BALL_COLUMNS, *ROBOT_COLUMNS * config.n_robots]
        encoded = [(index, name) for index, name in enumerate(columns) if name in scales]
        self._columns = np.array([index for index, _ in encoded])
        self._absent = np.array([i for i, name in enumerate(columns) if name == "absent"], np.intp)
        self._per_robot = sum(name in scales for name in ROBOT_COLUMNS)
        negated = {"y", "v_y", "sin", "v_theta"}
        self._signs = [-1 if name in negated else 1 for _, name in encoded]
        self._factors = np.array([1.0 / scales[name] for _, name in encoded], np.float32)

    @property
    def size(self) -> int:
        """Number of columns in a state."""
        return len(self._columns)

    @property
    def reflection(self) -> Reflection:
        """Reflection of states, (state,), with left and right swapped."""
        return Reflection.of(self._signs)

    def encode(self, rows: Floats) -> Floats:
        """Encode rows as states.

        Args:
            rows: rows of the configuration (n, row), float32.

        Returns:
            A new array (n, state), float32, within -`LIMIT` to `LIMIT`.
        """
        states: Floats = np.clip(rows[:, self._columns] * self._factors, -LIMIT, LIMIT)
        absent = rows[:, self._absent] > 0.0
        if absent.any():
            of_robots = states[:, self.size - self._per_robot * len(self._absent) :]
            of_robots[np.repeat(absent, self._per_robot, axis=1)] = 0.0
        return states
