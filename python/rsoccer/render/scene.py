"""A scene: one world of a match as shapes, the lowest first, without any drawing library.

A scene has a static background, drawn once for a configuration, and a foreground that moves.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame, RobotColumns
from rsoccer.render import palette
from rsoccer.render.ball import (
    ball_shapes,
    drawn_radius,
    ring_shapes,
    shadow_shapes,
    trail_shapes,
)
from rsoccer.render.match_board import match_board_shapes
from rsoccer.render.pitch import pitch_shapes
from rsoccer.render.referee_floor import area_shapes, may_touch_shapes, referee_shapes
from rsoccer.render.robot import label_shapes, robot_outlines, robot_shapes
from rsoccer.render.scoreboard import (
    Board,
    board_shapes,
    caption_shapes,
    scene_bounds,
    score_shapes,
)
from rsoccer.render.shapes import Color, Point, Polygon, Pose, Shape, rectangle
from rsoccer.render.ticker import ticker_shapes
from rsoccer.render.words import command_words

if TYPE_CHECKING:
    from rsoccer._core import RobotModel, SimConfig

NUMBER_HEIGHT = 0.0098
"""Height of numbers on labels, as a fraction of the picture's width: 12 of 1280 pixels."""
LABELED_BELOW = 0.0095
"""Height of the number on a robot below which the robot has a label, in the same fraction."""


def background_shapes(config: SimConfig, *, referee: bool = False) -> tuple[Shape, ...]:
    """Return the field and the empty score board.

    Args:
        config: the configuration.
        referee: whether a referee leads the match: both areas are tinted, and there is a ticker.

    Returns:
        Shapes in the order of drawing.
    """
    field = config.field
    bounds = scene_bounds(field, ticker=referee)
    corners = rectangle(bounds.left, bounds.bottom, bounds.right, bounds.top)
    backdrop = Polygon(corners, palette.BACKDROP)
    areas = area_shapes(field) if referee else ()
    return (backdrop, *pitch_shapes(field), *areas, *board_shapes(field))


def foreground_shapes(
    config: SimConfig, row: Array, board: Board, extras: Sequence[Shape] = ()
) -> tuple[Shape, ...]:
    """Return robots, ball and the texts of the score board.

    Args:
        config: the configuration of the row.
        row: state of one world (row,).
        board: texts of the score board.
        extras: shapes on the floor, under robots and ball.

    Returns:
        Shapes in the order of drawing.

    Raises:
        ValueError: the row has another shape or is not finite.
    """
    frame = Frame(_checked(config, row)[None], config.n_blue, config.n_yellow)
    ball, velocity = _pair(frame.ball.position[0]), _pair(frame.ball.velocity[0])
    height = float(frame.ball.height[0])
    blue, yellow = config.robots[: config.n_blue], config.robots[config.n_blue :]
    picture_width = scene_bounds(config.field).width
    radius = drawn_radius(config.ball, picture_width)
    teams = (
        (blue, frame.blue, palette.BLUE),
        (yellow, frame.yellow, palette.YELLOW),
    )
    poses = [*_poses(frame.blue), *_poses(frame.yellow)]
    robots = tuple(shape for team in teams for shape in _team_shapes(*team, picture_width))
    labels = tuple(shape for team in teams for shape in _team_labels(*team, picture_width))
    return (
        *_floor_shapes(config, board, ball, poses),
        *extras,
        *labels,
        *trail_shapes(radius, ball, velocity),
        *ring_shapes(config.ball, ball, picture_width),
        *shadow_shapes(radius, ball, height),
        *robots,
        *ball_shapes(radius, ball, height),
        *_texts(config, board, poses),
        *caption_shapes(config.field, board.caption),
    )


def _floor_shapes(
    config: SimConfig, board: Board, ball: Point, poses: Sequence[Pose | None]
) -> tuple[Shape, ...]:
    """Marks of the referee, if there is one."""
    if board.referee is None:
        return ()
    sizes = [robot_outlines(model).size for model in config.robots]
    return (
        *referee_shapes(config.field, board.referee, ball),
        *may_touch_shapes(board.referee, poses, sizes),
    )


def _texts(config: SimConfig, board: Board, poses: Sequence[Pose | None]) -> tuple[Shape, ...]:
    """Texts of the score board, and of the ticker under a referee."""
    field, state = config.field, board.referee
    if state is None:
        return score_shapes(field, board)
    present = [pose is not None for pose in poses]
    teams = present[: config.n_blue], present[config.n_blue :]
    return (
        *match_board_shapes(field, board, state, teams),
        *ticker_shapes(field, command_words(state), board.announcement),
    )


def _team_labels(
    models: Sequence[RobotModel], robots: RobotColumns, color: Color, picture_width: float
) -> tuple[Shape, ...]:
    """Labels of the robots of a team in world 0 that are too small for a readable number."""
    return tuple(
        shape
        for number, (model, pose) in enumerate(zip(models, _poses(robots), strict=True))
        if pose is not None and not _has_number(model, picture_width)
        for shape in label_shapes(model, pose, color, number, NUMBER_HEIGHT * picture_width)
    )


def _has_number(model: RobotModel, picture_width: float) -> bool:
    """Whether a robot is large enough in the picture for a readable number on it."""
    return robot_outlines(model).number_height >= LABELED_BELOW * picture_width


def _poses(robots: RobotColumns) -> list[Pose | None]:
    """Poses of a team in world 0; None for an absent robot."""
    states = zip(robots.position[0], robots.heading[0], robots.absent[0], strict=True)
    return [
        None if absent > 0 else Pose(_pair(position), *_pair(heading))
        for position, heading, absent in states
    ]


def _team_shapes(
    models: Sequence[RobotModel], robots: RobotColumns, color: Color, picture_width: float
) -> tuple[Shape, ...]:
    """All robots of a team on the field in world 0."""
    states = zip(models, _poses(robots), robots.infrared[0], strict=True)
    return tuple(
        shape
        for number, (model, pose, infrared) in enumerate(states)
        if pose is not None
        for shape in robot_shapes(
            model,
            pose,
            color,
            number,
            has_ball=bool(infrared > 0),
            has_number=_has_number(model, picture_width),
        )
    )


def _pair(values: Array) -> tuple[float, float]:
    """Two Python floats: shapes hold no NumPy numbers."""
    x, y = values.tolist()
    return x, y


def _checked(config: SimConfig, row: Array) -> Array:
    """The row as float32; ValueError for another shape or numbers that are not finite."""
    row = np.ascontiguousarray(row, np.float32)
    if row.shape != (config.row_size,):
        raise ValueError(f"row: expected shape ({config.row_size},), got {row.shape}")
    if not np.isfinite(row).all():
        raise ValueError(f"row: expected finite values, got {row[~np.isfinite(row)][0]}")
    return row
