"""One moment of a match as plain shapes, lowest first: pure, and without any drawing library.

A scene is its ground, which never changes and so can be kept, and its play on top.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rsoccer.frame import Array, Frame, RobotColumns
from rsoccer.render import palette
from rsoccer.render.bodies import draw_ball, draw_robot, draw_trail
from rsoccer.render.pitch import draw_pitch
from rsoccer.render.scoreboard import (
    Board,
    draw_board,
    draw_caption,
    draw_score,
    scene_bounds,
)
from rsoccer.render.shapes import Color, Polygon, Pose, Shape, rectangle

if TYPE_CHECKING:
    from rsoccer._core import SimConfig


def draw_ground(config: SimConfig) -> tuple[Shape, ...]:
    """The field and the empty board: what every scene of a configuration shares."""
    at = scene_bounds(config.field)
    backdrop = Polygon(rectangle(at.left, at.bottom, at.right, at.top), palette.BACKDROP)
    return (backdrop, *draw_pitch(config.field), *draw_board(config.field))


def draw_play(config: SimConfig, row: Array, board: Board) -> tuple[Shape, ...]:
    """Robots, ball and board of one world's row (row,)."""
    frame = Frame(_checked(config, row)[None], config.n_blue, config.n_yellow)
    ball, velocity = _pair(frame.ball.position[0]), _pair(frame.ball.velocity[0])
    return (
        *draw_trail(config.ball, ball, velocity),
        *_draw_team(config, frame.blue, palette.BLUE),
        *_draw_team(config, frame.yellow, palette.YELLOW),
        *draw_ball(config.ball, ball),
        *draw_score(config.field, board),
        *draw_caption(config.field, board.caption),
    )


def _draw_team(config: SimConfig, robots: RobotColumns, color: Color) -> tuple[Shape, ...]:
    """All robots of one team in the first world."""
    poses = zip(robots.position[0], robots.heading[0], strict=True)
    return tuple(
        shape
        for number, (position, (cos, sin)) in enumerate(poses)
        for shape in draw_robot(
            config.robot, Pose(_pair(position), float(cos), float(sin)), color, number
        )
    )


def _pair(values: Array) -> tuple[float, float]:
    """Two Python floats, so that shapes compare and print plainly."""
    x, y = values.tolist()
    return x, y


def _checked(config: SimConfig, row: Array) -> Array:
    """The row as float32, or an error that says what is wrong with it."""
    row = np.ascontiguousarray(row, np.float32)
    if row.shape != (config.row_size,):
        raise ValueError(f"row: expected shape ({config.row_size},), got {row.shape}")
    if not np.isfinite(row).all():
        raise ValueError(f"row: expected finite values, got {row[~np.isfinite(row)][0]}")
    return row
