import numpy as np
import pytest

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.policies.vss.drive_control import DriveTarget
from rsoccer.policies.vss.goal_areas import MARGIN, GoalAreas
from rsoccer.policies.vss.roles import ATTACKER, KEEPER, SUPPORT
from rsoccer.tasks import VssMatch
from rsoccer.view import View, Viewpoint

SMALL, LARGE = VssMatch(), VssMatch(field="vss_5v5")
AREAS = GoalAreas(SMALL.config)
FRONT, HALF_WIDTH = 0.75 - 0.15, 0.35  # of the areas at three a side, m
CENTER = (0.0, 0.0)


def seen(
    *places: tuple[float, float],
    ball: tuple[float, float] = CENTER,
    velocity: tuple[float, float] = (0.0, 0.0),
    ball_velocity: tuple[float, float] = (0.0, 0.0),
) -> View:
    """View of blue: its robots at some places, the first one with a velocity; none of yellow."""
    frame = Frame.empty(1, len(places), 0)
    frame.ball.position[0] = ball
    frame.ball.velocity[0] = ball_velocity
    frame.robots.position[0] = places
    frame.robots.velocity[0, 0] = velocity
    viewpoint = Viewpoint(len(places), 0, range(len(places)))
    view = viewpoint.new_view(1)
    viewpoint.fill(frame, view)
    return view


def targets(robots: int, x: float, y: float) -> DriveTarget:
    """The same target for all robots, to be driven through."""
    full = np.ones((1, robots), np.float32)
    return DriveTarget(full * np.float32(x), full * np.float32(y), full, 0 * full)


def way(view: View, roles: list[int], x: float, y: float) -> tuple[float, float]:
    """Target of the first robot, which wants to be at x, y."""
    found = AREAS.keep_out(view, np.array([roles]), targets(len(roles), x, y))
    return float(found.x[0, 0]), float(found.y[0, 0])


def distance_to_area(x: float, y: float) -> float:
    """Distance from both areas along x or y, m; negative inside."""
    return max(FRONT - abs(x), abs(y) - HALF_WIDTH)


@pytest.mark.parametrize("x", [-0.7, 0.7])
@pytest.mark.parametrize("role", [KEEPER, ATTACKER, SUPPORT])
def test_a_target_in_an_area_is_that_of_one_role_alone(role: int, x: float) -> None:
    allowed = role == (KEEPER if x < 0.0 else ATTACKER)
    found = way(seen((0.0, 0.1), (0.0, -0.5)), [role, SUPPORT + 1], x, 0.1)
    if allowed:
        assert found == pytest.approx((x, 0.1))
    else:
        assert distance_to_area(*found) == pytest.approx(float(MARGIN), abs=1e-6)
        assert found[1] == pytest.approx(0.1), "straight ahead of where it wants to be"


def test_a_robot_without_teammates_goes_everywhere() -> None:
    for x in (-0.7, 0.7):
        assert way(seen((0.0, 0.1)), [ATTACKER], x, 0.1) == pytest.approx((x, 0.1))


def test_the_attacker_waits_while_a_teammate_is_in_the_area() -> None:
    roles = [ATTACKER, SUPPORT]
    assert way(seen((0.5, 0.0), (0.3, 0.2)), roles, 0.7, 0.0)[0] == pytest.approx(0.7)
    assert way(seen((0.5, 0.0), (0.7, 0.2)), roles, 0.7, 0.0)[0] < FRONT
    both = seen((0.7, 0.0), (0.7, 0.2))
    assert way(both, roles, 0.72, 0.0)[0] == pytest.approx(0.72), "it was there as well"
    leaving = AREAS.keep_out(both, np.array([roles]), targets(2, 0.7, 0.2))
    assert leaving.x[0, 1] == pytest.approx(FRONT - MARGIN)


def test_a_robot_that_is_about_to_enter_brakes() -> None:
    at = (-0.5, 0.0)
    slow, fast = (
        way(seen(at, CENTER, velocity=(-v, 0.0)), [SUPPORT, KEEPER], -0.54, 0.0) for v in (0.1, 1.2)
    )
    assert slow == pytest.approx((-0.54, 0.0))
    assert fast == pytest.approx(at)


def driven(start: tuple[float, float], end: tuple[float, float], step: float = 0.01) -> Array:
    """Places on the way of a support that always moves straight to its present target."""
    places = [np.array(start)]
    for _ in range(400):
        aim = np.array(way(seen(tuple(places[-1]), (-0.65, 0.0)), [SUPPORT, KEEPER], *end))
        offset = aim - places[-1]
        if np.linalg.norm(offset) < step:
            break
        places.append(places[-1] + step * offset / np.linalg.norm(offset))
    return np.array(places)


@pytest.mark.parametrize(
    ("start", "end"),
    [
        ((-0.7, 0.5), (-0.7, -0.5)),
        ((-0.7, -0.5), (-0.7, 0.5)),
        ((0.0, -0.3), (-0.7, 0.5)),
        ((-0.7, 0.5), (0.3, -0.5)),
        ((0.0, 0.0), (-0.7, 0.0)),
    ],
)
def test_ways_lead_around_the_own_area(
    start: tuple[float, float], end: tuple[float, float]
) -> None:
    places = driven(start, end)
    assert min(distance_to_area(*place) for place in places) > MARGIN - 0.015
    if distance_to_area(*end) > MARGIN:
        assert np.linalg.norm(places[-1] - end) < 0.02


def test_a_robot_inside_leaves_by_the_nearest_line() -> None:
    for place, expected in (
        ((-0.62, 0.1), (-FRONT + MARGIN, 0.1)),
        ((-0.72, 0.33), (-0.72, HALF_WIDTH + MARGIN)),
    ):
        assert way(seen(place, CENTER), [SUPPORT, KEEPER], -0.7, 0.0) == pytest.approx(expected)


def clears(areas: GoalAreas, ball: tuple[float, float], speed: float = 0.0) -> list[bool]:
    """Mask of a keeper and an attacker that play a ball that rolls along x."""
    view = seen((-0.7, 0.0), CENTER, ball=ball, ball_velocity=(speed, 0.0))
    found = areas.clears(view, np.array([[KEEPER, ATTACKER]]))
    return [bool(robot) for robot in found[0]]


def test_the_keeper_clears_a_slow_ball_in_its_area() -> None:
    assert clears(AREAS, (-0.65, 0.3)) == [True, False]
    assert clears(AREAS, (-0.65, 0.3), speed=-1.0) == [False, False], "it stops a shot first"
    assert clears(AREAS, (-0.3, 0.3)) == [False, False]
    assert clears(AREAS, (0.65, 0.3)) == [False, False]


def test_at_five_a_side_the_smaller_area_counts() -> None:
    areas = GoalAreas(LARGE.config)
    for x, expected in ((-1.0, True), (-0.8, False)):
        assert clears(areas, (x, 0.0))[0] is expected
    wants = targets(2, -0.8, 0.3)
    found = areas.keep_out(seen(CENTER, (-1.0, 0.0)), np.array([[SUPPORT, KEEPER]]), wants)
    assert found.x[0, 0] == wants.x[0, 0]
