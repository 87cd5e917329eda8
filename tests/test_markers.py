import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.markers import Area, Gate, Segment, Target
from rsoccer.render.overlay import marker_shapes, task_overlay
from rsoccer.tasks.courses import COURSES, Course

MARKERS = {
    "SSLGoToBall-v0": {Target},
    "SSLStaticDefenders-v0": {Area},
    "SSLContestedPossession-v0": {Area},
    "SSLDribbling-v0": {Gate},
    "SSLKeepaway-v0": {Area},
    "SSLPassEndurance-v1": {Target, Segment},
    "SSLPassEnduranceMulti-v1": {Target, Segment},
}


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_markers_of_each_task_are_drawn(name: str) -> None:
    matches = Matches(name, worlds=2)
    matches.reset()
    for world in range(2):
        markers = matches.task.markers(matches.play, world)
        assert {type(marker) for marker in markers} == MARKERS.get(name, set())
        shapes = task_overlay(matches.task, matches.play, world)
        assert shapes == marker_shapes(matches.task.config.field, markers)
        assert bool(shapes) == bool(markers)


@pytest.mark.parametrize(("passed", "done"), [(0, 0), (1, 1), (2, 2), (4, 2), (6, 3), (7, 4)])
def test_gates_are_done_when_no_crossing_is_left(passed: int, done: int) -> None:
    matches = Matches("SSLDribbling-v0")
    matches.reset()
    matches.play.memory["passed"][:] = passed
    gates = matches.task.markers(matches.play, 0)
    assert len(gates) == 4
    assert sum(isinstance(gate, Gate) and gate.done for gate in gates) == done


@pytest.mark.parametrize("course", COURSES.values(), ids=COURSES.keys())
def test_the_left_post_is_on_the_left_of_the_crossing_direction(course: Course) -> None:
    scenario = next(name for name, known in COURSES.items() if known is course)
    matches = Matches(rsoccer.make_task("SSLDribbling-v0", scenario=scenario))
    matches.reset()
    first_directions: dict[tuple[float, float], float] = {}
    for low, high, direction in course.gates:
        first_directions.setdefault((low, high), direction)
    markers = matches.task.markers(matches.play, 0)
    assert len(markers) == len(first_directions)
    for gate in markers:
        assert isinstance(gate, Gate)
        along = 1 - course.crosses
        ends = sorted((gate.left[along], gate.right[along]))
        forward = np.zeros(2)
        forward[course.crosses] = first_directions[ends[0], ends[1]]
        left = np.array([-forward[1], forward[0]])
        assert np.subtract(gate.left, gate.right) @ left > 0
