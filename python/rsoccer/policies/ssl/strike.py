"""The `strike` policy: get the ball and shoot it past other robots into the goal."""

from typing import Final

import numpy as np

from rsoccer._core import Field
from rsoccer.arrays import Floats, Mask
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.geometry import team_from_ball
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.path_planning import (
    Obstacles,
    next_waypoint,
    other_robots,
    segment_distance,
)
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.policies.ssl.steal import steal_ball
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import XY, norm, reciprocal
from rsoccer.view import View

MAX_SPEED: Final = 1.5  # m/s
DRIBBLE_SPEED: Final = 0.8  # m/s, with the ball on the dribbler
MAX_ANGULAR_VELOCITY: Final = 4.0  # rad/s, with the ball on the dribbler
MAX_AIM_SINE: Final = np.float32(0.01)  # sine of the heading error for a kick
MAX_KICK_ANGULAR_VELOCITY: Final = np.float32(0.2)  # rad/s of the robot for a kick
MAX_KICK_SPEED: Final = np.float32(0.1)  # m/s, speed of the robot for a kick
DRIBBLE_MARGIN: Final = 0.1  # m to the field's lines with the ball, so that the ball stays inside
LINE_MARGIN: Final = 0.02  # m to the field's lines where it steals the ball or waits
AREA_MARGIN: Final = 0.05  # m to the opponents' goal area
TURNING_CLEARANCE: Final = np.float32(0.23)  # m to other robots at which it can turn with the ball
POST_MARGIN: Final = 0.08  # m between shots and the posts
SHOT_CLEARANCE: Final = np.float32(0.03)  # m between the ball of a shot and other robots
ENOUGH_CLEARANCE: Final = np.float32(0.15)  # m from robots beyond which more is no better
SPOT_MARGIN: Final = np.float32(0.02)  # m more clearance for a shooting position to drive to
BLOCKED_COST: Final = np.float32(10.0)  # m of path for a shooting position without a free shot
WAITING_DISTANCE: Final = np.float32(0.7)  # m from the ball where teammates wait

AIM_POINTS: Final = 9  # points in the goal to shoot at
SHOT_GRID: Final = (8, 11)  # shooting positions along x and y


