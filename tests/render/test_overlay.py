import math
import subprocess
import sys

import pytest

from rsoccer._core import Field
from rsoccer.render import palette
from rsoccer.render.overlay import draw_area, draw_gate, draw_segment, draw_target
from rsoccer.render.shapes import Arc, Bounds, Circle, Line, Point, Polygon, Shape

FIELD = Field("ssl_challenge")


def tip(gate: tuple[Shape, ...]) -> Point:
    (head,) = (shape for shape in gate if isinstance(shape, Polygon))
    return head.points[0]


@pytest.mark.parametrize("angle", [0.0, 0.7, 2.0, 3.14, -1.6])
def test_the_arrow_of_a_gate_leads_through_it_with_left_on_the_left(angle: float) -> None:
    cos, sin = math.cos(angle), math.sin(angle)
    left, right = (1.0 - 0.3 * sin, 2.0 + 0.3 * cos), (1.0 + 0.3 * sin, 2.0 - 0.3 * cos)
    x, y = tip(draw_gate(FIELD, left, right))
    way = math.hypot(x - 1.0, y - 2.0)
    assert way > 0.1
    assert ((x - 1.0) / way, (y - 2.0) / way) == pytest.approx((cos, sin))


def test_a_gate_has_its_posts_where_it_is_told_and_a_line_between_them() -> None:
    left, right = (-0.5, 0.0), (-1.0, 0.0)
    gate = draw_gate(FIELD, left, right)
    assert {s.center for s in gate if isinstance(s, Circle)} == {left, right}
    assert {left, right} in [{s.start, s.end} for s in gate if isinstance(s, Line)]


def test_a_gate_shows_whether_it_is_done() -> None:
    pending, done = (draw_gate(FIELD, (0, 1), (0, 0), done=done) for done in (False, True))
    assert {s.color[:3] for s in pending} == {palette.PENDING[:3]}
    assert {s.color[:3] for s in done} == {palette.DONE[:3]}


def test_posts_in_one_place_make_no_error() -> None:
    assert draw_gate(FIELD, (1.0, 1.0), (1.0, 1.0))


def test_a_target_is_a_ring_of_its_radius() -> None:
    shapes = draw_target(FIELD, (1.0, 2.0), 0.25, palette.DONE)
    assert [(s.center, s.radius, s.color) for s in shapes if isinstance(s, Arc)] == [
        ((1.0, 2.0), 0.25, palette.DONE)
    ]


def test_what_lies_under_an_area_stays_visible() -> None:
    shapes = draw_area(FIELD, Bounds(-1.0, -2.0, 1.0, 2.0), palette.BLUE)
    (surface,) = (shape for shape in shapes if isinstance(shape, Polygon))
    assert {*surface.points} == {(-1.0, -2.0), (1.0, -2.0), (1.0, 2.0), (-1.0, 2.0)}
    assert 0 < surface.color[3] < 100
    assert sum(isinstance(shape, Line) for shape in shapes) == 4


def test_a_segment_goes_from_one_place_to_the_other() -> None:
    (line,) = (s for s in draw_segment(FIELD, (0.0, 1.0), (2.0, 3.0)) if isinstance(s, Line))
    assert (line.start, line.end, line.color) == ((0.0, 1.0), (2.0, 3.0), palette.PENDING)


@pytest.mark.parametrize("name", Field.PRESETS)
def test_strokes_suit_the_size_of_the_field(name: str) -> None:
    field = Field(name)
    for shape in draw_segment(field, (0.0, 0.0), (1.0, 0.0)):
        if isinstance(shape, Line):
            assert 0.001 < shape.width / field.length < 0.005


def test_an_overlay_needs_no_drawing_library() -> None:
    code = "import sys, rsoccer.render.overlay; sys.exit('pygame' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
