"""Line-ups: controllers for evaluation and films, where policies replace the learners."""

from collections.abc import Mapping, Sequence
from typing import Final

from rsoccer import policies
from rsoccer.controllers import Controller
from rsoccer.frame import team_of
from rsoccer.registry import make_task
from rsoccer.task import LEARN, Learn, Task
from rsoccer.tasks.match import Match
from rsoccer.tasks.ssl_keepaway import SslKeepaway
from rsoccer.tasks.ssl_pass import SslPass
from rsoccer.view import SIDES

DEFAULT_TASK: Final = "VSSSelfPlay-v0"
"""Task for policies that were not trained on one."""
DEFAULT_OPPONENT: Final = "ou"
"""Policy of the other team where both teams learn and no opponent is given."""
SCRIPTS: Final = {"differential": "scripted", "omni": "strike"}
"""Scripts that play in the place of learners, by the drive of the robots."""
MATCH_SCRIPT: Final = "scripted"
"""Script of whole matches, which obeys the referee."""
PASS_SCRIPT: Final = "passer"
"""Script of the pass tasks."""
KEEPER_SCRIPT: Final = "keep"
"""Script of the team that keeps the ball in `SSLKeepaway-v0`."""
TAKER_SCRIPT: Final = "take"
"""Script of the other team there."""


def script_of(task: Task, team: str | None = None) -> str:
    """Return the name of the script that plays in the place of a task's learners.

    Args:
        task: the task that is played.
        team: "blue" or "yellow", the team in which it plays; None for that of the first learner.
    """
    if isinstance(task, SslKeepaway):
        takes = task.learners == "takers" if team is None else team == SIDES[1]
        return TAKER_SCRIPT if takes else KEEPER_SCRIPT
    if isinstance(task, SslPass):
        return PASS_SCRIPT
    return MATCH_SCRIPT if isinstance(task, Match) else SCRIPTS[task.config.robots[0].drive]


def task_for(*players: Controller) -> Task:
    """Return the task that the first trained policy was trained on, see `policies.trained_on`.

    Args:
        players: policies, names or files; `LEARN` and scripts are skipped.

    Returns:
        A new task; `DEFAULT_TASK` if none of the policies was trained.
    """
    tasks = (policies.trained_on(player) for player in players if not isinstance(player, Learn))
    return next(filter(None, tasks), None) or make_task(DEFAULT_TASK)


def lineup(
    task: Task, policy: Controller, opponent: Controller | None = None, side: str | None = None
) -> dict[str, Controller]:
    """Return a controller for each robot when a policy replaces the task's learners.

    Teammates that do not learn keep the task's default controllers. The other team keeps its own
    too, unless an opponent is given; `DEFAULT_OPPONENT` replaces its learners.

    Args:
        task: the task that is played.
        policy: controls the learners of the first learner's team.
        opponent: controls all robots of the other team.
        side: "blue" or "yellow": the team that `policy` plays for; by default the first
            learner's. The controllers of the two teams are exchanged robot by robot.

    Raises:
        ValueError: a task without learners, or an opponent in a task with one team.
    """
    home, away = _teams(task)
    own = [policy if default is LEARN else default for default in home.values()]
    others: list[Controller] = [
        DEFAULT_OPPONENT if default is LEARN else default for default in away.values()
    ]
    if opponent is not None:
        if not others:
            raise ValueError(f"opponent: {task.name} has one team only, so it has no opponent")
        others = [opponent] * len(others)
    if side is None or team_of(next(iter(home))) == side:
        return {**dict(zip(home, own, strict=True)), **dict(zip(away, others, strict=True))}
    return {**_resized(home, others), **_resized(away, own)}


def opponents_of(task: Task) -> list[str]:
    """Return the names of the default policies of the team that the learners play against.

    Args:
        task: the task that is played.

    Raises:
        ValueError: a task without learners.
    """
    defaults = _teams(task)[1].values()
    names = (
        DEFAULT_OPPONENT if isinstance(default, Learn) else policies.name_of(default)
        for default in defaults
    )
    return list(dict.fromkeys(names))


def learning_team(task: Task) -> tuple[str, ...]:
    """Return the names of the robots that learn in the first learner's team: blue's if both learn.

    Args:
        task: the task that is played.

    Raises:
        ValueError: a task without learners.
    """
    team = team_of(_first_learner(task))
    return tuple(name for name in task.agents if team_of(name) == team)


def _first_learner(task: Task) -> str:
    if not task.agents:
        raise ValueError(f"task: expected one with a robot that learns, {task.name} has none")
    return task.agents[0]


def _teams(task: Task) -> tuple[dict[str, Controller], dict[str, Controller]]:
    """Default controllers by robot: of the first learner's team, and of the other team."""
    team = team_of(_first_learner(task))
    defaults = task.default_controllers()
    home: dict[str, Controller] = {
        robot: defaults[robot] for robot in task.robots if team_of(robot) == team
    }
    return home, {robot: defaults[robot] for robot in task.robots if robot not in home}


def _resized(
    robots: Mapping[str, object], controllers: Sequence[Controller]
) -> dict[str, Controller]:
    """Controllers of a team for the robots of the other; the last one repeats if it is larger."""
    last = len(controllers) - 1
    return {robot: controllers[min(i, last)] for i, robot in enumerate(robots)}
