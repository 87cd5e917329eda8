"""Motion of omnidirectional robots: velocities to positions, angular velocities to directions."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.frame import RobotColumns
from rsoccer.vectors import TINY, XY, norm, reciprocal, rotate_into_body

BRAKE: Final = np.float32(3.0)  # m/s², deceleration before a target
TURN_GAIN: Final = 6.0  # rad/s, per rad of heading error
POSITION_GAIN: Final = np.float32(8.0)  # m/s, per m to the target: the last centimeters
SLOW_SPEED: Final = 0.5  # m/s, into the ball and close to robots
SPEED_PER_GAP: Final = np.float32(3.0)  # m/s more, per m of gap to the nearest robot


def heading_error(ego: RobotColumns, x: Floats, y: Floats) -> XY:
    """Return cosine and sine of the angle from the robots' headings to directions.

    Args:
        ego: state of the robots, (n, robots, ...).
        x: (n, robots) x of the directions, any length.
        y: (n, robots) y of the directions.
    """
    ahead, left = rotate_into_body(x, y, ego.heading)
    scale = reciprocal(norm(x, y))
    return ahead * scale, left * scale


def angular_velocity_to(
    ego: RobotColumns,
    x: Floats,
    y: Floats,
    max_angular_velocity: Floats | float,
    gain: Floats | float = TURN_GAIN,
) -> Floats:
    """Return angular velocities (rad/s) that turn the robots to directions.

    Args:
        ego: state of the robots, (n, robots, ...).
        x: (n, robots) x of the directions, any length.
        y: (n, robots) y of the directions.
        max_angular_velocity: upper bound, rad/s.
        gain: rad/s, per rad of heading error.
    """
    cos, sin = heading_error(ego, x, y)
    sin = np.copysign(np.maximum(np.abs(sin), TINY), sin)
    # Twice the tangent of half the angle: about the angle if small, growing up to 180 degrees.
    angle = np.float32(2.0) * sin / np.maximum(np.float32(1.0) + cos, TINY)
    limited: Floats = np.minimum(
        np.maximum(angle * gain, -max_angular_velocity), max_angular_velocity
    )
    return limited


def velocity_to(
    position: Floats,
    x: Floats,
    y: Floats,
    max_speed: Floats | float,
    path_length: Floats | None = None,
) -> XY:
    """Return velocities (m/s) to waypoints, with braking before the target.

    Args:
        position: (n, robots, 2) positions of the robots, m.
        x: (n, robots) x of the waypoints, m.
        y: (n, robots) y of the waypoints, m.
        max_speed: upper bound, m/s.
        path_length: (n, robots) distance to the target along the path, m; None if the waypoint
            is the target.
    """
    x, y = x - position[..., 0], y - position[..., 1]
    distance = norm(x, y)
    remaining = distance if path_length is None else path_length
    speed = np.minimum(np.sqrt(np.float32(2.0) * BRAKE * remaining), remaining * POSITION_GAIN)
    scale = np.minimum(speed, max_speed) / np.maximum(distance, TINY)
    return x * scale, y * scale


def limit_speed_near_robots(
    position: Floats,
    velocity: XY,
    robots: XY,
    robot_diameter: np.float32,
    max_speed: Floats | float,
) -> XY:
    """Limit speeds (m/s) so that a robot can turn away before the nearest robot.

    Args:
        position: (n, robots, 2) positions of the robots, m.
        velocity: (n, robots) wanted velocities, m/s.
        robots: (n, robots, others) positions of other robots, m.
        robot_diameter: distance between centers of robots that touch, m.
        max_speed: upper bound far from robots, m/s.

    Returns:
        Velocities in the same direction.
    """
    gaps = norm(robots[0] - position[..., None, 0], robots[1] - position[..., None, 1])
    free = np.maximum(gaps.min(axis=-1) - robot_diameter - np.float32(0.05), np.float32(0.0))
    limit = SLOW_SPEED + SPEED_PER_GAP * free
    speed = np.maximum(norm(*velocity), TINY)
    scale = np.minimum(np.minimum(limit, max_speed) / speed, np.float32(1.0))
    return velocity[0] * scale, velocity[1] * scale
