"""Effects of events between state rows: flashes and streaks of kicks, marks of dribbling."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.render import palette
from rsoccer.render.ball import drawn_radius, ring_radius
from rsoccer.render.scoreboard import scene_bounds
from rsoccer.render.shapes import Arc, Line, Point, Polygon, Pose, Shape

if TYPE_CHECKING:
    from rsoccer._core import SimConfig

KICK_GAIN = 0.8
"""Gain of the ball's speed along a robot's heading in one step that counts as a kick, m/s."""
STREAK_TIME = 0.6
"""Seconds that a streak stays behind a kicked ball."""
FLASH_TIME = 0.2
"""Seconds that the flash of a kick lasts."""
STREAK_WIDTH = 0.0042
"""Width of a streak, as a fraction of the picture's width."""
RAY_LENGTH, RAY_WIDTH = 0.016, 0.0022
"""Length and width of the rays of a flash, as fractions of the picture's width."""
RAY_ANGLES = (-1.1, -0.55, 0.55, 1.1)
"""Directions of the rays from the robot's heading, radians; the streak is between them."""
MARK_RADIUS = 1.3
"""Radius of the mark of dribbling, in radii of the ring around the ball."""
MARK_WIDTH = 0.0032
"""Width of the mark of dribbling, as a fraction of the picture's width."""
MARK_ANGLE = 1.3
"""Angle that the mark of dribbling covers on each side of the heading, radians."""
MAX_GAP = 2.5
"""Steps between two rows beyond which nothing is known of the time between them."""


@dataclass(frozen=True, slots=True)
class _Kick:
    """A kick: its time and its pose, with the ball's position as the center."""

    clock: float
    pose: Pose


