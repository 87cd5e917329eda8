"""The `passer` policy: pass to the teammate and receive passes."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.rolling import RollingLaw
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.interception import point_on_ball_line
from rsoccer.policies.ssl.pass_lines import PassSpeed
from rsoccer.policies.ssl.path_planning import other_robots, teammate_positions
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import XY, norm, reciprocal
from rsoccer.view import View

ARRIVAL_SPEED: Final = np.float32(1.8)  # m/s of a pass on arrival: the dribbler stops it
LONG_PASS: Final = np.float32(3.0)  # m from which a pass is faster, to arrive in time
LONG_PASS_GAIN: Final = np.float32(0.3)  # m/s faster on arrival, per m beyond LONG_PASS
MAX_ANGULAR_VELOCITY: Final = 5.0  # rad/s
TURN_GAIN_WITH_BALL: Final = 9.0  # rad/s, per rad of heading error
PIVOT: Final = np.float32(0.75)  # from a turn about the robot's center, 0, to one about the ball, 1
MAX_AIM_OFFSET: Final = np.float32(0.028)  # m beside the teammate for a kick
MAX_KICK_ANGULAR_VELOCITY: Final = np.float32(0.4)  # rad/s of the robot for a kick
MAX_RECEIVER_SPEED: Final = np.float32(0.1)  # m/s of a teammate for a pass
MIN_BALL_SPEED: Final = np.float32(0.3)  # m/s of a ball that is on its way
DISTANCES: Final = (np.float32(2.1), np.float32(2.6))  # m to the teammate, least and greatest
LINE_MARGIN: Final = 0.3  # m between the robot's center and the field's lines
MAX_SPEED: Final = 2.0  # m/s
MEETING_SPEED: Final = np.float32(0.8)  # m/s on arrival below which a receiver goes to the ball
NEAR: Final = np.float32(0.4)  # m up to which a robot goes to a loose ball
LOOSE_SPEED: Final = np.float32(1.0)  # m/s up to which a ball near a robot is loose
TOUCHING_GAIN: Final = np.float32(6.0)  # m/s, per m between its dribbler and the ball
PRESS: Final = np.float32(0.004)  # m by which it aims beyond the touch
TOUCHING_SPEED: Final = np.float32(0.5)  # m/s
RELEASED: Final = np.float32(0.3)  # m from its center at which a robot has passed the ball
CLOSING_DISTANCE: Final = np.float32(0.3)  # m to a coming ball from which a receiver meets it
CLOSING_SPEED: Final = np.float32(0.15)  # m/s, with which it does
KICK_SECONDS: Final = 0.2  # s for which a kick is asked: kickers charge, or wait for a touch
HELD_SECONDS: Final = 0.075  # s with the ball before a kick: a forecast has it before it is there
WAITING_SPEED: Final = 2.0  # m/s, to where a robot waits for a pass


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
        self._pass_speed, self._rolling = PassSpeed(task.config.ball), RollingLaw(task.config.ball)
        self._kick_steps = round(KICK_SECONDS / task.config.time_step)
        self._held_steps = round(HELD_SECONDS / task.config.time_step)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return steps with the ball, the kick that is asked, m/s, and steps left of it.

        Each is (n, robots): `held`, `kick` and `steps`.
        """
        held, steps = np.zeros((2, *shape[:2]), np.int64)
        return {"held": held, "kick": np.zeros(shape[:2], np.float32), "steps": steps}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("passer")
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        has_ball = self._control.has_ball(view)
        # It faces along the line from ball to teammate: the ball may lie beside the robot's axis.
        other_x, other_y = _teammate(view)
        pass_x, pass_y = other_x - ball.position[..., 0], other_y - ball.position[..., 1]
        distance = norm(to_x, to_y)
        coming = point_on_ball_line(view, MIN_BALL_SPEED)
        v_x, v_y = self._receiving_velocity(view, distance, coming)
        face_x, face_y = np.where(has_ball, pass_x, to_x), np.where(has_ball, pass_y, to_y)
        gain = np.where(has_ball, TURN_GAIN_WITH_BALL, motion.TURN_GAIN).astype(np.float32)
        angular_velocity = motion.angular_velocity_to(
            ego, face_x, face_y, MAX_ANGULAR_VELOCITY, gain
        )
        zero = np.float32(0.0)
        memory["held"][:] = np.where(has_ball, memory["held"] + 1, 0)
        may_kick = memory["held"] > self._held_steps
        kick = self._kick_on(np.where(may_kick, self._kick_speed(view), zero), has_ball, memory)
        to_mouth = self._velocity_to_ball(to_x, to_y)
        near = has_ball | (_is_loose(view, distance) & ~coming[0])
        v_x, v_y = (np.where(near, *each) for each in zip(to_mouth, (v_x, v_y), strict=True))
        # A dribbler holds a ball better where it does not have to pull it around.
        around = np.where(has_ball, PIVOT * angular_velocity, zero)
        v_x, v_y = v_x + around * to_y, v_y - around * to_x
        return self._control.actions(ego, v_x, v_y, angular_velocity, kick)

    def _velocity_to_ball(self, x: Floats, y: Floats) -> XY:
        """Velocity (m/s) of a robot up to a ball, so that its dribbler touches it."""
        distance = norm(x, y)
        gap = np.maximum(distance - self._control.mouth_distance, np.float32(0.0)) + PRESS
        scale = np.minimum(TOUCHING_GAIN * gap, TOUCHING_SPEED) * reciprocal(distance)
        return x * scale, y * scale

    def _kick_on(self, asked: Floats, has_ball: Mask, memory: Memory) -> Floats:
        """The kick that has begun, for as long as the robot has the ball; else the one asked."""
        kick, steps = memory["kick"], memory["steps"]
        steps -= 1
        over = ~has_ball | (kick == 0.0) | (steps <= 0)
        kick[over], steps[over] = asked[over], self._kick_steps
        return kick.copy()

    def _kick_speed(self, view: View) -> Floats:
        """Kick speed (m/s) of a robot that is ready to pass; 0 for others."""
        ego, ball, teammate = view.ego, view.ball, view.teammates
        other_x, other_y = _teammate(view)
        x, y = other_x - ball.position[..., 0], other_y - ball.position[..., 1]
        cos, sin = motion.heading_error(ego, x, y)
        length = norm(x, y)
        ready = (
            (cos > 0.0)
            & (np.abs(sin) * length < MAX_AIM_OFFSET)
            & (np.abs(ego.angular_velocity) < MAX_KICK_ANGULAR_VELOCITY)
        )
        # A ball that still moves has not been received yet.
        ball_speed = norm(ball.velocity[..., 0], ball.velocity[..., 1])
        ready &= (ego.infrared > 0.5) & (ball_speed < MIN_BALL_SPEED)
        receiver_velocity = teammate.velocity[:, :, 0]
        receiver_speed = norm(receiver_velocity[..., 0], receiver_velocity[..., 1])
        ready &= (receiver_speed < MAX_RECEIVER_SPEED) & (teammate.absent[:, :, 0] == 0.0)
        distance = np.maximum(length - self._control.mouth_distance, np.float32(0.0))
        extra = LONG_PASS_GAIN * np.maximum(distance - LONG_PASS, np.float32(0.0))
        arrival = ARRIVAL_SPEED + extra
        speed = self._pass_speed.kick(distance, arrival)
        return np.where(ready, speed, np.float32(0.0))

    def _receiving_velocity(
        self, view: View, distance: Floats, line: tuple[Mask, Floats, Floats]
    ) -> XY:
        """Velocity (m/s) onto the line of a coming ball, or to a place to wait for one.

        `distance` is that of the ball, m, and `line` what `point_on_ball_line` returns.
        """
        position, ball = view.ego.position, view.ball
        coming, x, y = line
        coming = coming & _is_released(view)
        u_x, u_y, is_slow = self._slow_ball(view, distance)
        # The robot's center, with the ball at its mouth.
        mouth = self._control.mouth_distance
        x = np.where(is_slow, ball.position[..., 0] + mouth * u_x, x)
        y = np.where(is_slow, ball.position[..., 1] + mouth * u_y, y)
        line_x, line_y = motion.velocity_to(position, x, y, MAX_SPEED)
        # Toward the ball at last, so that it does not come to rest before the mouth.
        close = np.where(distance < CLOSING_DISTANCE, CLOSING_SPEED, np.float32(0.0))
        wait_x, wait_y = self._waiting_velocity(view)
        return (
            np.where(coming, line_x - close * u_x, wait_x),
            np.where(coming, line_y - close * u_y, wait_y),
        )

    def _waiting_velocity(self, view: View) -> XY:
        """Velocity (m/s) to a place at a good distance from the teammate, inside the region."""
        position, (other_x, other_y) = view.ego.position, _teammate(view)
        from_x, from_y = position[..., 0] - other_x, position[..., 1] - other_y
        distance = norm(from_x, from_y)
        scale = np.clip(distance, *DISTANCES) * reciprocal(distance)
        x, y = self._region.clamp(other_x + from_x * scale, other_y + from_y * scale)
        is_absent = view.teammates.absent[:, :, 0] > 0.5
        x, y = np.where(is_absent, position[..., 0], x), np.where(is_absent, position[..., 1], y)
        return motion.velocity_to(position, x, y, WAITING_SPEED)

    def _slow_ball(self, view: View, distance: Floats) -> tuple[Floats, Floats, Mask]:
        """Direction of the ball, and whether it arrives below `MEETING_SPEED` at each robot.

        Drag and sliding are left out: the receiver sees in time that the ball is slower.
        """
        velocity = view.ball.velocity
        speed = norm(velocity[..., 0], velocity[..., 1])
        scale = reciprocal(speed, MIN_BALL_SPEED)
        lost = np.float32(2.0) * self._rolling.deceleration * distance
        is_slow: Mask = speed * speed < lost + MEETING_SPEED * MEETING_SPEED
        return velocity[..., 0] * scale, velocity[..., 1] * scale, is_slow


def _is_loose(view: View, distance: Floats) -> Mask:
    """(n, robots) whether a slow ball is near, and no other robot nearer to it."""
    speed = norm(*(view.ball.velocity[..., i] for i in (0, 1)))
    loose: Mask = (distance < NEAR) & (speed < LOOSE_SPEED)
    return loose & (_distance_from_ball(view, slice(None)) >= distance)


def _is_released(view: View) -> Mask:
    """(n, robots) whether the ball has left all teammates; what one of them carries rolls, too."""
    released: Mask = _distance_from_ball(view, slice(view.n_teammates)) > RELEASED
    return released


def _distance_from_ball(view: View, others: slice) -> Floats:
    """Distance (m) of the ball from the nearest of some other robots, (n, robots)."""
    x, y = other_robots(view, others)
    ball = view.ball.position[..., None]
    distances: Floats = norm(x - ball[..., 0, :], y - ball[..., 1, :])
    nearest: Floats = distances.min(axis=-1)
    return nearest


def _teammate(view: View) -> XY:
    """Position (m) of the first teammate, (n, robots) each; far away if it is absent."""
    x, y = teammate_positions(view)
    return x[..., 0], y[..., 0]
