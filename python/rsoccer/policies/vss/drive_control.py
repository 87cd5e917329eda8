"""Motion control of differential drives: from a target position to the speed of each wheel.

Speeds of wheels are normalized: 1 is full speed, that is, an action of magnitude 1.
"""

from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import RobotColumns
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import TINY, norm, reciprocal, rotate_into_body

DAMPING: Final = np.float32(0.3)  # slower turn, per share of the fastest turn: no overshoot
WALL_MARGIN: Final = 0.005  # m to a wall, beyond what a robot needs to turn on the spot
TURN_GAIN: Final = np.float32(1.1)  # wheel speed of a turn, per sine of the heading error
BRAKE_DISTANCE: Final = np.float32(0.15)  # m before a stop where speed starts to fall, by its root
CREEP_DISTANCE: Final = np.float32(0.03)  # m where drive and turn start to fall linearly to 0
SLOW_SHARE: Final = np.float32(0.1)  # share of top speed below which a robot may be stuck
MIN_PUSH: Final = np.float32(0.3)  # wheel speed from which a robot that stays slow is stuck
MAX_SLOW_STEPS: Final = 16  # slow steps before a robot backs off
BACK_OFF_STEPS: Final = 12  # steps for which it backs off


class DriveTarget(NamedTuple):
    """Motion targets of robots, (n, robots) each."""

    x: Floats
    """x of the target position, m."""
    y: Floats
    """y of the target position, m."""
    through: Floats
    """1 to drive through the position at full speed, 0 to stop there."""
    turn: Floats
    """Turn on the spot in place of driving: wheel speed in [-1, 1], positive counterclockwise.

    0 to drive."""


class DriveController:
    """Drives robots to target positions, forwards or backwards, and backs off when stuck."""

    def __init__(self, robot: RobotModel) -> None:
        """Set the gains for a robot.

        Args:
            robot: a robot with a differential drive.
        """
        self._damping = turn_damping(robot)
        self._top_speed = np.float32(robot.top_speed)

    def drive(
        self,
        ego: RobotColumns,
        target: DriveTarget,
        max_wheel_speed: np.float32,
        slow_steps: Array,
        rng: WorldRng,
    ) -> Floats:
        """Compute the wheel speeds of one control step.

        Args:
            ego: state of the robots, (n, robots, ...).
            target: their motion targets.
            max_wheel_speed: largest normalized wheel speed, in (0, 1].
            slow_steps: (n, robots) counters of `back_off`; updated in place.
            rng: (n,) random streams; a robot that backs off turns at random.

        Returns:
            (n, robots, 2) normalized speeds of the left and the right wheel, within
            -max_wheel_speed to max_wheel_speed.
        """
        forward, turn = self._steer(ego, target)
        min_speed = SLOW_SHARE * max_wheel_speed * self._top_speed
        backing = back_off(ego.velocity, min_speed, np.abs(forward) > MIN_PUSH, slow_steps)
        forward = np.where(backing, -forward, forward)
        turn = np.where(backing, rng.uniform(-1.0, 1.0, slow_steps.shape[1:]), turn)
        return wheel_speeds(forward, turn) * max_wheel_speed

    def _steer(self, ego: RobotColumns, target: DriveTarget) -> tuple[Floats, Floats]:
        """Wheel speeds of driving and of turning, (n, robots) each."""
        x, y = target.x - ego.position[..., 0], target.y - ego.position[..., 1]
        ahead, left = rotate_into_body(x, y, ego.heading)
        distance = norm(x, y)
        near = np.minimum(distance / CREEP_DISTANCE, np.float32(1.0))
        speed = np.minimum(np.sqrt(distance / BRAKE_DISTANCE), near)
        speed = np.where(target.through > 0.0, np.float32(1.0), speed)
        scale = reciprocal(distance, TINY)
        ahead, left = ahead * scale, left * scale
        # The larger the heading error, the slower the robot drives: it turns first.
        # Backwards is as good as forwards.
        # A target straight to the side is ahead, too: without a side the robot would never turn.
        side = np.copysign(np.float32(1.0), ahead)
        forward, turn = speed * ahead * np.abs(ahead), left * side * near * TURN_GAIN
        turns = target.turn != 0.0
        forward = np.where(turns, np.float32(0.0), forward)
        return forward, np.where(turns, target.turn, turn - ego.angular_velocity * self._damping)


def require_differential_drive(policy: str, task: Task) -> None:
    """Check that a task's robots have a differential drive, with wheel speeds as actions.

    Args:
        policy: name of the policy, for the error message.
        task: the task to be played.

    Raises:
        ValueError: robots with another drive, or other actions.
    """
    if tuple(task.config.command_columns) != ("left", "right") or task.action_size != 2:
        raise ValueError(
            f"task: {policy} needs robots with a differential drive and actions of 2 numbers, "
            f"got {task.name}"
        )


def turning_clearance(robot: RobotModel) -> float:
    """Return the distance (m) from a wall at which a robot can turn on the spot.

    Args:
        robot: a robot with a differential drive.
    """
    return robot.bounding_radius + WALL_MARGIN


def turn_damping(robot: RobotModel) -> np.float32:
    """Return the reduction of a turn's wheel speed per angular velocity, s/rad.

    Args:
        robot: a robot with a differential drive.
    """
    return DAMPING * np.float32(0.5 * robot.track_width / robot.top_speed)


def back_off(velocity: Floats, min_speed: np.float32, pushing: Mask, slow_steps: Array) -> Mask:
    """Detect robots that are stuck, and make them back off for some steps.

    A robot is stuck after `MAX_SLOW_STEPS` slow steps; it backs off for `BACK_OFF_STEPS` steps.

    Args:
        velocity: (n, robots, 2) velocities, m/s.
        min_speed: speed below which a robot counts as slow, m/s.
        pushing: (n, robots) whether a robot tries to move.
        slow_steps: (n, robots) slow steps of each robot so far, negative while it backs off;
            updated in place.

    Returns:
        (n, robots) whether a robot backs off in this step.
    """
    speed = np.abs(velocity[..., 0]) + np.abs(velocity[..., 1])
    slow = (speed < min_speed) & pushing
    slow_steps[:] = np.where(slow_steps < 0, slow_steps + 1, np.where(slow, slow_steps + 1, 0))
    slow_steps[slow_steps > MAX_SLOW_STEPS] = -BACK_OFF_STEPS
    return np.less(slow_steps, 0)


def wheel_speeds(forward: Floats, turn: Floats) -> Floats:
    """Return the normalized speeds of the left and the right wheel, (..., 2) in [-1, 1].

    If a wheel exceeds 1, both are scaled down alike, which keeps the curvature.

    Args:
        forward: (...) wheel speed of driving, positive forward.
        turn: (...) wheel speed of turning, positive counterclockwise.
    """
    scale = np.maximum(np.abs(forward) + np.abs(turn), np.float32(1.0))
    return np.stack([(forward - turn) / scale, (forward + turn) / scale], axis=-1)
