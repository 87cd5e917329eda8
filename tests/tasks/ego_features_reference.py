"""What a robot sees, in NumPy: what the core works out is checked against it."""

from typing import Final

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.frame import Array, Floats, RobotColumns, length, column_slice
from rsoccer.view import View

NEAR: Final = np.float32(8.0)  # per metre: at 12 cm the ball is a third as near as at none
TINY: Final = np.float32(1e-6)  # metres; keeps directions finite
PLANE = column_slice(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta")
WITH_BEAM = column_slice(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta", "infrared")
BALL = column_slice(BALL_COLUMNS, "x", "y", "z", "v_x", "v_y", "v_z")


def blocks(view: View, config: SimConfig) -> dict[str, Array]:
    """All blocks of a view, by name; each (n, observers, ...)."""
    scales, has_mouth = Scales(config), config.robot.has_mouth
    robots = scales.robots(view, beam=has_mouth)
    goal = np.array([config.field.half_length, 0.0], np.float32)
    return {
        "ball": scales.ball_in_space(view) if has_mouth else scales.ball(view),
        "ego": robots[:, :, 0],
        "teammates": robots[:, :, 1 : 1 + view.n_teammates],
        "opponents": robots[:, :, 1 + view.n_teammates :],
        **from_me(view, goal, scales.per_metre, scales.per_speed),
    }


def from_me(
    view: View, goal: Floats, per_metre: np.float32, per_speed: np.float32
) -> dict[str, Array]:
    """Blocks of an observation; `goal` (2,) is the middle of the goal attacked, metres."""
    ego, ball = view.ego, view.ball
    places = np.concatenate([ball.position[:, :, None], view.robots.position[:, :, 1:]], axis=2)
    places = places - ego.position[:, :, None]  # (n, observers, ball and others, 2)
    motions = np.stack([ego.velocity, ball.velocity], axis=2)
    return {
        "ball_polar": _polar(ego, places[:, :, 0], per_metre),  # (n, observers, 3)
        "goal_polar": _polar(ego, goal - ego.position, per_metre),  # (n, observers, 3)
        "shot": _shot(ego, places[:, :, 0], goal - ball.position),  # (n, observers, 4)
        "body_velocities": _turned(ego, motions) * per_speed,  # (n, observers, 2, 2)
        "body_positions": _turned(ego, places) * per_metre,  # (n, observers, ball and others, 2)
    }


def _turned(ego: RobotColumns, vectors: Floats) -> Floats:
    """Vectors (n, observers, k, 2) along and across each observer's heading."""
    cos, sin = ego.heading[..., None, 0], ego.heading[..., None, 1]
    x, y = vectors[..., 0], vectors[..., 1]
    turned = np.empty_like(vectors)
    np.add(x * cos, y * sin, out=turned[..., 0])
    np.subtract(y * cos, x * sin, out=turned[..., 1])
    return turned


def _polar(ego: RobotColumns, offset: Floats, per_metre: np.float32) -> Floats:
    """Distance, and cosine and sine of the bearing, of what lies `offset` (n, observers, 2) away."""
    distance = length(offset[..., 0], offset[..., 1])
    polar = np.empty((*distance.shape, 3), np.float32)
    np.multiply(distance, per_metre, out=polar[..., 0])
    bearing = _turned(ego, offset[:, :, None])[:, :, 0]
    np.divide(bearing, np.maximum(distance, TINY)[..., None], out=polar[..., 1:])
    return polar


def _shot(ego: RobotColumns, to_ball: Floats, to_goal: Floats) -> Floats:
    """Bearing of the goal from the ball, how near I am to it, and how well I stand behind it.

    (n, observers, 4): cosine and sine; 1 at the ball, falling to 0; the latter times 1 where ball and
    goal lie in one direction, -1 where in opposite ones.
    """
    shot = np.empty((*to_goal.shape[:2], 4), np.float32)
    way = np.maximum(length(to_goal[..., 0], to_goal[..., 1]), TINY)
    distance = np.maximum(length(to_ball[..., 0], to_ball[..., 1]), TINY)
    np.divide(_turned(ego, to_goal[:, :, None])[:, :, 0], way[..., None], out=shot[..., :2])
    np.exp(distance * -NEAR, out=shot[..., 2])
    along = to_ball[..., 0] * to_goal[..., 0] + to_ball[..., 1] * to_goal[..., 1]
    np.multiply(shot[..., 2], along / (way * distance), out=shot[..., 3])
    return shot


class Scales:
    """Scales of one field and one robot model."""

    def __init__(self, config: SimConfig) -> None:
        """Half the field's length is 1, and so is a robot's top speed."""
        robot = config.robot
        self.per_metre = np.float32(1.0 / config.field.half_length)
        self.per_speed = np.float32(1.0 / robot.top_speed)
        self.per_turn = np.float32(1.0 / robot.top_turn_rate)
        place, speed = [self.per_metre] * 2, [self.per_speed] * 2
        plane = [*place, 1.0, 1.0, *speed, self.per_turn]
        slots = config.n_robots + max(config.n_blue, config.n_yellow)
        # All slots' side by side, so that one long product does them all.
        self._plane = np.tile(np.array(plane, np.float32), slots)
        self._with_beam = np.tile(np.array([*plane, 1.0], np.float32), slots)
        self._ball = np.array([self.per_metre] * 3 + [self.per_speed] * 3, np.float32)

    def robots(self, view: View, *, beam: bool = False) -> Floats:
        """Poses and motion of all slots, (n, observers, slots, 7); with the break beam, 8."""
        columns, scale = (WITH_BEAM, self._with_beam) if beam else (PLANE, self._plane)
        n, observers, slots = view.robots.data.shape[:3]
        motion = view.robots.data[..., columns].reshape(n, observers, -1)
        return (motion * scale[: motion.shape[2]]).reshape(n, observers, slots, -1)

    def ball(self, view: View) -> Floats:
        """Where the ball is and goes in the plane, (n, observers, 4)."""
        position, velocity = view.ball.position, view.ball.velocity
        return np.concatenate([position * self.per_metre, velocity * self.per_speed], axis=-1)

    def ball_in_space(self, view: View) -> Floats:
        """Place x, y, z and velocity, (n, observers, 6)."""
        return view.ball.data[..., BALL] * self._ball
