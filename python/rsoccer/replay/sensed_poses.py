"""Poses of ball and robots as the robots know them, and their columns in a replay file.

A pose is a position and a heading: what a picture needs beside the true state.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Self

import numpy as np

from rsoccer.replay.quantized import TURN

if TYPE_CHECKING:
    from rsoccer._core import SimConfig
    from rsoccer.arrays import Doubles, Floats
    from rsoccer.frame import Frame

POSITION_STEP: Final = 1e-3
"""Step of positions, m: a fraction of what cameras err by."""
HEADING_STEP: Final = TURN / 2**12
"""Step of headings, rad."""


@dataclass(frozen=True, eq=False)
class SensedPoses:
    """Positions and headings as the robots knew them, in f frames."""

    ball: Floats
    """(f, 2) position of the ball, m"""
    robots: Floats
    """(f, robots, 2) positions of all robots, m"""
    headings: Floats
    """(f, robots, 2) cosines and sines of their headings"""

    @classmethod
    def of_frame(cls, frame: Frame) -> Self:
        """Return the poses in states as the robots know them.

        Args:
            frame: (f, ...) states.
        """
        robots = frame.robots
        return cls(frame.ball.position, robots.position, robots.heading)

    @classmethod
    def of_columns(cls, columns: Doubles) -> Self:
        """Return poses from the columns of a file.

        Args:
            columns: (f, column) numbers.
        """
        robots = columns[:, 2:].reshape(len(columns), -1, 3)
        angles = robots[..., 2]
        headings = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        parts = (columns[:, :2], robots[..., :2], headings)
        return cls(*(part.astype(np.float32) for part in parts))

    def columns(self) -> Doubles:
        """Return the columns of a file, with headings as angles without jumps.

        Returns:
            (f, column) numbers.
        """
        cos, sin = np.moveaxis(self.headings.astype(np.float64), -1, 0)
        angles = np.unwrap(np.arctan2(sin, cos), axis=0)
        robots = np.concatenate([self.robots, angles[..., None]], axis=-1, dtype=np.float64)
        return np.concatenate([self.ball, robots.reshape(len(robots), -1)], axis=1)


def names(config: SimConfig) -> tuple[str, ...]:
    """Return the names of all columns.

    Args:
        config: the configuration.
    """
    robots = range(config.n_robots)
    return (
        *("ball_x", "ball_y"),
        *(f"{name}_{robot}" for robot in robots for name in ("x", "y", "heading")),
    )


def steps(config: SimConfig) -> list[float]:
    """Return the steps of all columns.

    Args:
        config: the configuration.
    """
    return [HEADING_STEP if "heading" in name else POSITION_STEP for name in names(config)]
