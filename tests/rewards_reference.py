"""Terms of rewards, in NumPy: what the core works out is checked against it."""

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.frame import Floats, Frame, Mask, length
from rsoccer.rewards import BEHIND_BALL_DISTANCE
from rsoccer.task import Play
from rsoccer.view import View


def ball_to_goal(play: Play, config: SimConfig) -> Floats:
    """Half of what the ball gained on the goal attacked, and away from the own one."""

    def advance(view: View) -> Floats:
        x, y = view.ball.position[..., 0], view.ball.position[..., 1]
        goal_x = np.float32(config.field.half_length)
        return np.float32(0.5) * (length(goal_x + x, y) - length(goal_x - x, y))

    return advance(play.view) - advance(play.last_view)


def approach(play: Play, config: SimConfig) -> Floats:
    """What each observer gained on the point behind the ball."""
    field, behind = config.field, np.float32(BEHIND_BALL_DISTANCE)
    most_x = np.float32(field.half_length) - behind
    most_y = np.float32(field.half_width) - behind

    def way_to_go(view: View) -> Floats:
        ball, ego = view.ball.position, view.ego.position
        x, y = np.float32(field.half_length) - ball[..., 0], -ball[..., 1]
        per = behind / np.maximum(length(x, y), behind)
        target_x = np.maximum(ball[..., 0] - x * per, -most_x)
        target_y = np.minimum(np.maximum(ball[..., 1] - y * per, -most_y), most_y)
        return length(target_x - ego[..., 0], target_y - ego[..., 1])

    return way_to_go(play.last_view) - way_to_go(play.view)


def to_mouth(play: Play, config: SimConfig) -> Floats:
    """What the ball gained on where it would be in each observer's mouth."""
    reach = np.float32(config.robot.front) + np.float32(config.ball.radius)

    def way_to_go(view: View) -> Floats:
        ego, ball = view.ego, view.ball.position
        at = ego.position + ego.heading * reach
        return length(ball[..., 0] - at[..., 0], ball[..., 1] - at[..., 1])

    return way_to_go(play.last_view) - way_to_go(play.view)


def nearest(play: Play) -> Mask:
    """Whether each observer was its team's nearest to the ball before the step."""
    frame: Frame = play.last_frame
    offset = frame.robots.position - frame.ball.position[:, None]
    distance = length(offset[..., 0], offset[..., 1])
    teams = np.split(distance, [frame.n_blue], axis=1)
    least = [np.broadcast_to(t.min(axis=1, keepdims=True), t.shape) for t in teams if t.size]
    nearest: Mask = np.equal(distance, np.concatenate(least, axis=1))[:, play.observers]
    return nearest


def energy(play: Play) -> Floats:
    """The mean magnitude of each observer's action, negative."""
    mean: Floats = np.abs(play.actions[:, play.observers]).mean(axis=-1)
    return -mean
