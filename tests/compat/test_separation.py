import numpy as np
import pytest

from rsoccer.arrays import Doubles
from rsoccer.compat.legacy_models import SSL_BALL, SSL_ROBOT, VSS_ROBOT
from rsoccer.compat.separation import MAX_OVERLAP, separate
from rsoccer.entities import headings

RADIUS = SSL_BALL.radius
FRONT = SSL_ROBOT.front_distance + RADIUS
FAR_BALL = np.array([9.0, 9.0])


def ball_beside(local: list[float], angle: float = 0.0) -> Doubles:
    """Position of the separated ball in the frame of a round robot with heading `angle`."""
    forward = headings(angle)
    turn = np.array([forward, [-forward[1], forward[0]]])
    robot = np.array([[0.3, -0.2]])
    ball, robots = separate(local @ turn + robot[0], robot, forward[None], SSL_ROBOT, RADIUS)
    assert (robots == robot).all()
    return np.asarray(turn @ (ball - robots[0]))


@pytest.mark.parametrize("angle", [0.0, 37.0, 180.0, 270.0])
@pytest.mark.parametrize("distance", [0.09, 0.095, 0.1, 0.1025, 0.1024999])
def test_a_ball_at_the_kicker_is_moved_straight_ahead(distance: float, angle: float) -> None:
    assert ball_beside([distance, 0.01], angle) == pytest.approx([FRONT, 0.01], abs=1e-9)


@pytest.mark.parametrize("local", [[0.1026, 0.0], [0.115, 0.0], [0.0, 0.112], [-0.2, 0.0]])
def test_a_free_ball_stays(local: list[float]) -> None:
    assert ball_beside(local) == pytest.approx(local, abs=1e-12)


def test_a_ball_at_a_side_is_moved_outward() -> None:
    reach = SSL_ROBOT.radius + RADIUS
    assert ball_beside([-0.06, 0.08]) == pytest.approx([-0.6 * reach, 0.8 * reach])


@pytest.mark.parametrize("local", [[0.08, 0.0], [0.0, 0.0], [-0.01, 0.085]])
def test_a_ball_whose_center_is_inside_stays(local: list[float]) -> None:
    assert ball_beside(local) == pytest.approx(local)


def test_two_round_robots_move_by_the_same_distance() -> None:
    places = np.array([[0.0, 0.0], [0.0, 0.174]])
    _, moved = separate(FAR_BALL, places, headings(np.zeros(2)), SSL_ROBOT, RADIUS)
    assert moved == pytest.approx(np.array([[0.0, -0.003], [0.0, 0.177]]))


def test_robots_that_overlap_too_much_stay() -> None:
    places = np.array([[0.0, 0.0], [0.0, 0.18 - MAX_OVERLAP - 1e-6]])
    _, moved = separate(FAR_BALL, places, headings(np.zeros(2)), SSL_ROBOT, RADIUS)
    assert (moved == places).all()


def test_squares_corner_to_corner_are_moved_apart() -> None:
    places = np.array([[0.0, 0.0], [0.1, 0.0]])
    _, moved = separate(FAR_BALL, places, headings(np.array([45.0, 45.0])), VSS_ROBOT, RADIUS)
    assert np.hypot(*(moved[1] - moved[0])) > 0.1
    assert 0.0 < np.hypot(*(moved[1] - places[1])) < MAX_OVERLAP


def test_squares_side_by_side_stay() -> None:
    places = np.array([[0.0, 0.0], [0.0, 0.0751], [0.0751, 0.0]])
    _, moved = separate(FAR_BALL, places, headings(np.array([0.0, 90.0, 180.0])), VSS_ROBOT, RADIUS)
    assert (moved == places).all()


def test_a_ball_moved_into_another_robot_is_moved_on() -> None:
    places = np.array([[0.0, 0.0], [0.1025 + 0.1115 + 0.0001, 0.02]])
    forward = headings(np.array([0.0, 90.0]))
    ball, moved = separate(np.array([0.1, -0.01]), places, forward, SSL_ROBOT, RADIUS)
    assert (moved == places).all()
    assert ball[0] == pytest.approx(FRONT, abs=2e-4)
    assert np.hypot(*(ball - places[1])) > 0.1115 - 1e-4


def test_separated_robots_stay() -> None:
    rng = np.random.default_rng(0)
    places, moves = np.array([[0.0, 0.0], [0.1, 0.0]]), 0
    for _ in range(200):
        forward = headings(rng.uniform(0.0, 360.0, 2))
        _, once = separate(FAR_BALL, places, forward, VSS_ROBOT, RADIUS)
        _, twice = separate(FAR_BALL, once, forward, VSS_ROBOT, RADIUS)
        assert once == pytest.approx(twice, abs=1e-8)
        moves += bool((once != places).any())
    assert 0 < moves < 200
