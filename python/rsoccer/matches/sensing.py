"""The senses of matches: of a model in Python, or of the simulator."""

from collections.abc import Collection, Iterable, Sequence
from typing import Final

from rsoccer._core import SENSING_NUMBERS, Sensing
from rsoccer.controllers import Assignment
from rsoccer.frame import Frame, team_of
from rsoccer.policies.base import Policy
from rsoccer.randomization import NumberRanges
from rsoccer.rng import WorldRng
from rsoccer.senses import ModelSenses, Senses, SensorModel
from rsoccer.simulated_senses import SimulatedSenses, sensing_stepper
from rsoccer.simulator_interface import Stepper
from rsoccer.task import Task
from rsoccer.view import SIDES

ON: Final = 0.5
"""Least value of a switch of `Sensing` that is on."""


def simulated(sensing: SensorModel | Sensing | None) -> Sensing | None:
    """Return the senses that the simulator computes, or None if it computes none.

    Args:
        sensing: what robots know of the true state.
    """
    return sensing if isinstance(sensing, Sensing) else None


def new_senses(
    sensing: SensorModel | Sensing | None,
    stepper: Stepper,
    worlds: int,
    ranges: NumberRanges | None,
    forecasting: tuple[str, ...],
    frame: Frame,
    rng: WorldRng,
) -> Senses | None:
    """Return the senses of n worlds before their episodes begin.

    Args:
        sensing: what robots know of the true state; None if they know it exactly.
        stepper: the simulator.
        worlds: number of its worlds.
        ranges: ranges of the numbers of a `Sensing`.
        forecasting: teams that forecast; both where each has cameras of its own.
        frame: frame of n worlds; copied.
        rng: (n,) random streams.

    Raises:
        TypeError: a `Sensing` with a simulator that has no senses.
        ValueError: a column of a model whose first axis is not n.
    """
    if sensing is None:
        return None
    if isinstance(sensing, Sensing):
        observing: tuple[int, ...] | None = None
        if _may_be_on("own_cameras", sensing, ranges):
            observing = (0, 1)
        elif teams_differ(sensing, ranges):
            observing = tuple(SIDES.index(team) for team in forecasting)
        own = sensing_stepper(stepper)
        return SimulatedSenses.new(own, worlds, ranges, observing, frame, rng)
    return ModelSenses.new(sensing, frame, rng)


def check_forecasting(task: Task, asked: Sequence[str]) -> None:
    """Check the names of teams that are asked to forecast.

    Args:
        task: the task that is played.
        asked: names of teams.

    Raises:
        TypeError: no names of teams.
        ValueError: a name that is no team's, or that of a team without robots.
    """
    teams = list(teams_of(task.robots))
    if isinstance(asked, str):
        raise ValueError(f"forecasting: expected some of {teams}, got {asked!r}")
    if not isinstance(asked, Collection):
        raise TypeError(f"forecasting: expected some of {teams}, got {asked!r}")
    if unknown := sorted((name for name in asked if name not in teams), key=str):
        raise ValueError(f"forecasting: expected some of {teams}, got {unknown!r}")


def forecasting_teams(
    task: Task, assignment: Assignment, asked: Sequence[str] | None, *, together: bool
) -> tuple[str, ...]:
    """Return the teams that forecast: as asked, or as their policies play from a forecast.

    Teams with a policy that needs it always do. If nothing is asked for, those do, too, in which
    all that look play from one; learners do not: what they observe depends on no other robot.

    Args:
        task: the task that is played.
        assignment: policies and their robots.
        asked: names of teams; None to let the policies decide.
        together: whether both teams forecast or none, so that one that need not waits for the
            other.
    """
    teams = teams_of(task.robots)
    learners = teams_of(task.robots[robot] for robot in assignment.learners)
    looking: dict[str, list[Policy]] = {team: [] for team in teams}
    for group in assignment.groups:
        if group.policy.observes != "nothing":
            for team in teams_of(task.robots[robot] for robot in group.robots):
                looking[team].append(group.policy)
    found = {team for team in teams if any(policy.needs_forecast for policy in looking[team])}
    if asked is not None:
        return tuple(sorted({*found, *asked}))
    ready = {
        team
        for team in teams
        if team not in learners and all(policy.forecasts for policy in looking[team])
    }
    if not together or ready | found == set(teams):
        found |= {team for team in ready if looking[team]}
    return tuple(sorted(found))


def teams_of(robots: Iterable[str]) -> tuple[str, ...]:
    """Return the teams of some robots.

    Args:
        robots: their names.
    """
    return tuple(sorted({team_of(robot) for robot in robots}))


def may_forecast(sensing: Sensing, ranges: NumberRanges | None) -> bool:
    """Return whether all robots that observe forecast, in some episodes at least.

    Args:
        sensing: what robots know of the true state.
        ranges: ranges of the numbers of a `Sensing`.
    """
    return _may_be_on("forecast", sensing, ranges)


def teams_differ(sensing: SensorModel | Sensing | None, ranges: NumberRanges | None) -> bool:
    """Return whether teams may know different states, by cameras or forecasts of their own.

    Args:
        sensing: what robots know of the true state.
        ranges: ranges of the numbers of a `Sensing`.
    """
    if not isinstance(sensing, Sensing):
        return False
    is_shared = sensing.forecast_others >= ON and ranges is None
    return _may_be_on("own_cameras", sensing, ranges) or (
        _may_be_on("forecast", sensing, ranges) and not is_shared
    )


def forecast_together(sensing: Sensing, ranges: NumberRanges | None) -> bool:
    """Return whether both teams forecast or none.

    Args:
        sensing: what robots know of the true state, with `forecast`.
        ranges: ranges of the numbers of a `Sensing`.
    """
    return _may_be_on("own_cameras", sensing, ranges) or not teams_differ(sensing, ranges)


def _may_be_on(name: str, sensing: Sensing, ranges: NumberRanges | None) -> bool:
    """Whether a switch is on, or may be in an episode that draws it."""
    drawn = () if ranges is None else sum((columns for columns, _ in ranges.drawn), ())
    return getattr(sensing, name) >= ON or SENSING_NUMBERS.index(name) in drawn
