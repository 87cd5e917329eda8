"""The `passer` policy: pass to the teammate and receive passes."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.interception import point_on_ball_line
from rsoccer.policies.ssl.pass_lines import PassSpeed
from rsoccer.policies.ssl.path_planning import teammate_positions
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import XY, norm, reciprocal
from rsoccer.view import View

ARRIVAL_SPEED: Final = np.float32(1.8)  # m/s of a pass on arrival: the dribbler stops it
LONG_PASS: Final = np.float32(3.0)  # m from which a pass is faster, to arrive in time
LONG_PASS_GAIN: Final = np.float32(0.3)  # m/s faster on arrival, per m beyond LONG_PASS
MAX_ANGULAR_VELOCITY: Final = 5.0  # rad/s, with the ball on the dribbler
MAX_AIM_SINE: Final = np.float32(0.008)  # sine of the heading error for a kick
MAX_KICK_ANGULAR_VELOCITY: Final = np.float32(0.15)  # rad/s of the robot for a kick
MAX_RECEIVER_SPEED: Final = np.float32(0.1)  # m/s of a teammate for a pass
MIN_BALL_SPEED: Final = np.float32(0.3)  # m/s of a ball that is on its way
MIN_DISTANCE: Final = np.float32(2.0)  # m to the teammate
LINE_MARGIN: Final = 0.3  # m between the robot's center and the field's lines
MAX_SPEED: Final = 2.0  # m/s
RETREAT_SPEED: Final = 1.0  # m/s, away from a teammate that is too near


class Passer(Policy):
    """A script that turns to its teammate and passes; without the ball it receives passes."""

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task with at least two blue robots.

        Raises:
            ValueError: another task, or one without a teammate.
        """
        super().__init__(task)
        self._control = RobotControl(require_ssl("passer", task))
        if task.n_blue < 2:
            raise ValueError(f"task: passer needs a teammate, got {task.name}")
        self._region = Region.of_field(task.config.field, LINE_MARGIN)
        self._pass_speed = PassSpeed(task.config.ball)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("passer")
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        has_ball = self._control.has_ball(view)
        other_x, other_y = _teammate(view)
        pass_x, pass_y = other_x - ego.position[..., 0], other_y - ego.position[..., 1]
        v_x, v_y = self._receiving_velocity(view)
        face_x, face_y = np.where(has_ball, pass_x, to_x), np.where(has_ball, pass_y, to_y)
        angular_velocity = motion.angular_velocity_to(ego, face_x, face_y, MAX_ANGULAR_VELOCITY)
        zero = np.float32(0.0)
        kick = np.where(has_ball, self._kick_speed(view), zero)
        v_x, v_y = np.where(has_ball, zero, v_x), np.where(has_ball, zero, v_y)
        return self._control.actions(ego, v_x, v_y, angular_velocity, kick)

    def _kick_speed(self, view: View) -> Floats:
        """Kick speed (m/s) of a robot that is ready to pass; 0 for others."""
        ego, ball, teammate = view.ego, view.ball, view.teammates
        other_x, other_y = _teammate(view)
        x, y = other_x - ball.position[..., 0], other_y - ball.position[..., 1]
        cos, sin = motion.heading_error(ego, x, y)
        ready = (
            (cos > 0.0)
            & (np.abs(sin) < MAX_AIM_SINE)
            & (np.abs(ego.angular_velocity) < MAX_KICK_ANGULAR_VELOCITY)
        )
        # A ball that still moves has not been received yet.
        ball_speed = norm(ball.velocity[..., 0], ball.velocity[..., 1])
        ready &= (ego.infrared > 0.5) & (ball_speed < MIN_BALL_SPEED)
        receiver_velocity = teammate.velocity[:, :, 0]
        receiver_speed = norm(receiver_velocity[..., 0], receiver_velocity[..., 1])
        ready &= (receiver_speed < MAX_RECEIVER_SPEED) & (teammate.absent[:, :, 0] == 0.0)
        distance = np.maximum(norm(x, y) - self._control.mouth_distance, np.float32(0.0))
        extra = LONG_PASS_GAIN * np.maximum(distance - LONG_PASS, np.float32(0.0))
        arrival = ARRIVAL_SPEED + extra
        speed = self._pass_speed.kick(distance, arrival)
        return np.where(ready, speed, np.float32(0.0))

    def _receiving_velocity(self, view: View) -> XY:
        """Velocity (m/s) onto the line of a coming ball, or away from a teammate too near."""
        position = view.ego.position
        other_x, other_y = _teammate(view)
        coming, x, y = point_on_ball_line(view, MIN_BALL_SPEED)
        line_x, line_y = motion.velocity_to(position, x, y, MAX_SPEED)
        away_x, away_y = position[..., 0] - other_x, position[..., 1] - other_y
        distance = norm(away_x, away_y)
        scale = MIN_DISTANCE * reciprocal(distance)
        retreat = self._region.clamp(other_x + away_x * scale, other_y + away_y * scale)
        away_x, away_y = motion.velocity_to(position, *retreat, RETREAT_SPEED)
        near = distance < MIN_DISTANCE
        zero = np.float32(0.0)
        return (
            np.where(coming, line_x, np.where(near, away_x, zero)),
            np.where(coming, line_y, np.where(near, away_y, zero)),
        )


def _teammate(view: View) -> XY:
    """Position (m) of the teammate, (n, robots) each; far away if it is absent."""
    x, y = teammate_positions(view)
    return x[..., 0], y[..., 0]
