import numpy as np
import pytest

from rsoccer._core import RobotModel
from rsoccer.compat.legacy_models import SSL_ROBOT
from rsoccer.compat.wheel_kinematics import Wheels

BODIES = np.array([[1.0, 0.0, 0.0], [0.0, -0.7, 0.0], [0.0, 0.0, 5.0], [0.3, 0.2, 3.0]])


@pytest.mark.parametrize("robot", [SSL_ROBOT, RobotModel("ssl_tigers")], ids=["old", "tigers"])
def test_speeds_and_velocities_say_the_same(robot: RobotModel) -> None:
    wheels = Wheels(robot)
    np.testing.assert_allclose(wheels.velocities(wheels.speeds(BODIES)), BODIES, atol=1e-12)


def test_a_wheel_turns_as_fast_as_its_rim_moves() -> None:
    speeds = Wheels(SSL_ROBOT).speeds(BODIES)
    assert speeds[0] == pytest.approx(
        np.array([-1, -1, 1, 1]) * np.sin(np.radians([60, 45, 45, 60])) / 0.02475
    )
    assert speeds[2] == pytest.approx(np.full(4, 5.0 * 0.09 / 0.02475))


def test_too_fast_wheels_are_slowed_alike() -> None:
    wheels = Wheels(SSL_ROBOT)
    asked = wheels.speeds(np.array([[9.0, 4.5, 30.0]]))
    assert abs(asked).max() > SSL_ROBOT.max_wheel_speed
    got = wheels.velocities(asked)[0]
    assert got / got[0] == pytest.approx([1.0, 0.5, 30.0 / 9.0])
    assert abs(wheels.speeds(got)).max() == pytest.approx(SSL_ROBOT.max_wheel_speed)


def test_no_robots_have_no_wheels() -> None:
    wheels = Wheels(SSL_ROBOT)
    assert wheels.velocities(np.zeros((0, 4))).shape == (0, 3)
    assert wheels.speeds(np.zeros((0, 3))).shape == (0, 4)
