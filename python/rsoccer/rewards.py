"""Terms of a reward, unweighted: batched functions that tasks call.

Terms that guide are differences of a potential between two frames, so going back and forth pays
nothing and no memory is needed.
"""

from collections.abc import Mapping
from typing import Final

import numpy as np

from rsoccer._core import CROSSINGS, Field
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, BallColumns, Floats, Frame, Mask, length
from rsoccer.task import Play
from rsoccer.view import View

BEHIND: Final = np.float32(0.08)
"""Metres: half a VSSS robot, a ball's radius and two centimetres to turn in."""


def goal(play: Play) -> Floats:
    """+1 for a goal, -1 for one against, else 0; (n, seers)."""
    return goals_at(play.view.ball)


def goals_at(ball: BallColumns) -> Floats:
    """+1 where the ball went into the goal at +x, -1 where into the other one, else 0; (...)."""
    return _GOALS[ball.crossed.astype(np.intp)]


def scored(play: Play) -> Mask:
    """Whether either side has scored, (n,)."""
    return np.not_equal(goals_at(play.frame.ball), 0.0)


def ball_to_goal(play: Play, field: Field) -> Floats:
    """Metres the ball came closer to the goal attacked and away from the own one, (n, seers).

    The mean of the two, so what one side wins the other loses.
    """
    return _advance_of_ball(play.view, field) - _advance_of_ball(play.last_view, field)


def approach(play: Play, field: Field) -> Floats:
    """Metres that each seer came closer to where it can drive the ball at the goal, (n, seers).

    That is a point just behind the ball: who stands before the ball is drawn around it, and two
    of one team are not paid for pushing it from opposite sides.
    """
    return _way_to_go(play.last_view, field) - _way_to_go(play.view, field)


def nearest(play: Play) -> Mask:
    """Whether each seer was its team's nearest to the ball before the step, (n, seers).

    Who moved the ball, as a rule: paid for what the ball did, it learns from less noise than if
    its mates were paid alike.
    """
    distance = _distances(play.last_frame)
    return np.equal(distance, _least(distance, play.frame))[:, play.seers]


def weighted(terms: dict[str, Floats], weights: Mapping[str, float] | str) -> dict[str, Floats]:
    """Terms times their weights; a task's `weights` are numbers once it is made."""
    if isinstance(weights, str):
        raise TypeError(f"weights: expected numbers by name, got {weights!r}")
    return {name: np.float32(weights[name]) * term for name, term in terms.items()}


def energy(play: Play) -> Floats:
    """Effort of each seer: the mean magnitude of its action, negative; (n, seers)."""
    effort = np.abs(play.actions[:, play.seers])
    # A sum by hand: reductions along so short an axis cost several times as much.
    total = sum((effort[..., i] for i in range(1, effort.shape[2])), start=effort[..., 0])
    mean: Floats = total * np.float32(-1.0 / effort.shape[2])
    return mean


def _advance_of_ball(view: View, field: Field) -> Floats:
    """Half of: distance to the own goal less distance to the other one, metres; (n, seers)."""
    x, y = view.ball.position[..., 0], view.ball.position[..., 1]
    goal_x = np.float32(field.half_length)
    return np.float32(0.5) * (length(goal_x + x, y) - length(goal_x - x, y))


def _way_to_go(view: View, field: Field) -> Floats:
    """Metres from each seer to the point `BEHIND` the ball, seen from the goal; (n, seers)."""
    ball, me = view.ball.position, view.me.position
    x, y = np.float32(field.half_length) - ball[..., 0], -ball[..., 1]
    per = BEHIND / np.maximum(length(x, y), BEHIND)
    # A ball at the wall has no room behind it: then the nearest place inside counts.
    most_x, most_y = np.float32(field.half_length) - BEHIND, np.float32(field.half_width) - BEHIND
    target_x = np.maximum(ball[..., 0] - x * per, -most_x)
    target_y = np.minimum(np.maximum(ball[..., 1] - y * per, -most_y), most_y)
    return length(target_x - me[..., 0], target_y - me[..., 1])


def _distances(frame: Frame) -> Floats:
    """Metres from each robot to the ball, (n, robots)."""
    robots, ball = frame.robots.position, frame.ball.position
    x = robots[..., 0] - ball[:, None, 0]
    y = robots[..., 1] - ball[:, None, 1]
    return length(x, y)


def _least(distance: Floats, frame: Frame) -> Floats:
    """The least in each robot's team, (n, robots)."""
    least = np.empty_like(distance)
    for team in (slice(0, frame.n_blue), slice(frame.n_blue, None)):
        if distance[:, team].size:
            least[:, team] = distance[:, team].min(axis=1, keepdims=True)
    return least


# (crossings,) what a crossing is worth to who attacks the goal at +x
_GOALS = np.array([(i == GOAL_RIGHT) - (i == GOAL_LEFT) for i in range(len(CROSSINGS))], np.float32)
