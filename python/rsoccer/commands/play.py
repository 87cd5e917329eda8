"""`rsoccer play`: one robot driven by a person."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.sources import Sources
from rsoccer.commands.subject import check_policy_names, team_name
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.controllers import Controller
from rsoccer.frame import team_of
from rsoccer.human.teams import team_controllers
from rsoccer.lineup import DEFAULT_TASK
from rsoccer.option_words import check_entries
from rsoccer.registry import task_with_options
from rsoccer.task import Task
from rsoccer.view import SIDES

_DEFAULT_PLAYER = "(default: the task's own, or a script where robots learn)"
_FIRST_ROBOT = "(default: the first learner)"


@dataclass(frozen=True)
class Play(Sources, Imports):
    """Drive a robot by keyboard or gamepad, against policies and with them."""

    task: Annotated[str, Positional, arg(metavar="TASK")] = DEFAULT_TASK
    """task to play"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""
    robot: Annotated[str | None, arg(metavar="ROBOT", help_behavior_hint=_FIRST_ROBOT)] = None
    """robot to drive first, such as blue_0 or yellow_1"""
    policy: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_DEFAULT_PLAYER)] = None
    """policy of the other learners in the driven robot's team"""
    opponents: Annotated[str | None, arg(metavar="POLICY", help_behavior_hint=_DEFAULT_PLAYER)] = (
        None
    )
    """policy of the other team"""
    controllers: Annotated[
        tuple[str, ...], arg(metavar="NAME=POLICY", help_behavior_hint="(default: none)")
    ] = ()
    """policies of single robots, of "blue", "yellow" or "all", as in yellow_0=zero"""
    seed: int = 0
    """random seed; each seed gives another match"""
    seconds: Annotated[float, arg(help_behavior_hint="(default: until the window is closed)")] = (
        math.inf
    )
    """longest duration, in real time"""
    speed: float = 1.0
    """speed of play, above 0: 1 is real time, 2 is twice as fast"""
    width: int | None = None
    """width of the picture in pixels; by default one at which robots can be distinguished"""

    def run(self) -> None:
        """Open the window and play.

        Raises:
            ValueError: a controller without "=", two of the same name, or another option is
                refused.
        """
        from rsoccer.human.session import Session

        check_policy_names([self.policy, self.opponents])
        task = task_with_options(self.task, self.task_options)
        robot = self.robot or next(iter(task.agents or task.robots))
        controllers = self._controllers(task, robot)
        with Session(
            task,
            controllers,
            robot,
            seed=self.seed,
            speed=self.speed,
            width=self.width,
            names=self._names(task, robot, controllers),
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        ) as session:
            session.run(self.seconds)

    def _controllers(self, task: Task, robot: str) -> dict[str, Controller]:
        """Policies of all robots: the task's own, then the options, the most specific last."""
        chosen = team_controllers(task, robot, self.policy, self.opponents)
        check_entries("controllers", (entry.partition("=")[0] for entry in self.controllers))
        # A team's name overrules the names above it, and a robot's name that of its team.
        for entry in sorted(self.controllers, key=_rank):
            name, equals, policy = entry.partition("=")
            if not (name and equals and policy):
                raise ValueError(f"controllers: expected NAME=POLICY, got {entry!r}")
            robots = [r for r in task.robots if name in ("all", team_of(r), r)]
            if not robots:
                raise ValueError(
                    f"controllers: expected a robot, a team or all of {task.name}, got {name!r}"
                )
            chosen |= dict.fromkeys(robots, policy)
        return chosen

    def _names(self, task: Task, robot: str, controllers: dict[str, Controller]) -> tuple[str, str]:
        """Names of the teams on the score board: the person's, and the other's policies."""
        others = [name for name in task.robots if team_of(name) != team_of(robot)]
        policies = dict.fromkeys(team_name(str(controllers[name])) for name in others)
        rival = " ".join(policies)
        return ("YOU", rival) if team_of(robot) == "blue" else (rival, "YOU")


def _rank(entry: str) -> int:
    """Order of an option NAME=POLICY: all robots, a team, a robot."""
    name = entry.partition("=")[0]
    return 0 if name == "all" else 1 if name in SIDES else 2
