"""Control of SSL robots by scripts: action encoding, dimensions and limits."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import RobotColumns
from rsoccer.task import Task
from rsoccer.tasks.ssl import Ssl
from rsoccer.vectors import TINY, norm, rotate_into
from rsoccer.view import View

TURN, KICK, DRIBBLER = 2, 3, 4  # indices in an SSL robot's action

DRIBBLE_ACCELERATION: Final = np.float32(1.5)  # m/s², with the ball on the dribbler
DRIBBLE_ANGULAR_ACCELERATION: Final = np.float32(15.0)  # rad/s², with the ball on the dribbler
BALL_AHEAD_TOLERANCE: Final = np.float32(0.02)  # m from the ball's position in the mouth, ahead
BALL_SIDE_TOLERANCE: Final = np.float32(0.04)  # m from the ball's position in the mouth, sideways


def require_dribbler(policy: str, task: Task) -> None:
    """Check that the robots of a task have a dribbler, and actions that begin with five numbers.

    Args:
        policy: name of the policy, for the error message.
        task: the task to be played.

    Raises:
        ValueError: other robots, or other actions.
    """
    required = task.action_size - task.optional_action_size
    if "dribbler" not in task.config.command_columns or required != 5:
        raise ValueError(
            f"task: {policy} needs robots with a dribbler and actions of 5 numbers, got {task.name}"
        )


def require_ssl(policy: str, task: Task) -> Ssl:
    """Check that a task is an SSL task, whose action scales are known.

    Args:
        policy: name of the policy, for the error message.
        task: the task to be played.

    Returns:
        The task.

    Raises:
        ValueError: another task, or other actions.
    """
    require_dribbler(policy, task)
    if not isinstance(task, Ssl):
        raise ValueError(f"task: {policy} needs a subclass of Ssl, got {task.name}")
    return task


class RobotControl:
    """Dimensions, limits and action encoding of the robots of an SSL task."""

    def __init__(self, task: Ssl) -> None:
        """Read the dimensions and the action scales.

        Args:
            task: the task to be played.
        """
        robot, ball = task.config.robot, task.config.ball
        self.mouth_distance = np.float32(robot.front_distance + ball.radius)
        """From a robot's center to the center of a ball at its front, m."""
        self.robot_diameter = np.float32(2.0 * robot.bounding_radius)
        """Distance between the centers of robots that touch, m."""
        self.ball_distance = np.float32(robot.bounding_radius + ball.radius)
        """Distance between the centers of robot and ball beyond which they cannot touch, m."""
        self.max_kick_speed = np.float32(task.action_scales[KICK])
        """Speed of the hardest kick, m/s."""
        self._max_change = DRIBBLE_ACCELERATION * np.float32(task.config.time_step)
        self._max_angular_change = DRIBBLE_ANGULAR_ACCELERATION * np.float32(task.config.time_step)
        self._action_per_unit = np.float32(1.0) / task.action_scales
        self._in_robot_frame = task.velocity_frame == "robot"

    def actions(
        self,
        ego: RobotColumns,
        v_x: Floats,
        v_y: Floats,
        angular_velocity: Floats,
        kick: Floats | None = None,
    ) -> Floats:
        """Encode velocities as actions; the dribbler is on.

        Args:
            ego: state of the robots, (n, robots, ...).
            v_x: (n, robots) velocity along the field's x axis, m/s.
            v_y: (n, robots) velocity along the field's y axis, m/s.
            angular_velocity: (n, robots) angular velocity, rad/s.
            kick: (n, robots) kick speed, m/s; 0 or None: no kick.

        Returns:
            (n, robots, 5) in [-1, 1].
        """
        kick = np.zeros_like(v_x) if kick is None else kick
        actions = np.empty((*v_x.shape, 5), np.float32)
        if self._in_robot_frame:
            v_x, v_y = rotate_into(v_x, v_y, ego.heading[..., 0], ego.heading[..., 1])
        actions[..., 0], actions[..., 1], actions[..., TURN] = v_x, v_y, angular_velocity
        actions[..., KICK], actions[..., DRIBBLER] = kick, 1.0
        actions *= self._action_per_unit
        actions[..., KICK] = np.where(kick > 0.0, actions[..., KICK], np.float32(-1.0))
        return np.minimum(np.maximum(actions, -1.0), 1.0)

    def limit_acceleration(
        self, ego: RobotColumns, v_x: Floats, v_y: Floats, angular_velocity: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Limit the change of velocities, so that the ball stays on the dribbler.

        The dribbler pulls a ball along with 2.6 m/s² at most.

        Args:
            ego: state of the robots, (n, robots, ...).
            v_x: (n, robots) wanted velocity along x, m/s.
            v_y: (n, robots) wanted velocity along y, m/s.
            angular_velocity: (n, robots) wanted angular velocity, rad/s.

        Returns:
            Velocity (x, y) and angular velocity close to the present ones.
        """
        change_x, change_y = v_x - ego.velocity[..., 0], v_y - ego.velocity[..., 1]
        change = np.maximum(norm(change_x, change_y), TINY)
        scale = np.minimum(self._max_change / change, np.float32(1.0))
        angular_change = np.minimum(
            np.maximum(angular_velocity - ego.angular_velocity, -self._max_angular_change),
            self._max_angular_change,
        )
        return (
            ego.velocity[..., 0] + change_x * scale,
            ego.velocity[..., 1] + change_y * scale,
            ego.angular_velocity + angular_change,
        )

    def has_ball(self, view: View) -> Mask:
        """Return whether the ball is in each robot's mouth, within a tolerance; (n, robots).

        Args:
            view: view of the robots.
        """
        ball = view.ball.position
        return self._in_mouth(view.ego, ball[..., 0], ball[..., 1])

    def opponents_have_ball(self, view: View) -> Mask:
        """Return which opponents have the ball in their mouths, (n, robots, opponents).

        The break beam of a ball that barely touches flickers, and vision knows no beams.

        Args:
            view: view of the robots; opponents have the same model.
        """
        ball = view.ball.position[..., None, :]
        found = self._in_mouth(view.opponents, ball[..., 0], ball[..., 1])
        return np.logical_and(found, np.equal(view.opponents.absent, 0.0))

    def _in_mouth(self, robots: RobotColumns, ball_x: Floats, ball_y: Floats) -> Mask:
        """Whether balls (...) are in the mouths of robots (...), within a tolerance."""
        x, y = ball_x - robots.position[..., 0], ball_y - robots.position[..., 1]
        ahead, left = rotate_into(x, y, robots.heading[..., 0], robots.heading[..., 1])
        in_front: Mask = np.abs(ahead - self.mouth_distance) < BALL_AHEAD_TOLERANCE
        return in_front & (np.abs(left) < BALL_SIDE_TOLERANCE)
