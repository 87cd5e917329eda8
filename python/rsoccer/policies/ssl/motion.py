"""How a script drives an SSL robot: to a place, towards a direction, to the ball."""

from typing import Final

import numpy as np

from rsoccer.frame import Floats, Mask, RobotColumns, length
from rsoccer.policies.ssl.hold import DRIBBLER, KICK, TURN_COLUMN, check_ssl
from rsoccer.policies.ssl.paths import Ground, around
from rsoccer.policies.vectors import TINY, inverse
from rsoccer.task import Task
from rsoccer.view import View

BRAKE: Final = np.float32(3.0)  # m/s², by which it slows down before its target
STEER: Final = np.float32(6.0)  # rad/s, per radian that it is off
SOFT: Final = np.float32(8.0)  # m/s, per metre from its target: the last centimetres
FAST_TURN: Final = 10.0  # rad/s, without the ball
PULL: Final = np.float32(1.5)  # m/s², with the ball on the dribbler, faster and slower
TWIST: Final = np.float32(15.0)  # rad/s², likewise
AT_MOUTH: Final = np.float32(0.02)  # metres from its place in the mouth at which it has the ball
ACROSS: Final = np.float32(0.04)  # metres across the front likewise
STANDOFF: Final = np.float32(0.1)  # metres before the ball from which it goes straight in
STAND: Final = np.float32(0.05)  # metres likewise at which there must be room for it
INTO: Final = np.float32(0.03)  # metres that it drives into the ball, to hold it
FACING: Final = np.float32(0.97)  # cosine of the angle to the ball at which it goes in
SLOW: Final = 0.5  # m/s, into the ball and close to robots
CAREFUL: Final = np.float32(3.0)  # m/s faster, per metre further from the nearest robot
FOLLOWS: Final = np.float32(1.5)  # m/s of a ball that it can still catch up with
SIDES: Final = 16  # directions that it may come to the ball from
CROWDED: Final = np.float32(10.0)  # metres of detour that a metre too near to a robot is worth

_ANGLES = np.arange(SIDES) * (2.0 * np.pi / SIDES)
_COS: Final[Floats] = np.cos(_ANGLES).astype(np.float32)
_SIN: Final[Floats] = np.sin(_ANGLES).astype(np.float32)


