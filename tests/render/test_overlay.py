import math
import subprocess
import sys

import pytest

from rsoccer._core import Field
from rsoccer.render import palette
from rsoccer.render.overlay import area_shapes, gate_shapes, segment_shapes, target_shapes
from rsoccer.render.shapes import Arc, Bounds, Circle, Line, Point, Polygon, Shape

FIELD = Field("ssl_challenge")


def tip(gate: tuple[Shape, ...]) -> Point:
    (head,) = (shape for shape in gate if isinstance(shape, Polygon))
    return head.points[0]


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, 3.14, -1.6])
def test_the_arrow_of_a_gate_leads_through_it_with_left_on_the_left(angle: float) -> None:
    cos, sin = math.cos(angle), math.sin(angle)
    left, right = (1.0 - 0.3 * sin, 2.0 + 0.3 * cos), (1.0 + 0.3 * sin, 2.0 - 0.3 * cos)
    x, y = tip(gate_shapes(FIELD, left, right))
    distance = math.hypot(x - 1.0, y - 2.0)
    assert distance > 0.1
    assert ((x - 1.0) / distance, (y - 2.0) / distance) == pytest.approx((cos, sin))


def test_a_gate_has_two_posts_and_a_line_between_them() -> None:
    left, right = (-0.5, 0.0), (-1.0, 0.0)
    gate = gate_shapes(FIELD, left, right)
    assert {s.center for s in gate if isinstance(s, Circle)} == {left, right}
    assert {left, right} in [{s.start, s.end} for s in gate if isinstance(s, Line)]


def test_the_color_of_a_gate_shows_its_state() -> None:
    pending, done = (gate_shapes(FIELD, (0, 1), (0, 0), done=done) for done in (False, True))
    assert {s.color[:3] for s in pending} == {palette.PENDING[:3]}
    assert {s.color[:3] for s in done} == {palette.DONE[:3]}


def test_posts_at_the_same_place_raise_no_error() -> None:
    assert gate_shapes(FIELD, (1.0, 1.0), (1.0, 1.0))


def test_a_target_is_a_ring_of_its_radius() -> None:
    shapes = target_shapes(FIELD, (1.0, 2.0), 0.25, palette.DONE)
    assert [(s.center, s.radius, s.color) for s in shapes if isinstance(s, Arc)] == [
        ((1.0, 2.0), 0.25, palette.DONE)
    ]


def test_an_area_is_translucent() -> None:
    shapes = area_shapes(FIELD, Bounds(-1.0, -2.0, 1.0, 2.0), palette.BLUE)
    (surface,) = (shape for shape in shapes if isinstance(shape, Polygon))
    assert {*surface.points} == {(-1.0, -2.0), (1.0, -2.0), (1.0, 2.0), (-1.0, 2.0)}
    assert 0 < surface.color[3] < 100
    assert sum(isinstance(shape, Line) for shape in shapes) == 4


def test_a_segment_goes_from_one_place_to_the_other() -> None:
    (line,) = (s for s in segment_shapes(FIELD, (0.0, 1.0), (2.0, 3.0)) if isinstance(s, Line))
    assert (line.start, line.end, line.color) == ((0.0, 1.0), (2.0, 3.0), palette.PENDING)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_strokes_suit_the_size_of_the_field(name: str) -> None:
    field = Field(name)
    for shape in segment_shapes(field, (0.0, 0.0), (1.0, 0.0)):
        if isinstance(shape, Line):
            assert 0.001 < shape.width / field.length < 0.005


def test_an_overlay_needs_no_drawing_library() -> None:
    code = "import sys, rsoccer.render.overlay; sys.exit('pygame' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
