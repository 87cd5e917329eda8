"""The `keep` policy: a team keeps the ball by passes."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.policies.base import Memory, Observes, PolicyInput
from rsoccer.policies.geometry import team_from_ball
from rsoccer.policies.ssl import motion
from rsoccer.policies.ssl.approach import approach_ball
from rsoccer.policies.ssl.interception import point_on_ball_line
from rsoccer.policies.ssl.pass_lines import REACH_PER_METER, PassSpeed, openness
from rsoccer.policies.ssl.path_planning import (
    opponent_positions,
    other_robots,
    teammate_positions,
)
from rsoccer.policies.ssl.region import Region
from rsoccer.policies.ssl.robot_control import RobotControl, require_ssl
from rsoccer.policies.tactics import Tactic, TacticalPolicy, checked, rows_of
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks.ssl_keepaway import SslKeepaway
from rsoccer.vectors import FAR, XY, norm, reciprocal
from rsoccer.view import View

MIN_OPENNESS: Final = np.float32(0.0)  # m of openness for a kick
LINE_MARGIN: Final = 0.35  # m between the robot's center and the border
GRID: Final = 7  # waiting positions along each side of the area


class _Numbers(NamedTuple):
    """Tactics of matches, (n, 1) each, or (1, 1) if they are the same in all."""

    arrival_speed: Floats
    """m/s of a pass on arrival: receivers give way to it"""
    lead_seconds: Floats
    """s that a running teammate is led by"""
    angular_velocity: Floats
    """rad/s, with the ball on the dribbler"""
    aim_error: Floats
    """m beside the teammate for a kick"""
    kick_angular_velocity: Floats
    """rad/s of the robot for a kick"""
    receiving_distance: Floats
    """m to a coming ball at which a receiver gives way"""
    receiving_share: Floats
    """share of the ball's velocity with which it does"""
    least_pass: Floats
    """m; shorter passes are avoided"""
    preferred_pass: Floats
    """m; waiting teammates keep about this distance"""
    distance_value: Floats
    """m of openness for each m that they are away from it"""
    facing_value: Floats
    """m of openness, for a pass straight ahead"""
    escape_distance: Floats
    """m to an opponent from which it is driven away from"""
    escape_speed: Floats
    """m/s, with the ball on the dribbler"""
    open_enough: Floats
    """m of openness beyond which more is no better"""
    reach: Floats
    """m that opponents come nearer to a pass on each m of its way"""
    aimed_cosine: Floats
    """cosine of a passer's heading error from which a robot waits"""
    speed: Floats
    """m/s"""
    teammate_spacing: Floats
    """m to other teammates"""
    way_value: Floats
    """m of openness for each m of way to a waiting position"""

    @classmethod
    def of(cls, tactics: Floats) -> _Numbers:
        """Return the tactics (n, tactics), or (tactics,) for all matches."""
        rows = np.atleast_2d(tactics)
        return cls(*(rows[:, index, None] for index in range(rows.shape[1])))

    def take(self, worlds: NDArray[np.intp]) -> _Numbers:
        """Return those of some matches."""
        return _Numbers(*(part if len(part) == 1 else part[worlds] for part in self))


_MOST: Final = {"angular_velocity": 10.0, "arrival_speed": 6.0, "speed": 3.0, "aimed_cosine": 1.0}
"""Greatest values where they are less than four times those that were set by hand."""
_DEFAULTS: Final = {
    "arrival_speed": 3.2,
    "lead_seconds": 0.25,
    "angular_velocity": 6.0,
    "aim_error": 0.15,
    "kick_angular_velocity": 0.5,
    "receiving_distance": 0.6,
    "receiving_share": 0.3,
    "least_pass": 0.9,
    "preferred_pass": 2.5,
    "distance_value": 0.3,
    "facing_value": 0.3,
    "escape_distance": 1.0,
    "escape_speed": 0.8,
    "open_enough": 0.5,
    "reach": float(REACH_PER_METER),
    "aimed_cosine": 0.94,
    "speed": 2.0,
    "teammate_spacing": 2.0,
    "way_value": 0.15,
}


