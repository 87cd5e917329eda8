"""Kinematics of four wheels: wheel speeds from the body's velocity, and the reverse."""

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles


class WheelKinematics:
    """Kinematics of an omnidirectional robot with four wheels.

    Body velocities are forward (m/s), left (m/s) and angular velocity (rad/s), counterclockwise.
    """

    def __init__(self, robot: RobotModel) -> None:
        """Compute the matrices of a robot.

        Args:
            robot: the robot: angles, distance, radius and largest speed of its wheels.
        """
        angles = np.radians(robot.wheel_angles)
        arms = np.full_like(angles, robot.wheel_distance)
        self._from_body = np.stack([-np.sin(angles), np.cos(angles), arms], 1) / robot.wheel_radius
        self._to_body = np.linalg.pinv(self._from_body)  # least squares where wheels disagree
        self._max_speed = robot.max_wheel_speed

    def wheel_speeds(self, velocities: Doubles) -> Doubles:
        """Compute wheel speeds from body velocities.

        Args:
            velocities: body velocities (n, 3).

        Returns:
            Wheel speeds (n, 4), rad/s, without a limit.
        """
        speeds: Doubles = velocities @ self._from_body.T
        return speeds

    def body_velocities(self, speeds: Doubles) -> Doubles:
        """Compute body velocities from wheel speeds.

        If a wheel is faster than its motor allows, all four are slowed by one factor, so that the
        robot keeps its direction.

        Args:
            speeds: wheel speeds (n, 4), rad/s.

        Returns:
            Body velocities (n, 3).
        """
        fastest = np.abs(speeds).max(axis=1, keepdims=True, initial=self._max_speed)
        velocities: Doubles = (speeds * (self._max_speed / fastest)) @ self._to_body.T
        return velocities
