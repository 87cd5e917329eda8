"""Policies for robots that no client drives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.bridge.match_tasks import TICK
from rsoccer.controllers import Assignment, Controllers, assign
from rsoccer.matches import result_checks
from rsoccer.matches.sensing import forecasting_teams
from rsoccer.play import Play
from rsoccer.policies.base import CommandPolicy
from rsoccer.protocols.layout import TEAM_NAMES
from rsoccer.rng import WorldRng
from rsoccer.tasks.match import Match

PERIOD: Final = 0.025
"""Time between two actions of a policy, s: the control step of the tasks."""
NOBODY_PLAYS: Final = "zero"
"""Policy of robots that stand still."""


class StandIns:
    """Policies of a match.

    Attributes:
        observers: robots whose policies observe the match, in the order of a state row.
        forecasting: teams, "blue" or "yellow", whose policies play from a forecast.
        are_there: whether any team has a policy.
        restrain: what a referee makes of their (robots, command) commands; None for no referee
            that they may not know.
    """

    def __init__(self, task: Match, blue: str | None, yellow: str | None, seed: int = 0) -> None:
        """Load the policies.

        Args:
            task: the match.
            blue: name or file of blue's policy; None if its robots stand still without a client.
            yellow: the same of yellow.
            seed: seed of their random numbers.

        Raises:
            ValueError: an unknown policy, or one that does not fit the match.
        """
        given = (blue, yellow)
        controllers: Controllers = {
            team: NOBODY_PLAYS if name is None else name
            for team, name in zip(TEAM_NAMES, given, strict=True)
        }
        assignment = _assign(task, controllers)
        self.observers: list[int] = assignment.observers.tolist()
        self.forecasting = forecasting_teams(task, assignment, None, together=False)
        self._plays = tuple(name is not None for name in given)
        self.are_there = any(self._plays)
        self.restrain: Callable[[Floats], Floats] | None = None
        self._task = task
        self._groups = assignment.groups
        root = WorldRng.seeded(seed, 1)
        for group in self._groups:
            group.restart(np.zeros(1, np.intp), root.split(group.name), task.action_size)
        shape = (1, len(self.observers), task.layout.size)
        self._observations = np.zeros(shape, np.float32)
        self._observes = any(group.policy.observes == "observation" for group in self._groups)
        self._every = round(PERIOD / TICK)
        robots, columns = task.config.n_robots, len(task.config.command_columns)
        self._commands: Floats = np.zeros((robots, columns), np.float32)

    def plays(self, team: int) -> bool:
        """Return whether a team has a policy.

        Args:
            team: `BLUE` or `YELLOW`.
        """
        return self._plays[team]

    def is_due(self, ticks: int) -> bool:
        """Return whether policies act in a tick.

        Args:
            ticks: ticks since the start.
        """
        return ticks % self._every == 0

    def act(self, play: Play) -> Floats:
        """Let the policies act.

        Args:
            play: state of the match, with what robots know.

        Returns:
            (robots, command) their commands, which hold until the next call.
        """
        if self._observes:
            self._task.layout.observe(play, out=self._observations)
        actions = np.zeros_like(play.actions)
        for group in self._groups:
            group.act(play, self._observations, actions)
        commands = self._task.get_commands(play, actions)
        commands = result_checks.commands(self._task, commands, play.commands.shape)
        for group in self._groups:
            if isinstance(group.policy, CommandPolicy):
                group.command(play, self._observations, commands)
        play.actions = actions
        self._commands = commands[0] if self.restrain is None else self.restrain(commands[0])
        return self._commands

    @property
    def commands(self) -> Floats:
        """(robots, command) commands of the last call of `act`."""
        return self._commands


def _assign(task: Match, controllers: Controllers) -> Assignment:
    """Robots of the policies; an error names the team whose policy is refused."""
    try:
        return assign(task, controllers, 1, by_team=True)  # each may forecast
    except ValueError:
        for team, policy in controllers.items():
            alone: Controllers = {**dict.fromkeys(TEAM_NAMES, NOBODY_PLAYS), team: policy}
            try:
                assign(task, alone, 1, by_team=True)
            except ValueError as error:
                raise ValueError(f"{team}: {error}") from error
        raise
