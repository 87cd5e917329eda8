"""The `keep` policy: a team keeps the ball by passes."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.geometry import team_from_ball
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.interception import point_on_ball_line
from rsoccer.policies.ssl.pass_lines import PassSpeed, openness
from rsoccer.policies.ssl.path_planning import (
    opponent_positions,
    other_robots,
    teammate_positions,
)
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks.ssl_keepaway import SslKeepaway
from rsoccer.vectors import FAR, XY, norm, reciprocal
from rsoccer.view import View

ARRIVAL_SPEED: Final = np.float32(3.2)  # m/s of a pass on arrival: receivers give way to it
LEAD_SECONDS: Final = np.float32(0.25)  # s that a running teammate is led by
MAX_ANGULAR_VELOCITY: Final = 6.0  # rad/s, with the ball on the dribbler
MAX_AIM_ERROR: Final = np.float32(0.15)  # m beside the teammate for a kick
MAX_KICK_ANGULAR_VELOCITY: Final = np.float32(0.5)  # rad/s of the robot for a kick
RECEIVING_DISTANCE: Final = np.float32(0.6)  # m to a coming ball at which a receiver gives way
RECEIVING_SHARE: Final = np.float32(0.3)  # of the ball's velocity with which it does
MIN_PASS: Final = np.float32(0.9)  # m; shorter passes are avoided
PREFERRED_PASS: Final = np.float32(2.5)  # m; waiting teammates keep about this distance
FACING_VALUE: Final = np.float32(0.3)  # m of openness, for a pass straight ahead
ESCAPE_DISTANCE: Final = np.float32(1.0)  # m to an opponent from which it is driven away from
ESCAPE_SPEED: Final = np.float32(0.8)  # m/s, with the ball on the dribbler
MIN_OPENNESS: Final = np.float32(0.0)  # m of openness for a kick
OPEN_ENOUGH: Final = np.float32(0.5)  # m of openness beyond which more is no better
AIMED_COSINE: Final = np.float32(0.94)  # of a passer's heading error from which a robot waits
LINE_MARGIN: Final = 0.35  # m between the robot's center and the border
MAX_SPEED: Final = 2.0  # m/s
GRID: Final = 7  # waiting positions along each side of the area
TEAMMATE_SPACING: Final = np.float32(2.0)  # m to other teammates


class Keep(Policy):
    """A script that passes to the most open teammate, and without the ball gets open for a pass.

    In `SslKeepaway` it stays in the area, elsewhere in the field. One robot goes to a free ball.
    """

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task in which a team has at least two robots.

        Raises:
            ValueError: another task, or one without teammates.
        """
        super().__init__(task)
        self._control = RobotControl(require_ssl("keep", task))
        if max(task.n_blue, task.n_yellow) < 2:
            raise ValueError(f"task: keep needs a teammate, got {task.name}")
        self._region = _region_of(task)
        self._pass_speed = PassSpeed(task.config.ball)
        x = np.linspace(self._region.low[0], self._region.high[0], GRID)
        y = np.linspace(self._region.low[1], self._region.high[1], GRID)
        self._wait_x, self._wait_y = (part.ravel().astype(np.float32) for part in np.meshgrid(x, y))

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("keep")
        has_ball = self._control.has_ball(view)
        goes = ~has_ball & self._goes_to_ball(view)
        actions = np.zeros((*inputs.action_shape[:2], 5), np.float32)
        for mask, behavior in (
            (has_ball, self._pass),
            (goes, self._fetch),
            (~has_ball & ~goes, self._wait),
        ):
            worlds = np.flatnonzero(mask.any(axis=1))
            if len(worlds):
                part = behavior(view.take(worlds))
                actions[worlds] = np.where(mask[worlds][..., None], part, actions[worlds])
        return actions

    def _pass(self, view: View) -> Floats:
        """Turn to the most open teammate, and kick."""
        ego, ball, teammates = view.ego, view.ball.position, view.teammates
        teammate_x, teammate_y = teammate_positions(view)
        lead_x, lead_y = (teammates.velocity[..., i] * LEAD_SECONDS for i in (0, 1))
        end = self._region.clamp(teammate_x + lead_x, teammate_y + lead_y)
        end = np.where(teammate_x < FAR, end[0], FAR), np.where(teammate_x < FAR, end[1], FAR)
        start = ball[..., 0, None], ball[..., 1, None]
        gap = openness(start, end, opponent_positions(view))
        length = norm(end[0] - start[0], end[1] - start[1])
        value = np.minimum(gap, OPEN_ENOUGH) - np.maximum(MIN_PASS - length, np.float32(0.0))
        # The cost of turning also keeps the robot from wavering between two teammates.
        heading = ego.heading[:, :, None]
        ahead = (end[0] - start[0]) * heading[..., 0] + (end[1] - start[1]) * heading[..., 1]
        value = value + FACING_VALUE * ahead * reciprocal(length)
        value = np.where(teammate_x < FAR, value, -FAR)
        best = np.argmax(value, axis=-1)[..., None]
        x, y = (np.take_along_axis(part, best, -1)[..., 0] for part in end)
        distance = np.take_along_axis(length, best, -1)[..., 0]
        to_x, to_y = x - ball[..., 0], y - ball[..., 1]
        cos, sin = motion.heading_error(ego, to_x, to_y)
        ready = (cos > 0.0) & (np.abs(sin) * distance < MAX_AIM_ERROR) & (ego.infrared > 0.5)
        ready &= np.abs(ego.angular_velocity) < MAX_KICK_ANGULAR_VELOCITY
        ready &= np.take_along_axis(gap, best, -1)[..., 0] > MIN_OPENNESS
        way = np.maximum(distance - self._control.mouth_distance, np.float32(0.0))
        kick = np.where(
            ready, self._pass_speed.kick(way, np.full_like(way, ARRIVAL_SPEED)), np.float32(0.0)
        )
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)
        v_x, v_y = self._escape(view)
        velocity = self._control.limit_acceleration(ego, v_x, v_y, angular_velocity)
        return self._control.actions(ego, *velocity, kick)

    def _escape(self, view: View) -> XY:
        """Velocity (m/s) with the ball, away from the nearest opponent if it is near."""
        position = view.ego.position
        x, y = (position[..., i, None] - part for i, part in enumerate(opponent_positions(view)))
        distance = norm(x, y)
        nearest = np.argmin(distance, axis=-1)[..., None]
        x, y, distance = (
            np.take_along_axis(part, nearest, -1)[..., 0] for part in (x, y, distance)
        )
        scale = reciprocal(distance)
        x = position[..., 0] + np.multiply(x, scale)
        y = position[..., 1] + np.multiply(y, scale)
        target = self._region.clamp(x, y)
        speed = np.where(distance < ESCAPE_DISTANCE, ESCAPE_SPEED, np.float32(0.0))
        return motion.velocity_to(position, *target, speed)

    def _fetch(self, view: View) -> Floats:
        """Go to a free ball: onto the line of a fast one, and into a slow one."""
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        coming, x, y = point_on_ball_line(view)
        x, y = self._region.clamp(x, y)
        line_x, line_y = motion.velocity_to(ego.position, x, y, MAX_SPEED)
        v_x, v_y, _ = approach_ball(
            self._control,
            ego,
            (ball.position, ball.velocity),
            other_robots(view),
            self._region,
            MAX_SPEED,
        )
        # A receiver that gives way to the ball stops faster passes.
        near = coming & (norm(to_x, to_y) < RECEIVING_DISTANCE)
        back = np.where(near, RECEIVING_SHARE, np.float32(0.0))
        line_x, line_y = (
            line_x + np.multiply(back, ball.velocity[..., 0]),
            line_y + np.multiply(back, ball.velocity[..., 1]),
        )
        v_x, v_y = np.where(coming, line_x, v_x), np.where(coming, line_y, v_y)
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _wait(self, view: View) -> Floats:
        """Get open for a pass, and face the ball."""
        ego, ball = view.ego, view.ball.position
        to_x, to_y = (ball[..., i] - ego.position[..., i] for i in (0, 1))
        shape = (*to_x.shape, len(self._wait_x))
        end = np.broadcast_to(self._wait_x, shape), np.broadcast_to(self._wait_y, shape)
        start = ball[..., 0, None], ball[..., 1, None]
        value = np.minimum(openness(start, end, opponent_positions(view)), OPEN_ENOUGH)
        length = norm(end[0] - start[0], end[1] - start[1])
        value = value - np.float32(0.3) * np.abs(length - PREFERRED_PASS)
        teammate_x, teammate_y = teammate_positions(view)
        gap = norm(
            end[0][..., None] - teammate_x[:, :, None], end[1][..., None] - teammate_y[:, :, None]
        )
        crowding = np.maximum(TEAMMATE_SPACING - gap.min(axis=-1), np.float32(0.0))
        way = norm(end[0] - ego.position[..., 0, None], end[1] - ego.position[..., 1, None])
        best = np.argmax(value - crowding - np.float32(0.15) * way, axis=-1)
        v_x, v_y = motion.velocity_to(
            ego.position, self._wait_x[best], self._wait_y[best], MAX_SPEED
        )
        v_x, v_y = motion.limit_speed_near_robots(
            ego.position, (v_x, v_y), other_robots(view), self._control.robot_diameter, MAX_SPEED
        )
        stays = _is_aimed_at(view)  # a standing teammate is easier to aim at
        v_x, v_y = np.where(stays, np.float32(0.0), v_x), np.where(stays, np.float32(0.0), v_y)
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _goes_to_ball(self, view: View) -> Mask:
        """Whether a robot is the one of its team that goes to the ball, (n, robots)."""
        ball = view.ball
        x, y, distance = team_from_ball(view)
        speed = norm(ball.velocity[..., 0], ball.velocity[..., 1])[..., None]
        scale = reciprocal(speed, np.float32(0.3))
        u_x, u_y = ball.velocity[..., 0, None] * scale, ball.velocity[..., 1, None] * scale
        ahead, left = x * u_x + y * u_y, y * u_x - x * u_y
        # Of a rolling ball the robot that is nearest to its line ahead; the passer is behind it.
        cost = np.where(ahead > 0.0, np.abs(left) + np.float32(0.1) * ahead, distance + speed)
        cost = np.where(speed > np.float32(0.5), cost, distance)
        goes: Mask = np.equal(cost[:, :, 0], cost.min(axis=2))
        return goes


def _region_of(task: Task) -> Region:
    """Allowed positions: those in the area of a keepaway task, or in the field."""
    if not isinstance(task, SslKeepaway):
        return Region.of_field(task.config.field, LINE_MARGIN)
    x, y = (max(float(half) - LINE_MARGIN, 0.1) for half in task.half_area)
    return Region((-x, -y), (x, y))


def _is_aimed_at(view: View) -> Mask:
    """Whether a teammate with the ball faces each robot, (n, robots)."""
    ego, teammates = view.ego.position, view.teammates
    x, y = (ego[..., i, None] - teammates.position[..., i] for i in (0, 1))
    ahead = x * teammates.heading[..., 0] + y * teammates.heading[..., 1]
    faces = ahead > AIMED_COSINE * norm(x, y)
    aimed: Mask = np.any(faces & (teammates.infrared > 0.5), axis=-1)
    return aimed
