"""Policies of the robots that a person does not drive."""

from __future__ import annotations

from rsoccer.controllers import Controller
from rsoccer.frame import team_of
from rsoccer.lineup import script_of
from rsoccer.task import Learn, Task


def team_controllers(
    task: Task, robot: str, policy: str | None = None, opponent: str | None = None
) -> dict[str, Controller]:
    """Return a policy for every robot of a match with a person.

    Args:
        task: the task that is played.
        robot: name of the driven robot.
        policy: policy of the learners in its team, itself included while the person drives
            another one; by default that of `script_of`.
        opponent: policy of the other team; by default the task's own, and that of `script_of`
            for its learners.

    Returns:
        Policies by robot name.

    Raises:
        ValueError: no such robot, or an opponent in a task with one team.
    """
    if robot not in task.robots:
        raise ValueError(f"robot: expected one of {list(task.robots)}, got {robot!r}")
    others = [name for name in task.robots if team_of(name) != team_of(robot)]
    if opponent is not None and not others:
        raise ValueError(f"opponent: {task.name} has one team only, so it has no opponent")
    defaults: dict[str, Controller] = {
        name: script_of(task, team_of(name)) if isinstance(default, Learn) else default
        for name, default in task.default_controllers().items()
    }
    if policy is not None:
        learners = (name for name in task.agents if team_of(name) == team_of(robot))
        defaults |= dict.fromkeys(learners, policy)
    if opponent is not None:
        defaults |= dict.fromkeys(others, opponent)
    return defaults
