"""Geometry messages."""

import math

import pytest

from rsoccer import BallModel, Field, SimConfig
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.geometry import to_field, to_geometry
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import vision_pb2


@pytest.mark.parametrize("name", ["ssl_a", "ssl_b"])
def test_fields_survive_the_wire(name: str) -> None:
    message = to_geometry(WireLayout(SimConfig(name, 1, 1)))
    sent = parse(vision_pb2.Geometry, message.SerializeToString())
    found, field = to_field(sent), Field(name)
    numbers = ("length", "width", "goal_width", "goal_depth", "goal_height", "goal_area_depth")
    more = ("goal_area_width", "center_circle_radius", "line_width", "penalty_mark_distance")
    margins = ("goal_line_margin", "touch_line_margin", "goal_wall_thickness")
    for number in (*numbers, *more, *margins):
        assert math.isclose(getattr(found, number), getattr(field, number), abs_tol=5e-4), number


def test_lines_bound_the_field() -> None:
    size = to_geometry(WireLayout(SimConfig("ssl_b", 1, 1))).field
    lines = {line.name: line for line in size.field_lines}
    assert len(lines) == 12
    assert all(vision_pb2.FieldShape.Name(line.type) == line.name for line in size.field_lines)
    top = lines["TopTouchLine"]
    assert (top.p1.x, top.p1.y, top.p2.x, top.p2.y) == (-4500, 3000, 4500, 3000)
    area = lines["LeftPenaltyStretch"]
    assert (area.p1.x, area.p1.y, area.p2.y, area.thickness) == (-3500, -1000, 1000, 10)
    (circle,) = size.field_arcs
    assert (circle.radius, circle.a1, circle.type) == (500, 0, vision_pb2.CenterCircle)
    assert math.isclose(circle.a2, 2 * math.pi, rel_tol=1e-6)


def test_the_ball_has_its_model() -> None:
    ball = BallModel("ssl_erforce")
    models = to_geometry(WireLayout(SimConfig("ssl_b", 1, 1, ball=ball))).models
    straight, chip = models.straight_two_phase, models.chip_fixed_loss
    assert straight.acc_slide == -ball.sliding_deceleration
    assert straight.acc_roll == -ball.rolling_deceleration
    assert straight.k_switch == ball.slide_to_roll_ratio
    assert chip.damping_z == ball.vertical_restitution
    assert chip.damping_xy_first_hop == ball.first_hop_factor


def test_fields_without_areas_have_no_lines_of_them() -> None:
    field = Field("ssl_b", goal_area_depth=0.0, center_circle_radius=0.0)
    size = to_geometry(WireLayout(SimConfig(field, 0, 0, ball="grsim"))).field
    assert len(size.field_lines) == 6
    assert not size.field_arcs
    assert not size.HasField("max_robot_radius")


def test_impossible_sizes_are_refused() -> None:
    message = to_geometry(WireLayout(SimConfig("ssl_b", 1, 1)))
    message.field.field_width = -5
    with pytest.raises(MessageError, match=r"^geometry: .*width") as error:
        to_field(message)
    assert error.value.code is Code.OUT_OF_RANGE