class Effects:
    """Effects of a match, from its state rows in the order of time.

    Example:
        >>> import rsoccer
        >>> from rsoccer.render.effects import Effects
        >>> matches = rsoccer.Matches("SSLSelfPlay-v0")
        >>> observations = matches.reset()
        >>> effects = Effects(matches.task.config)
        >>> effects.update(matches.frame.rows[0], clock=0.0)
        ()
    """

    def __init__(self, config: SimConfig) -> None:
        """Prepare for a match that has not begun.

        Args:
            config: the configuration of the rows.
        """
        self._config = config
        self._width = scene_bounds(config.field).width
        self._mark_radius = MARK_RADIUS * max(
            ring_radius(self._width), drawn_radius(config.ball, self._width)
        )
        self._can_kick = [model.has_mouth for model in config.robots]
        self.clear()

    def clear(self) -> None:
        """Forget all rows, as before the first row of an episode."""
        self._last: Frame | None = None
        self._clock = -math.inf
        self._kick: _Kick | None = None
        self._path: list[tuple[float, Point]] = []

    def update(self, row: Array, clock: float, commands: Floats | None = None) -> tuple[Shape, ...]:
        """Return the effects to draw with a row.

        Rows that are not in sequence (an earlier time, or a gap) begin anew. The same row may
        come again.

        Args:
            row: state of one world (row,); copied.
            clock: time of the row, seconds.
            commands: (robots, command) last commands, for the marks of dribbling; None: no marks.

        Returns:
            Shapes for the `extras` of a renderer.
        """
        frame = Frame(np.array(row, np.float32)[None], self._config.n_blue, self._config.n_yellow)
        if not self._continues(frame, clock):
            self.clear()
        if clock > self._clock:
            self._find_kick(frame, clock)
            x, y = frame.ball.position[0].tolist()
            self._path.append((clock, (x, y)))
            self._path = [point for point in self._path if point[0] >= clock - STREAK_TIME]
            self._last, self._clock = frame, clock
        return (*self._streak(), *self._flash(), *self._marks(frame, commands))

    def _continues(self, frame: Frame, clock: float) -> bool:
        """Whether a frame follows the last one, or is the last one again."""
        if self._last is None or clock == self._clock:
            return self._last is not None and np.array_equal(frame.rows, self._last.rows)
        return self._clock < clock < self._clock + MAX_GAP * self._config.time_step

    def _find_kick(self, frame: Frame, clock: float) -> None:
        """Note a kick between the last frame and this one."""
        if self._last is None:
            return
        robots, last = frame.robots, self._last
        near = (last.robots.infrared[0] > 0) | (robots.touched_ball[0] > 0)
        heading = robots.heading[0]
        gain = heading @ (frame.ball.velocity[0] - last.ball.velocity[0])
        for robot in np.flatnonzero(near & (gain > KICK_GAIN) & np.array(self._can_kick, np.bool_)):
            x, y = last.ball.position[0].tolist()
            cos, sin = heading[robot].tolist()
            self._kick = _Kick(clock, Pose((x, y), cos, sin))
            self._path = [(clock - self._config.time_step, (x, y))]

    def _streak(self) -> tuple[Shape, ...]:
        """The way of the ball since the kick; older parts are fainter."""
        if self._kick is None or self._clock > self._kick.clock + STREAK_TIME:
            return ()
        half = STREAK_WIDTH * self._width / 2
        return tuple(
            Polygon(
                _band(start, end, half * self._freshness(clock), half * self._freshness(later)),
                palette.fade(palette.KICK, self._freshness(later)),
            )
            for (clock, start), (later, end) in pairwise(self._path)
        )

    def _freshness(self, clock: float) -> float:
        """1 for the present, 0 for the oldest part of a streak."""
        return max(0.0, 1.0 - (self._clock - clock) / STREAK_TIME)

    def _flash(self) -> tuple[Shape, ...]:
        """Rays in front of the robot that kicked; they grow and fade."""
        if self._kick is None or not self._clock < self._kick.clock + FLASH_TIME:
            return ()
        age = (self._clock - self._kick.clock) / FLASH_TIME
        color = palette.fade(palette.KICK, 1.0 - 0.7 * age)
        near, far = (r * RAY_LENGTH * self._width for r in (0.35 + 0.5 * age, 1.0 + 0.5 * age))
        rays = []
        for angle in RAY_ANGLES:
            cos, sin = math.cos(angle), math.sin(angle)
            start, end = self._kick.pose.to_world(
                ((near * cos, near * sin), (far * cos, far * sin))
            )
            rays.append(Line(start, end, RAY_WIDTH * self._width, color))
        return tuple(rays)

    def _marks(self, frame: Frame, commands: Floats | None) -> tuple[Shape, ...]:
        """An arc around the ball at each mouth that holds it with the dribbler on."""
        columns: Sequence[str] = self._config.command_columns
        if commands is None or "dribbler" not in columns:
            return ()
        on = commands[:, columns.index("dribbler")] > 0
        x, y = frame.ball.position[0].tolist()
        angles = [
            math.atan2(sin, cos)
            for cos, sin in frame.robots.heading[0][on & (frame.robots.infrared[0] > 0)].tolist()
        ]
        return tuple(
            Arc(
                (x, y),
                self._mark_radius,
                angle - MARK_ANGLE,
                angle + MARK_ANGLE,
                MARK_WIDTH * self._width,
                palette.DRIBBLER_LIT,
            )
            for angle in angles
        )


def _band(start: Point, end: Point, half_start: float, half_end: float) -> tuple[Point, ...]:
    """Corners of a band between two points; its ends are straight, so that bands do not overlap."""
    (x_0, y_0), (x_1, y_1) = start, end
    length = math.hypot(x_1 - x_0, y_1 - y_0) or 1.0
    x, y = (y_0 - y_1) / length, (x_1 - x_0) / length
    return (
        (x_0 + half_start * x, y_0 + half_start * y),
        (x_1 + half_end * x, y_1 + half_end * y),
        (x_1 - half_end * x, y_1 - half_end * y),
        (x_0 - half_start * x, y_0 - half_start * y),
    )
