"""Geometry messages: the field, its lines, cameras and the model of the ball."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Final

from rsoccer._core import BallModel, Field
from rsoccer.protocols.cameras import Camera
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import MILLIMETERS, WireLayout
from rsoccer.protocols.schemas import vision_pb2

FIELDS: Final = ("ssl_a", "ssl_b")
"""Presets among which the field of a message is recognized."""
SUBSTITUTION_WIDTH: Final = 0.3
"""Width of the area for substitutions behind a goal line, m (SSL rules 4300196, "Field")."""


def to_geometry(layout: WireLayout, cameras: Sequence[Camera] = ()) -> vision_pb2.Geometry:
    """Return the geometry of a match.

    Args:
        layout: the match. The field is symmetric, so sides make no difference.
        cameras: cameras whose calibrations to include.

    Returns:
        The message, mm.
    """
    field, ball = layout.config.field, layout.config.ball
    message = vision_pb2.Geometry(field=_field_size(field, ball))
    radii = [robot.bounding_radius for robot in layout.config.robots]
    if radii:
        message.field.max_robot_radius = MILLIMETERS * max(radii)
    for name, (x_1, y_1, x_2, y_2) in _lines(field):
        line = message.field.field_lines.add(name=name, thickness=MILLIMETERS * field.line_width)
        line.type = getattr(vision_pb2, name)
        line.p1.x, line.p1.y, line.p2.x, line.p2.y = (
            MILLIMETERS * value for value in (x_1, y_1, x_2, y_2)
        )
    if field.center_circle_radius > 0:
        _add_circle(message.field, field)
    message.calib.extend(camera.calibration() for camera in cameras)
    message.models.CopyFrom(_ball_models(ball))
    return message


def to_field(message: vision_pb2.Geometry) -> Field:
    """Return the field of a geometry.

    Args:
        message: the message.

    Returns:
        The preset of the nearest size, with the sizes of the message. What they leave open, such as
        the walls of the goals, is the preset's.

    Raises:
        MessageError: sizes that no field can have.
    """
    size = message.field
    length = size.field_length / MILLIMETERS
    name = min(FIELDS, key=lambda preset: abs(Field(preset).length - length))
    numbers = {
        "length": size.field_length,
        "width": size.field_width,
        "goal_width": size.goal_width,
        "goal_depth": size.goal_depth,
        "touch_line_margin": size.boundary_width,
        "goal_line_margin": size.boundary_width,
    }
    optional = {
        "goal_line_margin": "boundary_width_goal_line",
        "goal_height": "goal_height",
        "goal_area_depth": "penalty_area_depth",
        "goal_area_width": "penalty_area_width",
        "center_circle_radius": "center_circle_radius",
        "line_width": "line_thickness",
    }
    for number, source in optional.items():
        if size.HasField(source):
            numbers[number] = getattr(size, source)
    if size.HasField("goal_center_to_penalty_mark"):
        numbers["penalty_mark_distance"] = size.goal_center_to_penalty_mark
    try:
        return Field(name, **{key: value / MILLIMETERS for key, value in numbers.items()})
    except ValueError as error:
        raise MessageError(Code.OUT_OF_RANGE, f"geometry: {error}") from None


def _field_size(field: Field, ball: BallModel) -> vision_pb2.FieldSize:
    def mm(meters: float) -> int:
        return round(MILLIMETERS * meters)

    return vision_pb2.FieldSize(
        field_length=mm(field.length),
        field_width=mm(field.width),
        goal_width=mm(field.goal_width),
        goal_depth=mm(field.goal_depth),
        boundary_width=mm(field.touch_line_margin),
        boundary_width_goal_line=mm(field.goal_line_margin),
        penalty_area_depth=mm(field.goal_area_depth),
        penalty_area_width=mm(field.goal_area_width),
        center_circle_radius=mm(field.center_circle_radius),
        line_thickness=mm(field.line_width),
        goal_center_to_penalty_mark=mm(field.penalty_mark_distance),
        goal_height=mm(field.goal_height),
        goal_substitution_area_width=mm(min(SUBSTITUTION_WIDTH, field.goal_line_margin)),
        ball_radius=MILLIMETERS * ball.radius,
    )


def _lines(field: Field) -> Iterator[tuple[str, tuple[float, float, float, float]]]:
    """Names and ends x, y, x, y of the lines, m. Their names are those of their types."""
    x, y = field.half_length, field.half_width
    yield "TopTouchLine", (-x, y, x, y)
    yield "BottomTouchLine", (-x, -y, x, -y)
    yield "LeftGoalLine", (-x, -y, -x, y)
    yield "RightGoalLine", (x, -y, x, y)
    yield "HalfwayLine", (0.0, -y, 0.0, y)
    yield "CenterLine", (-x, 0.0, x, 0.0)
    depth, side = field.goal_area_depth, field.goal_area_width / 2
    if depth > 0:
        yield "LeftPenaltyStretch", (depth - x, -side, depth - x, side)
        yield "RightPenaltyStretch", (x - depth, -side, x - depth, side)
        # Left and right of an area are those of a keeper who looks at the center.
        yield "LeftFieldLeftPenaltyStretch", (-x, side, depth - x, side)
        yield "LeftFieldRightPenaltyStretch", (-x, -side, depth - x, -side)
        yield "RightFieldLeftPenaltyStretch", (x, -side, x - depth, -side)
        yield "RightFieldRightPenaltyStretch", (x, side, x - depth, side)


def _add_circle(size: vision_pb2.FieldSize, field: Field) -> None:
    arc = size.field_arcs.add(
        name="CenterCircle",
        radius=MILLIMETERS * field.center_circle_radius,
        a1=0.0,
        a2=2 * math.pi,
        thickness=MILLIMETERS * field.line_width,
        type=vision_pb2.CenterCircle,
    )
    arc.center.x = arc.center.y = 0.0


def _ball_models(ball: BallModel) -> vision_pb2.BallModels:
    return vision_pb2.BallModels(
        straight_two_phase=vision_pb2.StraightTwoPhase(
            acc_slide=-ball.sliding_deceleration,
            acc_roll=-ball.rolling_deceleration,
            k_switch=ball.slide_to_roll_ratio,
        ),
        chip_fixed_loss=vision_pb2.ChipFixedLoss(
            damping_xy_first_hop=ball.first_hop_factor,
            damping_xy_other_hops=ball.later_hop_factor,
            damping_z=ball.vertical_restitution,
        ),
    )
