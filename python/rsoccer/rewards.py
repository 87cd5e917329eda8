"""Reward terms, unweighted and batched over worlds and observers.

Shaping terms are differences of a potential between two consecutive views (potential-based
shaping), so a cycle of states adds up to zero and no memory is needed.
"""

from collections.abc import Collection, Mapping
from typing import Final

import numpy as np

from rsoccer import _core
from rsoccer._core import Field, Potential, SimConfig, mean_action_magnitude
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import BLUE, NOBODY, YELLOW, EventKind
from rsoccer.task import Play

BEHIND_BALL_DISTANCE: Final = 0.08
"""Meters: half a VSSS robot, a ball's radius and two centimeters to turn in."""


def goal(play: Play) -> Floats:
    """Return the goals of the observer's team in the last step, less those of the other team.

    Args:
        play: state of n worlds.

    Returns:
        (n, observers): 1 for a goal, -1 for one against, else 0.
    """
    if not np.count_nonzero(play.events.count):  # in most steps
        return np.zeros((len(play.frame), len(play.observers)), np.float32)
    goals = play.events.by_team(EventKind.GOAL)
    balance = (goals - goals[:, ::-1]).astype(np.float32)
    return balance[:, play.viewpoint.teams]


def of_blue(play: Play, values: Array) -> Floats:
    """Return what is good for blue, as each observer's team takes it: for yellow it is bad.

    Args:
        play: state of n worlds.
        values: (n,) numbers or a mask.

    Returns:
        (n, observers): the values for robots of blue, their negatives for those of yellow.
    """
    return np.asarray(values, np.float32)[:, None] * play.viewpoint.signs


def events_of_team(play: Play, kinds: Collection[int]) -> Floats:
    """Return the number of events of the observer's team in the last step.

    Args:
        play: state of n worlds.
        kinds: kinds of events. Those of no team, as a crash of equal robots, count for both.

    Returns:
        (n, observers).
    """
    events = play.events
    if not np.count_nonzero(events.count):  # in most steps
        return np.zeros((len(play.frame), len(play.observers)), np.float32)
    counts = np.zeros((len(play.frame), 2), np.float32)
    most = int(events.count.max())
    matching = (events.kind[:, :most, None] == list(kinds)).any(axis=2)
    teams = events.team[:, :most]
    for team in (BLUE, YELLOW):
        of_team = (teams == team) | (teams == NOBODY)
        counts[:, team] = (matching & of_team).sum(axis=1)
    return counts[:, play.viewpoint.teams]


def goal_score(play: Play) -> Floats:
    """Return the goals of blue in the episode, less those of yellow.

    Args:
        play: state of n worlds.

    Returns:
        (n,).
    """
    score = play.game.score
    return (score[:, BLUE] - score[:, YELLOW]).astype(np.float32)


def scored(play: Play) -> Mask:
    """Return the worlds in which either team scored in the last step.

    Args:
        play: state of n worlds.

    Returns:
        (n,).
    """
    return play.events.happened(EventKind.GOAL)


def potential_difference(play: Play, potential: Potential) -> Floats:
    """Return the increase of a potential in the last step.

    Args:
        play: state of n worlds.
        potential: function of the view of an observer, m.

    Returns:
        (n, observers) meters.
    """
    viewpoint, last_rows, rows = play.viewpoint.core, play.last_frame.rows, play.frame.rows
    return potential.difference(viewpoint, last_rows, rows, play.threads)


def ball_to_goal(play: Play, field: Field) -> Floats:
    """Return the progress of the ball toward the attacked goal and away from the own goal.

    The mean of both changes of distance, so it is zero-sum between the teams.

    Args:
        play: state of n worlds.
        field: gives the positions of the goals.

    Returns:
        (n, observers) meters.
    """
    return potential_difference(play, Potential.ball_to_goal(field))


def approach_behind_ball(play: Play, field: Field) -> Floats:
    """Return the progress of each observer toward the point just behind the ball.

    That point lies `BEHIND_BALL_DISTANCE` from the ball, opposite to the attacked goal. A robot in
    front of the ball is rewarded for driving around it, and two robots of one team are not
    rewarded for pushing the ball from opposite sides.

    Args:
        play: state of n worlds.
        field: gives the position of the goal and the walls.

    Returns:
        (n, observers) meters.
    """
    return potential_difference(play, Potential.behind_ball(field, BEHIND_BALL_DISTANCE))


def approach_mouth(play: Play, config: SimConfig) -> Floats:
    """Return the decrease of the distance between the ball and each observer's mouth.

    The mouth is the dribbler's place at the front of an SSL robot. The potential is maximal only
    with the ball directly in front, so it pulls the robot close and turns it to face the ball.

    Args:
        play: state of n worlds.
        config: gives the robot and the ball.

    Returns:
        (n, observers) meters.

    Raises:
        ValueError: the robot has no mouth.
    """
    return potential_difference(play, Potential.at_mouth(config.robot, config.ball))


def nearest_to_ball(play: Play) -> Mask:
    """Return the observers that were their team's nearest to the ball before the step.

    Usually the nearest robot moved the ball. If only that robot is rewarded for the ball's
    motion, the reward of its teammates has less noise.

    Args:
        play: state of n worlds.

    Returns:
        (n, observers).
    """
    frame = play.last_frame
    return _core.nearest_to_ball(frame.rows, frame.n_blue, play.observers, play.threads)


def energy(play: Play) -> Floats:
    """Return the negative mean magnitude of each observer's action, a proxy of its energy.

    Args:
        play: state of n worlds.

    Returns:
        (n, observers) in [-1, 0].
    """
    return np.negative(mean_action_magnitude(play.actions, play.observers, play.threads))


def weighted_terms(
    terms: dict[str, Floats], weights: Mapping[str, np.float32]
) -> dict[str, Floats]:
    """Return reward terms times their weights.

    Args:
        terms: unweighted terms by name, each (n, observers) or (n, 1).
        weights: weight of each term by name, float32 as the terms.

    Returns:
        Weighted terms by name, in the order of `terms`.
    """
    return {name: term * weights[name] for name, term in terms.items()}
