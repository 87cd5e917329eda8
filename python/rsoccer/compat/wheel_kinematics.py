"""Four wheels: their speeds from the body's velocity, and the body's from theirs."""

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.entities import Doubles


class Wheels:
    """Kinematics of an omnidirectional robot; velocities are forward, left (m/s), turn (rad/s)."""

    def __init__(self, robot: RobotModel) -> None:
        """Read where the robot's wheels are."""
        places = np.radians(robot.wheel_angles)
        arms = np.full_like(places, robot.wheel_distance)
        self._from_body = np.stack([-np.sin(places), np.cos(places), arms], 1) / robot.wheel_radius
        self._to_body = np.linalg.pinv(self._from_body)  # least squares where wheels disagree
        self._fastest = robot.max_wheel_speed

    def speeds(self, velocities: Doubles) -> Doubles:
        """Wheel speeds (n, 4), rad/s, of body velocities (n, 3)."""
        speeds: Doubles = velocities @ self._from_body.T
        return speeds

    def velocities(self, speeds: Doubles) -> Doubles:
        """Body velocities (n, 3) of wheel speeds (n, 4), rad/s.

        If the fastest is beyond what its motor can do, all four are slowed alike, so that the robot
        goes where it was sent.
        """
        fastest = np.abs(speeds).max(axis=1, keepdims=True, initial=self._fastest)
        velocities: Doubles = (speeds * (self._fastest / fastest)) @ self._to_body.T
        return velocities
