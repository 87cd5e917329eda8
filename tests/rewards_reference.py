"""Reference of the reward terms in NumPy, for comparison with the core."""

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rewards import BEHIND_BALL_DISTANCE
from rsoccer.task import Play
from rsoccer.vectors import norm
from rsoccer.view import View


def ball_to_goal(play: Play, config: SimConfig) -> Floats:
    """Mean progress of the ball toward the attacked goal and away from the own goal."""

    def potential(view: View) -> Floats:
        x, y = view.ball.position[..., 0], view.ball.position[..., 1]
        goal_x = np.float32(config.field.half_length)
        return np.float32(0.5) * (norm(goal_x + x, y) - norm(goal_x - x, y))

    return potential(play.view) - potential(play.last_view)


def approach_behind_ball(play: Play, config: SimConfig) -> Floats:
    """Progress of each observer toward the point behind the ball."""
    field, behind = config.field, np.float32(BEHIND_BALL_DISTANCE)
    max_x = np.float32(field.half_length) - behind
    max_y = np.float32(field.half_width) - behind

    def distance(view: View) -> Floats:
        ball, ego = view.ball.position, view.ego.position
        x, y = np.float32(field.half_length) - ball[..., 0], -ball[..., 1]
        scale = behind / np.maximum(norm(x, y), behind)
        target_x = np.maximum(ball[..., 0] - x * scale, -max_x)
        target_y = np.minimum(np.maximum(ball[..., 1] - y * scale, -max_y), max_y)
        return norm(target_x - ego[..., 0], target_y - ego[..., 1])

    return distance(play.last_view) - distance(play.view)


def approach_mouth(play: Play, config: SimConfig) -> Floats:
    """Decrease of the distance between the ball and each observer's mouth."""
    mouth_offset = np.float32(config.robot.front_distance) + np.float32(config.ball.radius)

    def distance(view: View) -> Floats:
        ego, ball = view.ego, view.ball.position
        mouth = ego.position + ego.heading * mouth_offset
        return norm(ball[..., 0] - mouth[..., 0], ball[..., 1] - mouth[..., 1])

    return distance(play.last_view) - distance(play.view)


def nearest_to_ball(play: Play) -> Mask:
    """Observers that were their team's nearest to the ball before the step."""
    frame: Frame = play.last_frame
    offset = frame.robots.position - frame.ball.position[:, None]
    distance = np.where(frame.robots.absent > 0.0, np.inf, norm(offset[..., 0], offset[..., 1]))
    teams = np.split(distance, [frame.n_blue], axis=1)
    least = [np.broadcast_to(t.min(axis=1, keepdims=True), t.shape) for t in teams if t.size]
    nearest: Mask = np.equal(distance, np.concatenate(least, axis=1)) & np.isfinite(distance)
    return nearest[:, play.observers]


def energy(play: Play) -> Floats:
    """Negative mean magnitude of each observer's action."""
    mean: Floats = np.abs(play.actions[:, play.observers]).mean(axis=-1)
    return -mean
