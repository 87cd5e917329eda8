"""Terms of a reward, unweighted: batched functions that tasks call.

Terms that guide are differences of a potential between two frames, so going back and forth pays
nothing and no memory is needed.
"""

from collections.abc import Mapping
from typing import Final

import numpy as np

from rsoccer import _core
from rsoccer._core import CROSSINGS, Field, Potential, SimConfig, efforts
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, BallColumns, Floats, Mask
from rsoccer.task import Play

BEHIND: Final = 0.08
"""Metres: half a VSSS robot, a ball's radius and two centimetres to turn in."""


def goal(play: Play) -> Floats:
    """+1 for a goal, -1 for one against, else 0; (n, observers)."""
    return goals_at(play.view.ball)


def goals_at(ball: BallColumns) -> Floats:
    """+1 where the ball went into the goal at +x, -1 where into the other one, else 0; (...)."""
    return _GOALS[ball.crossed.astype(np.intp)]


def scored(play: Play) -> Mask:
    """Whether either side has scored, (n,)."""
    return np.not_equal(goals_at(play.frame.ball), 0.0)


def gained(play: Play, potential: Potential) -> Floats:
    """What each observer gained of a potential in the last step, (n, observers) metres."""
    last, view = play.last_view, play.view
    return potential.gained(last.ball.data, last.robots.data, view.ball.data, view.robots.data)


def ball_to_goal(play: Play, field: Field) -> Floats:
    """Metres the ball came closer to the goal attacked and away from the own one, (n, observers).

    The mean of the two, so what one side wins the other loses.
    """
    return gained(play, Potential.ball_to_goal(field))


def approach(play: Play, field: Field) -> Floats:
    """Metres that each observer came closer to where it can drive the ball at the goal, (n, observers).

    That is a point just behind the ball: who stands before the ball is drawn around it, and two
    of one team are not paid for pushing it from opposite sides.
    """
    return gained(play, Potential.behind_ball(field, BEHIND))


def to_mouth(play: Play, config: SimConfig) -> Floats:
    """Metres that the ball came closer to each observer's mouth, (n, observers).

    Nothing is left to gain only for who faces the ball, so it draws a robot near and round to it.
    """
    return gained(play, Potential.at_mouth(config.robot, config.ball))


def nearest(play: Play) -> Mask:
    """Whether each observer was its team's nearest to the ball before the step, (n, observers).

    Who moved the ball, as a rule: paid for what the ball did, it learns from less noise than if
    its teammates were paid alike.
    """
    return _core.nearest(play.last_frame.rows, play.last_frame.n_blue, play.observers)


def weighted(terms: dict[str, Floats], weights: Mapping[str, float] | str) -> dict[str, Floats]:
    """Terms times their weights; a task's `weights` are numbers once it is made."""
    if isinstance(weights, str):
        raise TypeError(f"weights: expected numbers by name, got {weights!r}")
    return {name: term * np.float32(weights[name]) for name, term in terms.items()}


def energy(play: Play) -> Floats:
    """Effort of each observer: the mean magnitude of its action, negative; (n, observers)."""
    effort = efforts(play.actions, play.observers)
    return np.negative(effort, out=effort)


# (crossings,) what a crossing is worth to who attacks the goal at +x
_GOALS = np.array([(i == GOAL_RIGHT) - (i == GOAL_LEFT) for i in range(len(CROSSINGS))], np.float32)