class Strike(Policy):
    """A script that gets the ball, dribbles to a position with a free shot, and shoots.

    It steals the ball from an opponent that holds it. Only the team's nearest robot goes to the
    ball; its teammates keep their distance.
    """

    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task.
        """
        super().__init__(task)
        ssl_task = require_ssl("strike", task)
        self._control = RobotControl(ssl_task)
        field = task.config.field
        self._goal_x = np.float32(field.half_length)
        half_goal = field.goal_width / 2 - POST_MARGIN
        self._aim_y = np.linspace(-half_goal, half_goal, AIM_POINTS).astype(np.float32)
        self._half_only = ssl_task.half_only
        self._dribble_region = self._region_of(field, DRIBBLE_MARGIN, AREA_MARGIN)
        self._outer_region = self._region_of(field, LINE_MARGIN, LINE_MARGIN)
        max_y = field.half_width - LINE_MARGIN
        max_x = field.half_length - field.goal_area_depth - DRIBBLE_MARGIN - AREA_MARGIN
        x = np.linspace(0.3, max_x, SHOT_GRID[0])
        y = np.linspace(-max_y + 0.3, max_y - 0.3, SHOT_GRID[1])
        self._shot_x, self._shot_y = (part.ravel().astype(np.float32) for part in np.meshgrid(x, y))

    def _region_of(self, field: Field, line_margin: float, area_margin: float) -> Region:
        """Allowed positions; margins to the field's lines and the opponents' goal area in m."""
        if not self._half_only:
            return Region.of_field(field, line_margin)
        high = field.half_length - line_margin, field.half_width - line_margin
        return Region((line_margin, -high[1]), high).exclude_goal_area(field, area_margin)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("strike")
        goes = _nearest_of_team(view)
        has_ball = self._control.has_ball(view)
        # Of a ball between two mouths the opponent's beam tells whether it has still to be stolen.
        in_mouth = self._control.opponents_have_ball(view) & ~has_ball[..., None]
        held = in_mouth | (view.opponents.infrared > np.float32(0.5))
        steals = goes & held.any(axis=-1)  # none without opponents
        shoots = goes & ~steals & has_ball
        approaches = goes & ~steals & ~shoots
        actions = np.zeros((*inputs.action_shape[:2], 5), np.float32)
        for mask, behavior in (
            (approaches, self._approach),
            (steals, self._steal),
            (shoots, self._shoot),
            (~goes, self._wait),
        ):
            worlds = np.flatnonzero(mask.any(axis=1))
            if len(worlds):
                part = behavior(view.take(worlds))
                actions[worlds] = np.where(mask[worlds][..., None], part, actions[worlds])
        return actions

    def _approach(self, view: View) -> Floats:
        """Go to the ball."""
        ball = view.ball.position, view.ball.velocity
        robots, region = other_robots(view), self._dribble_region
        velocity = approach_ball(self._control, view.ego, ball, robots, region, MAX_SPEED)
        return self._control.actions(view.ego, *velocity)

    def _steal(self, view: View) -> Floats:
        """Steal the ball from an opponent."""
        robots = other_robots(view)
        velocity = steal_ball(self._control, view, robots, self._outer_region, MAX_SPEED)
        return self._control.actions(view.ego, *velocity)

    def _wait(self, view: View) -> Floats:
        """Keep the distance from the ball and face it."""
        ego, ball = view.ego, view.ball.position
        x, y = ego.position[..., 0] - ball[..., 0], ego.position[..., 1] - ball[..., 1]
        scale = np.maximum(WAITING_DISTANCE * reciprocal(norm(x, y)), np.float32(1.0))
        target = self._outer_region.clamp(ball[..., 0] + x * scale, ball[..., 1] + y * scale)
        v_x, v_y = motion.velocity_to(ego.position, *target, MAX_SPEED)
        angular_velocity = motion.angular_velocity_to(ego, -x, -y, MAX_ANGULAR_VELOCITY)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _shoot(self, view: View) -> Floats:
        """Turn and kick where a shot is free, else dribble to a position with a free shot."""
        ego, robots = view.ego, other_robots(view)
        x, y = ego.position[..., 0], ego.position[..., 1]
        aim_y, free = (part[..., 0] for part in self._best_aim(x[..., None], y[..., None], robots))
        gaps = norm(robots[0] - x[..., None], robots[1] - y[..., None]).min(axis=-1)
        aims = (free > SHOT_CLEARANCE) & (gaps > TURNING_CLEARANCE)
        aims &= self._dribble_region.distance_outside(x, y) < np.float32(AREA_MARGIN)
        goal_x, goal_y = self._goal_x - x, aim_y - y
        angular_velocity = motion.angular_velocity_to(ego, goal_x, goal_y, MAX_ANGULAR_VELOCITY)
        cos, sin = motion.heading_error(ego, goal_x, goal_y)
        kicks = aims & (cos > 0.0) & (np.abs(sin) < MAX_AIM_SINE)
        kicks &= np.abs(ego.angular_velocity) < MAX_KICK_ANGULAR_VELOCITY
        kicks &= norm(ego.velocity[..., 0], ego.velocity[..., 1]) < MAX_KICK_SPEED
        zero = np.float32(0.0)
        v_x, v_y = (np.where(aims, zero, v) for v in self._dribble(ego.position, robots))
        kick = np.where(kicks, self._control.max_kick_speed, zero)
        velocity = self._control.limit_acceleration(
            ego, v_x, v_y, np.where(aims, angular_velocity, zero)
        )
        return self._control.actions(ego, *velocity, kick)

    def _best_aim(self, x: Floats, y: Floats, robots: XY) -> tuple[Floats, Floats]:
        """Best aim points of shots from x, y (n, robots, positions), and their clearance (m).

        The clearance is the least distance between the surfaces of the ball and other robots.
        """
        start = x[..., None], y[..., None]
        shape = (*x.shape, AIM_POINTS)
        end = np.broadcast_to(self._goal_x, shape), np.broadcast_to(self._aim_y, shape)
        robot_x, robot_y = (part[:, :, None, None] for part in robots)
        distance = segment_distance(start, end, robot_x, robot_y).min(axis=-1)
        clearance = distance - self._control.ball_distance
        best = np.argmax(np.minimum(clearance, ENOUGH_CLEARANCE), axis=-1)[..., None]
        return self._aim_y[best[..., 0]], np.take_along_axis(clearance, best, -1)[..., 0]

    def _dribble(self, position: Floats, robots: XY) -> XY:
        """Velocity (m/s) to the nearest shooting position with a free shot."""
        shape = (*position.shape[:2], len(self._shot_x))
        x, y = np.broadcast_to(self._shot_x, shape), np.broadcast_to(self._shot_y, shape)
        _, free = self._best_aim(x, y, robots)
        gaps = norm(robots[0][:, :, None] - x[..., None], robots[1][:, :, None] - y[..., None]).min(
            axis=-1
        )
        good = free > SHOT_CLEARANCE + SPOT_MARGIN
        good &= gaps > TURNING_CLEARANCE + SPOT_MARGIN
        path = norm(x - position[..., 0, None], y - position[..., 1, None])
        best = np.argmin(path + np.where(good, np.float32(0.0), BLOCKED_COST), axis=-1)
        obstacles = Obstacles(*robots, np.broadcast_to(TURNING_CLEARANCE, robots[0].shape))
        target = self._shot_x[best], self._shot_y[best]
        next_x, next_y, remaining = next_waypoint(position, target, obstacles, self._dribble_region)
        return motion.velocity_to(position, next_x, next_y, DRIBBLE_SPEED, remaining)


def _nearest_of_team(view: View) -> Mask:
    """Whether a robot is its team's nearest to the ball, (n, robots)."""
    _, _, distance = team_from_ball(view)
    nearest: Mask = np.equal(distance[:, :, 0], distance.min(axis=2))
    return nearest
