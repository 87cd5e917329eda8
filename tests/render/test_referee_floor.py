import math

import pytest

from rsoccer._core import Field
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, Stage
from rsoccer.render import palette
from rsoccer.render.referee_floor import (
    FloorMarks,
    area_outlines,
    area_shapes,
    floor_marks,
    may_touch_shapes,
    referee_shapes,
)
from rsoccer.render.shapes import Arc, Circle, Line, Polygon, Pose
from tests.render.referee import state_of

FIELD = Field("ssl_b")
BALL = (1.0, 1.0)
START = Command.NORMAL_START


@pytest.mark.parametrize("name", Field.PRESETS)
def test_areas_are_at_the_goals_of_their_teams(name: str) -> None:
    field = Field(name)
    blue, yellow = area_outlines(field)
    for outline, side in ((blue, -1), (yellow, 1)):
        depths = [field.half_length - side * x for x, _ in outline]
        assert min(depths) == pytest.approx(0.0)
        assert max(depths) == pytest.approx(field.goal_area_depth + field.area_arc_depth, rel=1e-3)
        assert max(y for _, y in outline) == field.goal_area_width / 2
    assert [shape.color[:3] for shape in area_shapes(field)] == [
        palette.BLUE[:3],
        palette.YELLOW[:3],
    ]


@pytest.mark.parametrize(
    ("changes", "marks"),
    [
        ({}, FloorMarks("disc", BLUE, BLUE)),
        ({"command": Command.DIRECT_FREE_YELLOW}, FloorMarks("disc", YELLOW, YELLOW)),
        (
            {"command": Command.STOP, "next_command": Command.DIRECT_FREE_YELLOW},
            FloorMarks("disc", NOBODY, YELLOW),
        ),
        (
            {"command": Command.HALT, "next_command": Command.DIRECT_FREE_BLUE},
            FloorMarks("", NOBODY, BLUE),
        ),
        (
            {"command": Command.PREPARE_KICKOFF_BLUE, "next_command": START},
            FloorMarks("disc", BLUE, BLUE),
        ),
        (
            {"command": START, "kick": Command.PREPARE_KICKOFF_YELLOW},
            FloorMarks("disc", YELLOW, YELLOW),
        ),
        (
            {"command": START, "kick": Command.PREPARE_PENALTY_BLUE},
            FloorMarks("", BLUE, BLUE),
        ),
        (
            {"command": Command.BALL_PLACEMENT_BLUE, "next_command": Command.DIRECT_FREE_YELLOW},
            FloorMarks("stadium", BLUE, BLUE),
        ),
        ({"in_play": True}, FloorMarks("", NOBODY, None)),
        ({"command": Command.HALT, "stage": Stage.POST_GAME}, FloorMarks("", NOBODY, None)),
        ({"ball_distance": 0.0}, FloorMarks("", BLUE, BLUE)),
        ({"ball_distance": 0.0, "command": Command.STOP}, FloorMarks("", NOBODY, NOBODY)),
    ],
)
def test_marks_by_command(changes: dict[str, object], marks: FloorMarks) -> None:
    assert floor_marks(state_of(**changes)) == marks


def test_opponents_keep_off_a_disc_around_the_ball() -> None:
    shapes = referee_shapes(FIELD, state_of(), BALL)
    [disc] = [shape for shape in shapes if isinstance(shape, Circle)]
    assert (disc.center, disc.radius) == (BALL, 0.5)
    place = [s for s in shapes if isinstance(s, Arc) and s.center == (0.3, -0.2)]
    assert len(place) == 1


def test_a_placement_keeps_the_way_of_the_ball_free() -> None:
    state = state_of(command=Command.BALL_PLACEMENT_YELLOW)
    shapes = referee_shapes(FIELD, state, BALL)
    [stadium] = [shape for shape in shapes if isinstance(shape, Polygon)]
    (x_0, y_0), (x_1, y_1) = BALL, state.designated_position
    length = math.hypot(x_1 - x_0, y_1 - y_0)
    along = ((x_1 - x_0) / length, (y_1 - y_0) / length)
    for x, y in stadium.points:
        way = (x - x_0) * along[0] + (y - y_0) * along[1]
        nearest = min(max(way, 0.0), length)
        distance = math.hypot(x - x_0 - nearest * along[0], y - y_0 - nearest * along[1])
        assert distance == pytest.approx(0.5, abs=1e-6)
    ends = {(line.start, line.end) for line in shapes if isinstance(line, Line)}
    assert (BALL, state.designated_position) in ends


def test_nothing_is_marked_while_the_ball_is_in_play() -> None:
    assert referee_shapes(FIELD, state_of(in_play=True), BALL) == ()


def test_who_may_touch_the_ball_is_marked_where_only_some_may() -> None:
    poses = [Pose((float(i), 0.0), 1.0, 0.0) if i != 1 else None for i in range(6)]
    sizes = [0.18] * 6
    kick = may_touch_shapes(state_of(), poses, sizes)
    assert [(type(shape), shape.center[0]) for shape in kick] == [(Circle, 0.0), (Circle, 2.0)]  # type: ignore[union-attr]
    stopped = state_of(command=Command.STOP, may_touch=(False,) * 6)
    assert may_touch_shapes(stopped, poses, sizes) == ()
    everyone = state_of(in_play=True, may_touch=(True,) * 6)
    assert may_touch_shapes(everyone, poses, sizes) == ()
    twice = state_of(in_play=True, may_touch=(True, True, True, False, True, True))
    [ring] = may_touch_shapes(twice, poses, sizes)
    assert isinstance(ring, Arc)
    assert (ring.center, ring.color) == ((3.0, 0.0), palette.RED_CARD)
