"""Bodies that are put somewhere."""

import numpy as np
import pytest

from rsoccer import Simulator
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.placing import Placement
from tests.protocols.matches import SIDES, SSL, layout, state


@pytest.mark.parametrize("positive", SIDES)
def test_bodies_go_where_the_wire_says(positive: bool) -> None:
    sign = -1.0 if positive else 1.0
    frame = state()
    placement = Placement(layout(positive=positive), frame, 1)
    placement.put_ball((0.5, -0.25, 0.125), (1.0, 2.0, 3.0))
    placement.put_robot(3, (1.5, 0.5), np.pi / 2, (1.0, -1.0, 2.0))
    ball, robots = placement.frame.ball, placement.frame.robots
    assert ball.position[0].tolist() == [0.5 * sign, -0.25 * sign]
    assert ball.velocity[0].tolist() == [sign, 2.0 * sign]
    assert (ball.height[0], ball.vertical_velocity[0]) == (0.125, 3.0)
    assert robots.position[0, 3].tolist() == [1.5 * sign, 0.5 * sign]
    assert np.allclose(robots.heading[0, 3], (0.0, sign), atol=1e-6)
    assert robots.velocity[0, 3].tolist() == [sign, -sign]
    assert robots.angular_velocity[0, 3] == 2.0
    assert placement.ball
    assert placement.robots.tolist() == [False] * 3 + [True] + [False] * 3
    others = [0, 1, 2, 4, 5, 6]
    assert np.array_equal(robots.data[0, others], frame.robots.data[1, others])
    assert np.array_equal(frame.rows, state().rows), "the state itself is not changed"


def test_none_leaves_a_number() -> None:
    frame = state()
    placement = Placement(layout(positive=True), frame)
    placement.put_ball((None, 0.125, None), (None, None, 0.0))
    ball = placement.frame.ball
    assert np.allclose(ball.position[0], (frame.ball.position[0, 0], -0.125), atol=1e-6)
    assert np.allclose(ball.velocity[0], frame.ball.velocity[0], atol=1e-6)
    placement.put_robot(2, (None, None), None)
    robots = placement.frame.robots
    assert np.allclose(robots.position[0, 2], frame.robots.position[0, 2], atol=1e-6)
    assert np.array_equal(robots.heading[0, 2], frame.robots.heading[0, 2])
    assert not robots.velocity[0, 2].any()


def test_a_rolling_ball_rolls() -> None:
    placement = Placement(layout(), state())
    placement.put_ball((0, 0, 0), (1.0, 2.0, 0), roll=True)
    radius = SSL.ball.radius
    assert np.allclose(placement.frame.ball.spin[0], (-2.0 / radius, 1.0 / radius, 0.0), rtol=1e-5)
    placement.put_ball((0, 0, 0), (1.0, 2.0, 0))
    assert not placement.frame.ball.spin.any()


def test_robots_leave_and_enter() -> None:
    placement = Placement(layout(), state())
    placement.put_robot(0, (None, None), None, present=False)
    assert placement.frame.robots.absent[0, 0] == 1.0
    with pytest.raises(MessageError, match=r"^robot: expected x and y") as error:
        placement.put_robot(0, (None, 1.0), None, present=True)
    assert error.value.code is Code.INCOMPLETE
    placement.put_robot(0, (2.0, 1.0), None)
    assert placement.frame.robots.absent[0, 0] == 0.0
    assert placement.frame.robots.heading[0, 0].tolist() == [1.0, 0.0]


@pytest.mark.parametrize(
    ("position", "velocity"),
    [
        ((9.0, 0, 0), (0, 0, 0)),
        ((0, 8, 0), (0, 0, 0)),
        ((0, 0, -1), (0, 0, 0)),
        ((0, 0, 0), (1e4, 0, 0)),
    ],
)
def test_a_ball_out_of_range_is_refused(
    position: tuple[float, float, float], velocity: tuple[float, float, float]
) -> None:
    placement, frame = Placement(layout(), state()), state()
    with pytest.raises(MessageError, match=r"^ball: ") as error:
        placement.put_ball(position, velocity)
    assert error.value.code is Code.OUT_OF_RANGE
    assert np.array_equal(placement.row, frame.rows[0])
    assert not placement.ball


@pytest.mark.parametrize("velocity", [(1e4, 0, 0), (0, 0, 1e6), (0, 0, -1e6)])
def test_a_robot_out_of_range_is_refused(velocity: tuple[float, float, float]) -> None:
    placement, frame = Placement(layout(), state()), state()
    with pytest.raises(MessageError, match=r"^robot: "):
        placement.put_robot(0, (0.0, 0.0), 0.0, velocity)
    with pytest.raises(MessageError, match=r"^robot: x: expected"):
        placement.put_robot(0, (90.0, 0.0), 0.0)
    assert np.array_equal(placement.row, frame.rows[0])


def test_the_simulator_takes_a_placement() -> None:
    simulator, frame = Simulator(SSL, 1), state(worlds=1)
    simulator.read(frame.rows)
    placement = Placement(layout(positive=True), frame)
    placement.put_ball((1.0, 1.5, 0.0), (2.0, 0.0, 0.0), roll=True)
    placement.put_robot(6, (3.0, 2.0), 0.5)
    placement.put_robot(5, (None, None), None, present=False)
    out = np.zeros_like(frame.rows)
    simulator.restart(np.array([True]), placement.frame.rows, out)
    assert np.allclose(out[0, :2], (-1.0, -1.5))