class Keep(TacticalPolicy):
    """A script that passes to the most open teammate, and without the ball gets open for a pass.

    In `SslKeepaway` it stays in the area, elsewhere in the field. One robot goes to a free ball.
    """

    TACTICS = tuple(
        Tactic(name, _DEFAULTS[name], _DEFAULTS[name] / 4, _MOST.get(name, 4 * _DEFAULTS[name]))
        for name in _Numbers._fields
    )
    observes: Observes = "view"
    forecasts = True

    def __init__(self, task: Task, *, tactics: ArrayLike | None = None) -> None:
        """Prepare the script for a task.

        Args:
            task: an SSL task in which a team has at least two robots.
            tactics: numbers by which it plays, (tactics,) in the order of `TACTICS`, or
                (n, tactics), one row for each of n matches at once; None for those that were set by
                hand.

        Raises:
            ValueError: another task, one without teammates, or tactics of another shape or out of
                their ranges.
        """
        super().__init__(task)
        numbers = [tactic.default for tactic in self.TACTICS] if tactics is None else tactics
        self._tactics = checked(numbers, self.TACTICS)
        self._control = RobotControl(require_ssl("keep", task))
        if max(task.n_blue, task.n_yellow) < 2:
            raise ValueError(f"task: keep needs a teammate, got {task.name}")
        self._region = _region_of(task)
        self._pass_speed = PassSpeed(task.config.ball)
        x = np.linspace(self._region.low[0], self._region.high[0], GRID)
        y = np.linspace(self._region.low[1], self._region.high[1], GRID)
        self._wait_x, self._wait_y = (part.ravel().astype(np.float32) for part in np.meshgrid(x, y))

    @classmethod
    def with_tactics(cls, task: Task, tactics: Floats) -> Keep:
        """Return the script with other numbers, see `TacticalPolicy.with_tactics`."""
        return cls(task, tactics=tactics)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions, (n, robots, 5)."""
        view = inputs.required_view("keep")
        numbers = self._tactics
        if numbers.ndim > 1:
            numbers = rows_of(numbers, inputs.action_shape[0])
        kept = _Numbers.of(numbers)
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
                part = behavior(view.take(worlds), kept.take(worlds))
                actions[worlds] = np.where(mask[worlds][..., None], part, actions[worlds])
        return actions

    def _pass(self, view: View, kept: _Numbers) -> Floats:
        """Turn to the most open teammate, and kick."""
        ego, ball, teammates = view.ego, view.ball.position, view.teammates
        teammate_x, teammate_y = teammate_positions(view)
        lead_x, lead_y = (teammates.velocity[..., i] * kept.lead_seconds[..., None] for i in (0, 1))
        end = self._region.clamp(teammate_x + lead_x, teammate_y + lead_y)
        end = np.where(teammate_x < FAR, end[0], FAR), np.where(teammate_x < FAR, end[1], FAR)
        start = ball[..., 0, None], ball[..., 1, None]
        gap = openness(start, end, opponent_positions(view), kept.reach[..., None, None])
        length = norm(end[0] - start[0], end[1] - start[1])
        value = np.minimum(gap, kept.open_enough[..., None]) - np.maximum(
            kept.least_pass[..., None] - length, np.float32(0.0)
        )
        # The cost of turning also keeps the robot from wavering between two teammates.
        heading = ego.heading[:, :, None]
        ahead = (end[0] - start[0]) * heading[..., 0] + (end[1] - start[1]) * heading[..., 1]
        value = value + kept.facing_value[..., None] * ahead * reciprocal(length)
        value = np.where(teammate_x < FAR, value, -FAR)
        best = np.argmax(value, axis=-1)[..., None]
        x, y = (np.take_along_axis(part, best, -1)[..., 0] for part in end)
        distance = np.take_along_axis(length, best, -1)[..., 0]
        to_x, to_y = x - ball[..., 0], y - ball[..., 1]
        cos, sin = motion.heading_error(ego, to_x, to_y)
        ready = (cos > 0.0) & (np.abs(sin) * distance < kept.aim_error) & (ego.infrared > 0.5)
        ready &= np.abs(ego.angular_velocity) < kept.kick_angular_velocity
        ready &= np.take_along_axis(gap, best, -1)[..., 0] > MIN_OPENNESS
        way = np.maximum(distance - self._control.mouth_distance, np.float32(0.0))
        kick = np.where(
            ready,
            self._pass_speed.kick(way, np.broadcast_to(kept.arrival_speed, way.shape)),
            np.float32(0.0),
        )
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, kept.angular_velocity)
        v_x, v_y = self._escape(view, kept)
        velocity = self._control.limit_acceleration(ego, v_x, v_y, angular_velocity)
        return self._control.actions(ego, *velocity, kick)

    def _escape(self, view: View, kept: _Numbers) -> XY:
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
        speed = np.where(distance < kept.escape_distance, kept.escape_speed, np.float32(0.0))
        return motion.velocity_to(position, *target, speed)

    def _fetch(self, view: View, kept: _Numbers) -> Floats:
        """Go to a free ball: onto the line of a fast one, and into a slow one."""
        ego, ball = view.ego, view.ball
        to_x, to_y = (ball.position[..., i] - ego.position[..., i] for i in (0, 1))
        coming, x, y = point_on_ball_line(view)
        x, y = self._region.clamp(x, y)
        line_x, line_y = motion.velocity_to(ego.position, x, y, kept.speed)
        v_x, v_y, _ = approach_ball(
            self._control,
            ego,
            (ball.position, ball.velocity),
            other_robots(view),
            self._region,
            kept.speed,
        )
        # A receiver that gives way to the ball stops faster passes.
        near = coming & (norm(to_x, to_y) < kept.receiving_distance)
        back = np.where(near, kept.receiving_share, np.float32(0.0))
        line_x, line_y = (
            line_x + np.multiply(back, ball.velocity[..., 0]),
            line_y + np.multiply(back, ball.velocity[..., 1]),
        )
        v_x, v_y = np.where(coming, line_x, v_x), np.where(coming, line_y, v_y)
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, kept.angular_velocity)
        return self._control.actions(ego, v_x, v_y, angular_velocity)

    def _wait(self, view: View, kept: _Numbers) -> Floats:
        """Get open for a pass, and face the ball."""
        ego, ball = view.ego, view.ball.position
        to_x, to_y = (ball[..., i] - ego.position[..., i] for i in (0, 1))
        shape = (*to_x.shape, len(self._wait_x))
        end = np.broadcast_to(self._wait_x, shape), np.broadcast_to(self._wait_y, shape)
        start = ball[..., 0, None], ball[..., 1, None]
        value = np.minimum(
            openness(start, end, opponent_positions(view), kept.reach[..., None, None]),
            kept.open_enough[..., None],
        )
        length = norm(end[0] - start[0], end[1] - start[1])
        value = value - kept.distance_value[..., None] * np.abs(
            length - kept.preferred_pass[..., None]
        )
        teammate_x, teammate_y = teammate_positions(view)
        gap = norm(
            end[0][..., None] - teammate_x[:, :, None], end[1][..., None] - teammate_y[:, :, None]
        )
        crowding = np.maximum(kept.teammate_spacing[..., None] - gap.min(axis=-1), np.float32(0.0))
        way = norm(end[0] - ego.position[..., 0, None], end[1] - ego.position[..., 1, None])
        best = np.argmax(value - crowding - kept.way_value[..., None] * way, axis=-1)
        v_x, v_y = motion.velocity_to(
            ego.position, self._wait_x[best], self._wait_y[best], kept.speed
        )
        v_x, v_y = motion.limit_speed_near_robots(
            ego.position, (v_x, v_y), other_robots(view), self._control.robot_diameter, kept.speed
        )
        stays = _is_aimed_at(view, kept)  # a standing teammate is easier to aim at
        v_x, v_y = np.where(stays, np.float32(0.0), v_x), np.where(stays, np.float32(0.0), v_y)
        angular_velocity = motion.angular_velocity_to(ego, to_x, to_y, kept.angular_velocity)
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


def _is_aimed_at(view: View, kept: _Numbers) -> Mask:
    """Whether a teammate with the ball faces each robot, (n, robots)."""
    ego, teammates = view.ego.position, view.teammates
    x, y = (ego[..., i, None] - teammates.position[..., i] for i in (0, 1))
    ahead = x * teammates.heading[..., 0] + y * teammates.heading[..., 1]
    faces = ahead > kept.aimed_cosine[..., None] * norm(x, y)
    aimed: Mask = np.any(faces & (teammates.infrared > 0.5), axis=-1)
    return aimed
