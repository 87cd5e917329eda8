"""Matches of a team with some of its robots replaced, from equal starts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rsoccer.arrays import Doubles
from rsoccer.controllers import Controller
from rsoccer.evaluate.episodes import EpisodeRunner, Episodes
from rsoccer.evaluate.schedule import first_seed
from rsoccer.evaluate.team_play import MEASURES, TeamPlayRecorder
from rsoccer.frame import team_of
from rsoccer.lineup import learning_team, lineup
from rsoccer.policies.base import Policy
from rsoccer.randomization import Ranges
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import LEARN, Learn, Task
from rsoccer.view import SIDES


@dataclass(frozen=True)
class Played:
    """Results of a line-up from each side, in the order of the starts."""

    metric: str
    """metric of the scores"""
    scores: list[Doubles]
    """(n,) of the team, per side"""
    measures: dict[str, list[Doubles]]
    """(n,) per side, by measure"""


@dataclass(frozen=True)
class Team:
    """Matches of a team with some robots replaced."""

    task: Task
    """task that is played"""
    opponent: Policy | None
    """policy of the other team; None for the task's own"""
    per_side: int
    """matches of each side"""
    seed: int
    """seed of the starts"""
    worlds: int
    """matches played at once"""
    threads: int
    """threads of the simulator"""
    simulator: SimulatorSource | None
    """moves the robots, as for `Matches`"""
    sensing: SensingSource | None
    """senses of the robots, as for `Matches`"""
    randomization: Ranges | None
    """numbers that each episode draws, as for `Matches`"""

    @property
    def sides(self) -> tuple[str, ...]:
        """Sides that the team plays."""
        return SIDES if self.task.two_sided else (team_of(learning_team(self.task)[0]),)

    def controllers(self, index: int) -> dict[str, Controller]:
        """Return controllers by robot, with `LEARN` for the team's policy.

        Args:
            index: index of the side that the team plays.
        """
        side = self.sides[index] if self.task.two_sided else None
        return lineup(self.task, LEARN, self.opponent, side)

    def learners(self, index: int) -> list[str]:
        """Return the robots that the policy drives.

        Args:
            index: index of the side that the team plays.
        """
        given = self.controllers(index).items()
        return [name for name, each in given if isinstance(each, Learn)]

    def play(self, policy: Policy, replacement: Policy | None) -> Played:
        """Play all matches, with each robot replaced in an equal share of them.

        Args:
            policy: policy of the team.
            replacement: policy of the robot that is replaced; None for none.

        Returns:
            Results from each side, in the order of the starts.

        Raises:
            ValueError: a team of one robot.
        """
        sets = [self._replaceable(index, replacement) for index in range(len(self.sides))]
        return self._play(policy, replacement, sets)

    def play_halves(self, first: Policy, second: Policy) -> Played:
        """Play all matches with half of the robots of each policy, in half of them the other way.

        Args:
            first: policy of the first robots, and of the last ones.
            second: policy of the others.

        Returns:
            Results from each side, in the order of the starts.
        """
        sets = []
        for index in range(len(self.sides)):
            robots = self.learners(index)
            middle = len(robots) // 2
            sets.append([robots[middle:], robots[:middle]])
        return self._play(first, second, sets)

    def _replaceable(self, index: int, replacement: Policy | None) -> list[list[str]]:
        """Sets of robots that are replaced, each in an equal share of the matches."""
        robots = self.learners(index)
        if len(robots) < 2:
            side = self.sides[index]
            robots = [name for name in self.task.robots if team_of(name) == side]
            robots = [name for name in robots if name not in self.learners(index)]
        if not robots:
            raise ValueError(
                f"task: expected one with at least two robots a team, got {self.task.name}"
            )
        return [[]] if replacement is None else [[name] for name in robots]

    def _play(
        self, policy: Policy, replacement: Policy | None, sets: list[list[list[str]]]
    ) -> Played:
        """Play all matches from each side, with sets of robots replaced in turn."""
        scores: list[Doubles] = []
        measures: dict[str, list[Doubles]] = {name: [] for name in MEASURES}
        metric = ""
        for index, side in enumerate(self.sides):
            recorder = TeamPlayRecorder(self.task, side)
            parts: list[Episodes] = []
            start = 0
            shares = np.array_split(np.arange(self.per_side), len(sets[index]))
            for robots, share in zip(sets[index], shares, strict=True):
                if len(share):
                    controllers = self.controllers(index)
                    if replacement is not None:
                        controllers |= dict.fromkeys(robots, replacement)
                    runner = self._runner(controllers, policy, recorder)
                    parts.append(runner.run(len(share), first_seed(self.seed, index) + start))
                    start += len(share)
            metric = parts[0].metric
            sign = 1.0 if side == self.sides[0] else -1.0
            scores.append(np.concatenate([part.scores for part in parts]) * sign + 0.0)
            for name, values in recorder.means().items():
                measures[name].append(values)
        return Played(metric, scores, measures)

    def _runner(
        self, controllers: dict[str, Controller], policy: Policy, recorder: TeamPlayRecorder
    ) -> EpisodeRunner:
        return EpisodeRunner(
            self.task,
            controllers,
            policy,
            self.worlds,
            self.threads,
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
            recorder=recorder,
        )
