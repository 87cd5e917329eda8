"""One moment of a match as plain shapes, lowest first: pure, and without any drawing library.

A scene is its ground, which never changes and so can be kept, and its play on top.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.frame import Array, Frame, RobotColumns
from rsoccer.render import palette
from rsoccer.render.ball import draw_ball, draw_halo, draw_shadow, draw_trail
from rsoccer.render.pitch import draw_pitch
from rsoccer.render.robot import draw_robot
from rsoccer.render.scoreboard import (
    Board,
    draw_board,
    draw_caption,
    draw_score,
    scene_bounds,
)
from rsoccer.render.shapes import Color, Polygon, Pose, Shape, rectangle

if TYPE_CHECKING:
    from rsoccer._core import RobotModel, SimConfig


def draw_ground(config: SimConfig) -> tuple[Shape, ...]:
    """The field and the empty board: what every scene of a configuration shares."""
    at = scene_bounds(config.field)
    backdrop = Polygon(rectangle(at.left, at.bottom, at.right, at.top), palette.BACKDROP)
    return (backdrop, *draw_pitch(config.field), *draw_board(config.field))


def draw_play(
    config: SimConfig, row: Array, board: Board, extras: Sequence[Shape] = ()
) -> tuple[Shape, ...]:
    """Robots, ball and board of one world's row (row,); `extras` lie on the floor under them."""
    frame = Frame(_checked(config, row)[None], config.n_blue, config.n_yellow)
    ball, velocity = _pair(frame.ball.position[0]), _pair(frame.ball.velocity[0])
    height = float(frame.ball.height[0])
    blue, yellow = config.robots[: config.n_blue], config.robots[config.n_blue :]
    return (
        *extras,
        *draw_halo(config.ball, ball, scene_bounds(config.field).width),
        *draw_trail(config.ball, ball, velocity),
        *draw_shadow(config.ball, ball, height),
        *_draw_team(blue, frame.blue, palette.BLUE),
        *_draw_team(yellow, frame.yellow, palette.YELLOW),
        *draw_ball(config.ball, ball, height),
        *draw_score(config.field, board),
        *draw_caption(config.field, board.caption),
    )


def _draw_team(
    models: Sequence[RobotModel], robots: RobotColumns, color: Color
) -> tuple[Shape, ...]:
    """All robots of one team in the first world."""
    states = zip(models, robots.position[0], robots.heading[0], robots.infrared[0], strict=True)
    return tuple(
        shape
        for number, (model, position, (cos, sin), infrared) in enumerate(states)
        for shape in draw_robot(
            model,
            Pose(_pair(position), float(cos), float(sin)),
            color,
            number,
            lit=bool(infrared > 0),
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
