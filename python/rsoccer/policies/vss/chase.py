"""The `chase` policy: get behind the ball, then push it at the goal."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.geometry import team_from_ball
from rsoccer.policies.vss import drive_control
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import XY, norm, reciprocal, rotate_into, rotate_into_body, unit
from rsoccer.view import View

RUN_UP: Final = np.float32(0.15)  # m behind the ball where a run at it starts
BALL_CLEARANCE: Final = np.float32(0.13)  # m beside the ball on the way to the run-up
FOLLOW_THROUGH: Final = np.float32(0.15)  # m beyond the robot, on the push line, that a run aims at
ALIGNMENT: Final = np.float32(0.45)  # m beside the push line, per m behind the ball, to start a run
TURN_GAIN: Final = np.float32(0.8)  # wheel speed of a turn, per sine of the heading error
TEAMMATE_DISTANCE: Final = np.float32(0.4)  # m from the ball that teammates keep
SLOWING_DISTANCE: Final = np.float32(0.02)  # m from the target within which it slows down


class Chase(Policy):
    """A script for differential drives: the team's nearest robot chases the ball.

    Its teammates keep their distance from the ball. Robots drive backwards as well as forwards.
    They do not avoid other robots; a robot that is stuck backs off in a random curve.
    """

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: a task whose robots have a differential drive.
        """
        super().__init__(task)
        drive_control.require_differential_drive("chase", task)
        robot = task.config.robot
        self._field = FieldGeometry(task.config)
        self._damping = drive_control.turn_damping(robot)
        self._min_speed = drive_control.SLOW_SHARE * np.float32(robot.top_speed)

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """Return `slow_steps` (n, robots), the counters of `back_off`."""
        return {"slow_steps": np.zeros(shape[:2], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return the normalized wheel speeds, (n, robots, 2)."""
        view = inputs.required_view("chase")
        ego, ball = view.ego, view.ball.position
        x, y = self._target(ball, ego.position)
        x, y = x - ego.position[..., 0], y - ego.position[..., 1]
        chases, away_x, away_y = _chaser(view)
        x, y = np.where(chases, x, away_x), np.where(chases, y, away_y)
        ahead, left = rotate_into_body(x, y, ego.heading)
        scale = reciprocal(norm(x, y), SLOWING_DISTANCE)
        forward, turn = ahead * scale, left * scale * np.sign(ahead) * TURN_GAIN
        turn = turn - ego.angular_velocity * self._damping
        # Slow steps count for all robots, but a teammate that keeps its distance need not push.
        all_robots = np.ones_like(chases)
        slow_steps = memory["slow_steps"]
        stuck = drive_control.back_off(ego.velocity, self._min_speed, all_robots, slow_steps)
        backing = stuck & chases
        forward = np.where(backing, -forward, forward)
        turn = np.where(backing, rng.uniform(-1.0, 1.0, inputs.action_shape[1:2]), turn)
        return drive_control.wheel_speeds(forward, turn)

    def _target(self, ball: Floats, position: Floats) -> XY:
        """Position to drive at, m: the run-up, or beyond the ball on a run."""
        ball_x, ball_y = ball[..., 0], ball[..., 1]
        u_x, u_y = self._push_direction(ball_x, ball_y)  # (-u_y, u_x) is to its left
        x, y = position[..., 0] - ball_x, position[..., 1] - ball_y
        ahead, left = rotate_into(x, y, u_x, u_y)
        behind = -ahead
        runs = (behind > 0.0) & (np.abs(left) < ALIGNMENT * behind)
        beside = behind < np.float32(0.5) * RUN_UP
        along = np.where(runs, FOLLOW_THROUGH - behind, -RUN_UP)
        across = np.where(beside & ~runs, np.copysign(BALL_CLEARANCE, left), np.float32(0.0))
        target_x = ball_x + along * u_x - across * u_y
        target_y = ball_y + along * u_y + across * u_x
        max_x, max_y = self._field.max_x, self._field.max_y
        inside_x = np.minimum(np.maximum(target_x, -max_x), max_x)
        inside_y = np.minimum(np.maximum(target_y, -max_y), max_y)
        return np.where(runs, target_x, inside_x), np.where(runs, target_y, inside_y)

    def _push_direction(self, ball_x: Floats, ball_y: Floats) -> XY:
        """Direction in which to push the ball: at the goal, or along a wall at the ball."""
        x, y = self._field.half_length - ball_x, -ball_y
        side, end = self._field.at_walls(ball_x, ball_y)
        y = np.where(side, np.float32(0.0), y)
        y = np.where(end, np.copysign(y, -ball_y * ball_x), y)
        x = np.where(end & ~side, np.float32(0.0), x)
        return unit(x, y)


def _chaser(view: View) -> tuple[Mask, Floats, Floats]:
    """Whether a robot is its team's nearest to the ball, and the path of one that is not.

    The path (x and y, m) leads straight away from the ball, until the robot is far enough.
    """
    x, y, distance = team_from_ball(view)
    ego_distance = distance[:, :, 0]
    scale = np.maximum(TEAMMATE_DISTANCE - ego_distance, np.float32(0.0))
    scale = scale * reciprocal(ego_distance, SLOWING_DISTANCE)
    return ego_distance == distance.min(axis=2), x[:, :, 0] * scale, y[:, :, 0] * scale
