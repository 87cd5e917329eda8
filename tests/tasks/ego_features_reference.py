"""Reference of the observation features in NumPy, for comparison with the core."""

from typing import Final

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import RobotColumns, column_slice
from rsoccer.vectors import norm
from rsoccer.view import View

NEARNESS_RATE: Final = np.float32(8.0)  # 1/m: nearness is about a third at 12 cm
TINY: Final = np.float32(1e-6)  # m; avoids a division by zero
PLANE = column_slice(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta")
WITH_BEAM = column_slice(ROBOT_COLUMNS, "x", "y", "cos", "sin", "v_x", "v_y", "v_theta", "infrared")
BALL = column_slice(BALL_COLUMNS, "x", "y", "z", "v_x", "v_y", "v_z")


def blocks(view: View, config: SimConfig, absent: Mask | None = None) -> dict[str, Array]:
    """Blocks of the observation by name, each (n, observers, ...).

    `absent` (n, observers, slots) says which robots are absent; by default none.
    """
    scales, has_mouth = Scales(config), config.robot.has_mouth
    all_blocks = _blocks_of_present(view, config, scales, has_mouth)
    if absent is None:
        return all_blocks
    all_blocks["body_positions"][:, :, 1:][absent[:, :, 1:]] = 0.0
    all_blocks["presence"] = view.present.astype(np.float32)
    for block in all_blocks.values():
        block[absent[:, :, 0]] = 0.0
    return all_blocks


def _blocks_of_present(
    view: View, config: SimConfig, scales: "Scales", has_mouth: bool
) -> dict[str, Array]:
    """Blocks of views in which all robots are present."""
    robots = scales.robots(view, beam=has_mouth)
    goal = np.array([config.field.half_length, 0.0], np.float32)
    return {
        "ball": scales.ball_in_space(view) if has_mouth else scales.ball(view),
        "ego": robots[:, :, 0],
        "teammates": robots[:, :, 1 : 1 + view.n_teammates],
        "opponents": robots[:, :, 1 + view.n_teammates :],
        **body_frame_blocks(view, goal, scales.per_meter, scales.per_speed),
        **({} if has_mouth else own_goal_blocks(view, -goal, scales.per_meter)),
    }


def body_frame_blocks(
    view: View, goal: Floats, per_meter: np.float32, per_speed: np.float32
) -> dict[str, Array]:
    """Blocks in body coordinates; `goal` (2,) is the middle of the attacked goal, m."""
    ego, ball = view.ego, view.ball
    offsets = np.concatenate([ball.position[:, :, None], view.robots.position[:, :, 1:]], axis=2)
    offsets = offsets - ego.position[:, :, None]  # (n, observers, ball and others, 2)
    velocities = np.stack([ego.velocity, ball.velocity], axis=2)
    return {
        "ball_polar": _polar(ego, offsets[:, :, 0], per_meter),  # (n, observers, 3)
        "goal_polar": _polar(ego, goal - ego.position, per_meter),  # (n, observers, 3)
        "shot": _shot(ego, offsets[:, :, 0], goal - ball.position),  # (n, observers, 4)
        "body_velocities": _to_body(ego, velocities) * per_speed,  # (n, observers, 2, 2)
        "body_positions": _to_body(ego, offsets) * per_meter,  # (n, observers, ball and others, 2)
    }


def own_goal_blocks(view: View, own_goal: Floats, per_meter: np.float32) -> dict[str, Array]:
    """Blocks of the middle of the defended goal, (2,), m, in body coordinates."""
    ego, ball = view.ego, view.ball
    shot = _shot(ego, ball.position - ego.position, own_goal - ball.position)
    return {
        "own_goal_polar": _polar(ego, own_goal - ego.position, per_meter),  # (n, observers, 3)
        "own_goal_shot": shot[..., [0, 1, 3]],  # (n, observers, 3)
    }


def _to_body(ego: RobotColumns, vectors: Floats) -> Floats:
    """Vectors (n, observers, k, 2) in the body coordinates of each observer: ahead, left."""
    cos, sin = ego.heading[..., None, 0], ego.heading[..., None, 1]
    x, y = vectors[..., 0], vectors[..., 1]
    body = np.empty_like(vectors)
    np.add(x * cos, y * sin, out=body[..., 0])
    np.subtract(y * cos, x * sin, out=body[..., 1])
    return body


def _polar(ego: RobotColumns, offset: Floats, per_meter: np.float32) -> Floats:
    """Distance and bearing (cosine, sine) of a point at `offset` (n, observers, 2)."""
    distance = norm(offset[..., 0], offset[..., 1])
    polar = np.empty((*distance.shape, 3), np.float32)
    np.multiply(distance, per_meter, out=polar[..., 0])
    bearing = _to_body(ego, offset[:, :, None])[:, :, 0]
    np.divide(bearing, np.maximum(distance, TINY)[..., None], out=polar[..., 1:])
    return polar


def _shot(ego: RobotColumns, to_ball: Floats, to_goal: Floats) -> Floats:
    """Direction from ball to goal, nearness of the ball, and alignment of robot, ball and goal.

    (n, observers, 4): cosine and sine; 1 at the ball, falling to 0; the nearness times the cosine
    between the directions to the ball and from ball to goal.
    """
    shot = np.empty((*to_goal.shape[:2], 4), np.float32)
    goal_distance = np.maximum(norm(to_goal[..., 0], to_goal[..., 1]), TINY)
    distance = np.maximum(norm(to_ball[..., 0], to_ball[..., 1]), TINY)
    np.divide(
        _to_body(ego, to_goal[:, :, None])[:, :, 0], goal_distance[..., None], out=shot[..., :2]
    )
    np.exp(distance * -NEARNESS_RATE, out=shot[..., 2])
    along = to_ball[..., 0] * to_goal[..., 0] + to_ball[..., 1] * to_goal[..., 1]
    np.multiply(shot[..., 2], along / (goal_distance * distance), out=shot[..., 3])
    return shot


class Scales:
    """Scales of positions, velocities and angular velocities for a field and a robot model."""

    def __init__(self, config: SimConfig) -> None:
        """Compute the scales: half the field's length is 1, and so are the robot's top speeds."""
        robot = config.robot
        self.per_meter = np.float32(1.0 / config.field.half_length)
        self.per_speed = np.float32(1.0 / robot.top_speed)
        self.per_angular_velocity = np.float32(1.0 / robot.top_angular_velocity)
        position, speed = [self.per_meter] * 2, [self.per_speed] * 2
        plane = [*position, 1.0, 1.0, *speed, self.per_angular_velocity]
        slots = config.n_robots + max(config.n_blue, config.n_yellow)
        # The scales of all slots in one row, for a single product.
        self._plane = np.tile(np.array(plane, np.float32), slots)
        self._with_beam = np.tile(np.array([*plane, 1.0], np.float32), slots)
        self._ball = np.array([self.per_meter] * 3 + [self.per_speed] * 3, np.float32)

    def robots(self, view: View, *, beam: bool = False) -> Floats:
        """Pose and velocity of each slot, (n, observers, slots, 7); with the break beam, 8."""
        columns, scale = (WITH_BEAM, self._with_beam) if beam else (PLANE, self._plane)
        n, observers, slots = view.robots.data.shape[:3]
        motion = view.robots.data[..., columns].reshape(n, observers, -1)
        return (motion * scale[: motion.shape[2]]).reshape(n, observers, slots, -1)

    def ball(self, view: View) -> Floats:
        """Position and velocity of the ball in the plane, (n, observers, 4)."""
        position, velocity = view.ball.position, view.ball.velocity
        return np.concatenate([position * self.per_meter, velocity * self.per_speed], axis=-1)

    def ball_in_space(self, view: View) -> Floats:
        """Position and velocity of the ball in space, (n, observers, 6)."""
        return view.ball.data[..., BALL] * self._ball
