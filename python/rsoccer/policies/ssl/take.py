"""The `take` policy: a team takes the ball from the other one."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.geometry import team_from_ball
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.interception import point_on_ball_line
from rsoccer.policies.ssl.path_planning import opponent_positions, other_robots
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import norm
from rsoccer.view import View

MAX_SPEED: Final = 2.0  # m/s, at skill 1
SLOWEST: Final = 0.25  # share of the speed at skill 0
MAX_ANGULAR_VELOCITY: Final = 10.0  # rad/s
LINE_MARGIN: Final = 0.1  # m between the robot's center and the field's lines
BLOCKED_SHARE: Final = np.float32(0.5)  # of the way from the ball to an opponent, for a block


class Take(Policy):
    """A script whose robot nearest to the ball goes for it, while the others block passes.

    Each of the others stands between the ball and an opponent without it, a different one.
    """

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task, skill: float = 1.0) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task.
            skill: 0 to 1; faster robots.

        Raises:
            ValueError: another task, or a skill out of range.
        """
        super().__init__(task)
        self._control = RobotControl(require_ssl("take", task))
        if not 0.0 <= skill <= 1.0:
            raise ValueError(f"take: expected a skill from 0 to 1, got {skill}")
        self._max_speed = MAX_SPEED * (SLOWEST + (1.0 - SLOWEST) * skill)
        self._region = Region.of_field(task.config.field, LINE_MARGIN)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("take")
        rank = _rank(view)
        actions = self._go(view)
        others = rank > 0
        if others.any():
            actions = np.where(others[..., None], self._block(view, rank), actions)
        return actions

    def _go(self, view: View) -> Floats:
        """Go to the ball: onto the line of a fast one, and into a slow or held one."""
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        coming, x, y = point_on_ball_line(view)
        line_x, line_y = motion.velocity_to(ego.position, x, y, self._max_speed)
        v_x, v_y, _ = approach_ball(
            self._control,
            ego,
            (ball.position, ball.velocity),
            other_robots(view),
            self._region,
            self._max_speed,
        )
        v_x, v_y = np.where(coming, line_x, v_x), np.where(coming, line_y, v_y)
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _block(self, view: View, rank: Floats) -> Floats:
        """Stand between the ball and an opponent without it."""
        ego, ball = view.ego, view.ball.position
        opponent_x, opponent_y = opponent_positions(view)
        from_ball = norm(opponent_x - ball[..., 0, None], opponent_y - ball[..., 1, None])
        # The opponent nearest to the ball has it or gets it; the second one is blocked first.
        order = np.argsort(from_ball, axis=-1, kind="stable")
        nth = np.minimum(rank, order.shape[2] - 1).astype(np.intp)[..., None]
        chosen = np.take_along_axis(order, nth, -1)
        x = np.take_along_axis(opponent_x, chosen, -1)[..., 0]
        y = np.take_along_axis(opponent_y, chosen, -1)[..., 0]
        x = ball[..., 0] + BLOCKED_SHARE * (x - ball[..., 0])
        y = ball[..., 1] + BLOCKED_SHARE * (y - ball[..., 1])
        x, y = self._region.clamp(x, y)
        v_x, v_y = motion.velocity_to(ego.position, x, y, self._max_speed)
        v_x, v_y = motion.limit_speed_near_robots(
            ego.position,
            (v_x, v_y),
            other_robots(view),
            self._control.robot_diameter,
            self._max_speed,
        )
        to_x, to_y = (ball[..., i] - ego.position[..., i] for i in (0, 1))
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)


def _rank(view: View) -> Floats:
    """Number of teammates that are nearer to the ball, (n, robots)."""
    _, _, distance = team_from_ball(view)
    nearer: Floats = (distance[:, :, 1:] < distance[:, :, :1]).sum(axis=2)
    return nearer