class Mover:
    """What an SSL robot of a task can do, and how its actions say it."""

    def __init__(self, policy: str, task: Task) -> None:
        """Refuse a task of other robots."""
        check_ssl(policy, task)
        scales = getattr(task, "action_scales", None)
        if scales is None:
            raise ValueError(f"{policy} plays SSL tasks, which say what their actions mean")
        robot, ball = task.config.robot, task.config.ball
        self.reach = np.float32(robot.front + ball.radius)
        self.body = np.float32(2.0 * robot.bounding_radius)  # metres between robots that touch
        self.ball_room = np.float32(robot.bounding_radius + ball.radius)
        self.kick = np.float32(scales[KICK])
        self._pull = PULL * np.float32(task.config.time_step)
        self._twist = TWIST * np.float32(task.config.time_step)
        self._per_scale = np.float32(1.0) / scales
        self._of_robot = getattr(task, "velocity_frame", "field") == "robot"

    def actions(
        self, ego: RobotColumns, v_x: Floats, v_y: Floats, spin: Floats, kick: Floats | None = None
    ) -> Floats:
        """Velocity (m/s) along the field's axes, turn rate (rad/s), kick (m/s); dribbler on."""
        kick = np.zeros_like(v_x) if kick is None else kick
        actions = np.empty((*v_x.shape, 5), np.float32)
        if self._of_robot:
            cos, sin = ego.heading[..., 0], ego.heading[..., 1]
            v_x, v_y = v_x * cos + v_y * sin, v_y * cos - v_x * sin
        actions[..., 0], actions[..., 1], actions[..., TURN_COLUMN] = v_x, v_y, spin
        actions[..., KICK], actions[..., DRIBBLER] = kick, 1.0
        actions *= self._per_scale
        actions[..., KICK] = np.where(kick > 0.0, actions[..., KICK], np.float32(-1.0))
        return np.minimum(np.maximum(actions, -1.0), 1.0)

    def gently(
        self, ego: RobotColumns, v_x: Floats, v_y: Floats, spin: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Velocity (m/s) and turn rate (rad/s) that differ little from what it does: with a ball.

        The dribbler pulls a ball along with 2.6 m/s² at most.
        """
        way_x, way_y = v_x - ego.velocity[..., 0], v_y - ego.velocity[..., 1]
        per = np.minimum(self._pull / np.maximum(length(way_x, way_y), TINY), np.float32(1.0))
        turn = np.minimum(np.maximum(spin - ego.spin, -self._twist), self._twist)
        return (
            ego.velocity[..., 0] + way_x * per,
            ego.velocity[..., 1] + way_y * per,
            ego.spin + turn,
        )

    def has(self, view: View) -> Mask:
        """Whether the ball is in each observer's mouth, or as good as there."""
        ego, ball = view.ego, view.ball.position
        x, y = ball[..., 0] - ego.position[..., 0], ball[..., 1] - ego.position[..., 1]
        ahead, left = along(x, y, ego.heading[..., 0], ego.heading[..., 1])
        has: Mask = (np.abs(ahead - self.reach) < AT_MOUTH) & (np.abs(left) < ACROSS)
        return has


def bearing(ego: RobotColumns, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """Cosine and sine of the angle from each robot's heading to a direction (x, y)."""
    cos, sin = ego.heading[..., 0], ego.heading[..., 1]
    per = inverse(length(x, y))
    return (x * cos + y * sin) * per, (y * cos - x * sin) * per


def turning(ego: RobotColumns, x: Floats, y: Floats, fastest: float) -> Floats:
    """Turn rate (rad/s) towards a direction (x, y)."""
    ahead, left = bearing(ego, x, y)
    left = np.copysign(np.maximum(np.abs(left), TINY), left)
    # Twice the tangent of half the angle: near to the angle, and grows up to right behind.
    angle = np.float32(2.0) * left / np.maximum(np.float32(1.0) + ahead, TINY)
    rate: Floats = np.minimum(np.maximum(angle * STEER, -fastest), fastest)
    return rate


def driving(
    ego: Floats, x: Floats, y: Floats, fastest: Floats | float, left_over: Floats | None = None
) -> tuple[Floats, Floats]:
    """Velocity (m/s) towards a place, slowing down before it.

    `left_over` is how far it is in all, where the place is only a corner of the way.
    """
    x, y = x - ego[..., 0], y - ego[..., 1]
    here = length(x, y)
    total = here if left_over is None else left_over
    speed = np.minimum(np.sqrt(np.float32(2.0) * BRAKE * total), total * SOFT)
    per = np.minimum(speed, fastest) / np.maximum(here, TINY)
    return x * per, y * per


def mouth_place(
    ego: Floats,
    ball: Floats,
    robots: tuple[Floats, Floats],
    ground: Ground,
    reach: np.float32,
    room: np.float32,
) -> tuple[Floats, Floats]:
    """The direction (n, robots) in which to come to the ball: short, and with room to stand.

    `robots` (n, robots, others) are to be `room` metres away or more.
    """
    to_x, to_y = ball[..., 0] - ego[..., 0], ball[..., 1] - ego[..., 1]
    per = inverse(length(to_x, to_y))
    shape = (*to_x.shape, SIDES)
    u_x: Floats = np.concatenate([(to_x * per)[..., None], np.broadcast_to(_COS, shape)], axis=-1)
    u_y: Floats = np.concatenate([(to_y * per)[..., None], np.broadcast_to(_SIN, shape)], axis=-1)
    far = reach + STAND
    x, y = ball[..., None, 0] - u_x * far, ball[..., None, 1] - u_y * far
    gap_x = robots[0][..., None, :] - x[..., None]
    gap_y = robots[1][..., None, :] - y[..., None]
    crowded = np.maximum(room - length(gap_x, gap_y).min(axis=-1), np.float32(0.0))
    crowded = crowded + ground.outside(x, y)
    cost = length(x - ego[..., None, 0], y - ego[..., None, 1]) + CROWDED * crowded
    best = np.argmin(cost, axis=-1)[..., None]
    x, y = (np.take_along_axis(u, best, -1)[..., 0] for u in (u_x, u_y))
    return x, y


def fetching(
    mover: Mover,
    ego: RobotColumns,
    ball: tuple[Floats, Floats],
    robots: tuple[Floats, Floats],
    ground: Ground,
    fastest: float,
    course: tuple[Floats, Floats] | None = None,
) -> tuple[Floats, Floats, Floats]:
    """Velocity (m/s) and turn rate (rad/s) that bring the ball into the mouth; (n, robots) each.

    `ball` is where it is and how it moves, both (n, robots, 2); `course` is the direction to come
    to it in, if not the one that suits best.
    """
    at, motion = ball
    keep = mover.body + np.float32(0.05)
    chosen = course or mouth_place(ego.position, at, robots, ground, mover.reach, keep)
    u_x, u_y = chosen
    away = mover.reach + STANDOFF
    before_x, before_y = ground.inside(at[..., 0] - u_x * away, at[..., 1] - u_y * away)
    rooms = np.broadcast_to(keep, robots[0].shape)
    things = (
        np.concatenate([robots[0], at[..., None, 0]], axis=-1),
        np.concatenate([robots[1], at[..., None, 1]], axis=-1),
        np.concatenate(
            [rooms, np.broadcast_to(mover.ball_room + np.float32(0.03), at[..., :1].shape)], axis=-1
        ),
    )
    next_x, next_y, far = around(ego.position, before_x, before_y, things, ground)
    v_x, v_y = driving(ego.position, next_x, next_y, fastest, far)
    to_x, to_y = at[..., 0] - ego.position[..., 0], at[..., 1] - ego.position[..., 1]
    ahead, _ = bearing(ego, to_x, to_y)
    from_side, _ = along(to_x, to_y, u_x, u_y)
    near = length(to_x, to_y) < away + np.float32(0.06)
    goes_in = near & (ahead > FACING) & (from_side > np.float32(0.9) * length(to_x, to_y))
    deep = mover.reach - INTO
    deep_x, deep_y = ground.inside(at[..., 0] - u_x * deep, at[..., 1] - u_y * deep)
    in_x, in_y = driving(ego.position, deep_x, deep_y, SLOW)
    # A ball that rolls is followed; one that was shot is not.
    follows = length(motion[..., 0], motion[..., 1]) < FOLLOWS
    v_x = np.where(goes_in, in_x, v_x) + np.where(follows, motion[..., 0], np.float32(0.0))
    v_y = np.where(goes_in, in_y, v_y) + np.where(follows, motion[..., 1], np.float32(0.0))
    v_x, v_y = careful(ego.position, v_x, v_y, robots, mover.body, fastest)
    return v_x, v_y, turning(ego, to_x, to_y, FAST_TURN)


def careful(
    ego: Floats,
    v_x: Floats,
    v_y: Floats,
    robots: tuple[Floats, Floats],
    body: np.float32,
    fastest: float,
) -> tuple[Floats, Floats]:
    """Velocities no faster than lets it turn away before the nearest robot."""
    gaps = length(robots[0] - ego[..., None, 0], robots[1] - ego[..., None, 1]).min(axis=-1)
    most = SLOW + CAREFUL * np.maximum(gaps - body - np.float32(0.05), np.float32(0.0))
    speed = np.maximum(length(v_x, v_y), TINY)
    per = np.minimum(np.minimum(most, fastest) / speed, np.float32(1.0))
    return v_x * per, v_y * per


def along(x: Floats, y: Floats, u_x: Floats, u_y: Floats) -> tuple[Floats, Floats]:
    """Parts of vectors along and to the left of directions."""
    return x * u_x + y * u_y, y * u_x - x * u_y
