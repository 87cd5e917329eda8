import numpy as np
import pytest

from rsoccer import SimConfig, derived
from rsoccer.frame import Frame

VSS = SimConfig()
SIDE = VSS.robot.side_length


def pair(distance: float, speed: float = 0.0, angular_velocity: float = 0.0) -> Frame:
    """blue_0 at the center, yellow_0 ahead of it; the others far away."""
    frame = Frame.empty(1, 3, 3)
    frame.robots.position[0] = [(-0.5, 0.1 * i) for i in range(-3, 3)]
    frame.robots.position[0, 0], frame.robots.position[0, 3] = (0.0, 0.0), (distance, 0.0)
    frame.robots.velocity[0, 0] = speed, 0.0
    frame.robots.angular_velocity[0, 0] = angular_velocity
    return frame


def test_opponents_that_meet_have_their_closing_speed() -> None:
    last, frame = pair(SIDE + 0.02, speed=1.5), pair(SIDE)
    found = derived.collisions(last, frame, VSS, 0.025)
    assert found.opponent[0].tolist() == [True, False, False, True, False, False]
    assert found.speed[0, [0, 3]] == pytest.approx(1.5, abs=1e-4)
    assert not found.speed[0, [1, 2, 4, 5]].any()


def test_a_corner_that_turns_into_a_robot_closes_at_its_own_speed() -> None:
    last = pair(SIDE / 2 * (1 + 2**0.5) - 1e-4, angular_velocity=10.0)
    last.robots.heading[0, 0] = np.cos(0.7), np.sin(0.7)
    found = derived.collisions(last, last, VSS, 0.025)
    # The corner is at 45 + 40.1 degrees: it still moves toward the face, slowly.
    assert 0.0 <= found.speed[0, 0] < 0.2
    assert found.opponent[0, 0]


def test_teammates_collide_but_do_not_touch_opponents() -> None:
    last, frame = pair(0.5, speed=1.0), pair(0.5)
    for each, x in ((last, SIDE + 0.01), (frame, SIDE)):
        each.robots.position[0, 1] = x, 0.0
    found = derived.collisions(last, frame, VSS, 0.025)
    assert found.speed[0, [0, 1]] == pytest.approx(1.0, abs=1e-4)
    assert not found.opponent.any()


def test_robots_that_brake_in_time_have_not_met() -> None:
    last, frame = pair(SIDE + 0.031, speed=1.3), pair(SIDE + 0.031, speed=1.06)
    frame.robots.position[0, 0, 0] = 0.0296
    assert not derived.collisions(last, frame, VSS, 0.025).opponent.any()


def test_robots_close_at_the_lower_of_two_estimated_speeds() -> None:
    """A tracker that takes a robot to be pushed tells a velocity with much noise."""
    last, frame, slow = pair(SIDE, speed=1.5), pair(SIDE), pair(SIDE, speed=0.1)
    for first, second in ((last, slow), (slow, last)):
        found = derived.collisions(first, frame, VSS, 0.025, mean_motion=second)
        assert found.speed[0, [0, 3]] == pytest.approx(0.1, abs=1e-4)
        assert found.opponent[0].tolist() == [True, False, False, True, False, False]
