"""Ball approach of SSL scripts: drive past obstacles, face the ball, take it into the mouth."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.frame import RobotColumns
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.path_planning import Obstacles, next_waypoint
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl
from rsoccer.vectors import XY, norm, reciprocal, rotate_into

MAX_ANGULAR_VELOCITY: Final = 10.0  # rad/s, without the ball
STANDOFF: Final = np.float32(0.1)  # m between mouth and ball where the final approach starts
FREE_STANDOFF: Final = np.float32(0.05)  # m between mouth and ball where a robot must have space
PRESS_DEPTH: Final = np.float32(0.03)  # m beyond contact that the final approach aims at
FACING_COSINE: Final = np.float32(0.97)  # of the heading error at which the final approach starts
FOLLOW_SPEED: Final = np.float32(1.5)  # m/s of a ball that a robot can still catch up with
DIRECTIONS: Final = 16  # candidate directions of approach
CROWDING_COST: Final = np.float32(10.0)  # m of detour, per m too near to a robot

_ANGLES = np.arange(DIRECTIONS) * (2.0 * np.pi / DIRECTIONS)
_COS: Final[Floats] = np.cos(_ANGLES).astype(np.float32)
_SIN: Final[Floats] = np.sin(_ANGLES).astype(np.float32)


def approach_direction(
    position: Floats,
    ball: Floats,
    robots: XY,
    region: Region,
    mouth_distance: np.float32,
    clearance: np.float32,
) -> XY:
    """Return directions of approach with a short path and enough space for the robot.

    Args:
        position: (n, robots, 2) positions of the robots, m.
        ball: (n, robots, 2) position of the ball, m.
        robots: (n, robots, others) positions of other robots, m.
        region: allowed positions.
        mouth_distance: from a robot's center to a ball in its mouth, m.
        clearance: distance to keep from the centers of other robots, m.

    Returns:
        Unit vectors (n, robots) from the robot's future position to the ball.
    """
    to_x, to_y = ball[..., 0] - position[..., 0], ball[..., 1] - position[..., 1]
    scale = reciprocal(norm(to_x, to_y))
    shape = (*to_x.shape, DIRECTIONS)
    u_x: Floats = np.concatenate([(to_x * scale)[..., None], np.broadcast_to(_COS, shape)], axis=-1)
    u_y: Floats = np.concatenate([(to_y * scale)[..., None], np.broadcast_to(_SIN, shape)], axis=-1)
    distance = mouth_distance + FREE_STANDOFF
    x, y = ball[..., None, 0] - u_x * distance, ball[..., None, 1] - u_y * distance
    gap_x = robots[0][..., None, :] - x[..., None]
    gap_y = robots[1][..., None, :] - y[..., None]
    crowding = np.maximum(clearance - norm(gap_x, gap_y).min(axis=-1), np.float32(0.0))
    crowding = crowding + region.distance_outside(x, y)
    path = norm(x - position[..., None, 0], y - position[..., None, 1])
    best = np.argmin(path + CROWDING_COST * crowding, axis=-1)[..., None]
    x, y = (np.take_along_axis(u, best, -1)[..., 0] for u in (u_x, u_y))
    return x, y


def approach_ball(
    control: RobotControl,
    ego: RobotColumns,
    ball: tuple[Floats, Floats],
    robots: XY,
    region: Region,
    max_speed: Floats | float,
    direction: XY | None = None,
) -> tuple[Floats, Floats, Floats]:
    """Return velocities that bring the ball into the mouth.

    Args:
        control: control of the robots.
        ego: state of the robots, (n, robots, ...).
        ball: position (m) and velocity (m/s) of the ball, (n, robots, 2) each.
        robots: (n, robots, others) positions of other robots, m.
        region: allowed positions.
        max_speed: upper bound, m/s.
        direction: unit vectors of the approach; None: `approach_direction` chooses.

    Returns:
        Velocity along x and y (m/s) and angular velocity (rad/s), (n, robots) each.
    """
    position, (ball_at, ball_velocity) = ego.position, ball
    clearance = control.robot_diameter + np.float32(0.05)
    mouth_distance = control.mouth_distance
    u_x, u_y = direction or approach_direction(
        position, ball_at, robots, region, mouth_distance, clearance
    )
    standoff = mouth_distance + STANDOFF
    staging = region.clamp(ball_at[..., 0] - u_x * standoff, ball_at[..., 1] - u_y * standoff)
    obstacles = _obstacles(control, robots, ball_at, clearance)
    next_x, next_y, path = next_waypoint(position, staging, obstacles, region)
    v_x, v_y = motion.velocity_to(position, next_x, next_y, max_speed, path)
    to_x, to_y = ball_at[..., 0] - position[..., 0], ball_at[..., 1] - position[..., 1]
    cosine, _ = motion.heading_error(ego, to_x, to_y)
    along_approach, _ = rotate_into(to_x, to_y, u_x, u_y)
    near = norm(to_x, to_y) < standoff + np.float32(0.06)
    on_line = along_approach > np.float32(0.9) * norm(to_x, to_y)
    final = near & (cosine > FACING_COSINE) & on_line
    pressed = mouth_distance - PRESS_DEPTH
    contact = region.clamp(ball_at[..., 0] - u_x * pressed, ball_at[..., 1] - u_y * pressed)
    final_x, final_y = motion.velocity_to(position, *contact, motion.SLOW_SPEED)
    # The robot follows a rolling ball, but not a ball after a shot.
    follows = norm(ball_velocity[..., 0], ball_velocity[..., 1]) < FOLLOW_SPEED
    zero = np.float32(0.0)
    v_x = np.where(final, final_x, v_x) + np.where(follows, ball_velocity[..., 0], zero)
    v_y = np.where(final, final_y, v_y) + np.where(follows, ball_velocity[..., 1], zero)
    v_x, v_y = motion.limit_speed_near_robots(
        position, (v_x, v_y), robots, control.robot_diameter, max_speed
    )
    return v_x, v_y, motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)


def _obstacles(control: RobotControl, robots: XY, ball: Floats, clearance: np.float32) -> Obstacles:
    """Other robots and the ball as obstacles."""
    robot_clearance = np.broadcast_to(clearance, robots[0].shape)
    ball_clearance = np.broadcast_to(control.ball_distance + np.float32(0.03), ball[..., :1].shape)
    return Obstacles(
        np.concatenate([robots[0], ball[..., None, 0]], axis=-1),
        np.concatenate([robots[1], ball[..., None, 1]], axis=-1),
        np.concatenate([robot_clearance, ball_clearance], axis=-1),
    )
