import numpy as np
import pytest

from rsoccer._core import RobotModel
from rsoccer.compat.legacy_models import SSL_ROBOT
from rsoccer.compat.wheel_kinematics import WheelKinematics

BODIES = np.array([[1.0, 0.0, 0.0], [0.0, -0.7, 0.0], [0.0, 0.0, 5.0], [0.3, 0.2, 3.0]])


@pytest.mark.parametrize("robot", [SSL_ROBOT, RobotModel("ssl_tigers")], ids=["old", "tigers"])
def test_wheel_speeds_and_body_velocities_are_inverse(robot: RobotModel) -> None:
    wheels = WheelKinematics(robot)
    np.testing.assert_allclose(
        wheels.body_velocities(wheels.wheel_speeds(BODIES)), BODIES, atol=1e-12
    )


def test_a_wheel_turns_as_fast_as_its_rim_moves() -> None:
    speeds = WheelKinematics(SSL_ROBOT).wheel_speeds(BODIES)
    assert speeds[0] == pytest.approx(
        np.array([-1, -1, 1, 1]) * np.sin(np.radians([60, 45, 45, 60])) / 0.02475
    )
    assert speeds[2] == pytest.approx(np.full(4, 5.0 * 0.09 / 0.02475))


def test_too_fast_wheels_are_slowed_by_one_factor() -> None:
    wheels = WheelKinematics(SSL_ROBOT)
    commanded = wheels.wheel_speeds(np.array([[9.0, 4.5, 30.0]]))
    assert abs(commanded).max() > SSL_ROBOT.max_wheel_speed
    limited = wheels.body_velocities(commanded)[0]
    assert limited / limited[0] == pytest.approx([1.0, 0.5, 30.0 / 9.0])
    assert abs(wheels.wheel_speeds(limited)).max() == pytest.approx(SSL_ROBOT.max_wheel_speed)


def test_no_robots_have_no_wheels() -> None:
    wheels = WheelKinematics(SSL_ROBOT)
    assert wheels.body_velocities(np.zeros((0, 4))).shape == (0, 3)
    assert wheels.wheel_speeds(np.zeros((0, 3))).shape == (0, 4)
