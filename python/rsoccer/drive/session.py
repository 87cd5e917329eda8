"""A policy that drives a team: the matches of `rsoccer drive`."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from rsoccer._core import Sensing
from rsoccer.arrays import Floats
from rsoccer.controllers import Controller
from rsoccer.drive.connection import Connection
from rsoccer.drive.link import Link
from rsoccer.drive.network import forecasting
from rsoccer.drive.officials import Officials
from rsoccer.drive.settings import Settings
from rsoccer.drive.simulator import UntouchedNetwork
from rsoccer.lineup import lineup
from rsoccer.matches import Matches, Outcome
from rsoccer.play import Play
from rsoccer.policies import make_policy
from rsoccer.policies.base import Policy
from rsoccer.rules.base import Restart, Rule
from rsoccer.rules.referee import RefereeRule
from rsoccer.task import Task
from rsoccer.tasks.match import Match

STANDING = "zero"
"""Policy of robots that nobody here drives."""


class ObeyedReferee(RefereeRule):
    """The referee of a match task, whose state is what a referee on the network tells."""

    def __init__(self, task: Match, officials: Officials) -> None:
        """Prepare the rule.

        Args:
            task: the match.
            officials: the referee on the network.
        """
        super().__init__(task.config, task.referee_config)
        self._officials, self._n_blue = officials, task.config.n_blue

    def judge(self, play: Play) -> Restart | None:
        """Take over what the referee reports; it restarts play, nobody here does.

        Before its first packet the match goes on by the rules of the task, unless a referee is
        required.
        """
        if self._officials.is_awaited:
            return super().judge(play)
        self._officials.reported.write(play.game, self._n_blue)
        return None


class Session:
    """A match in which one team is driven.

    Attributes:
        connection: the connection.
        matches: matches of one world, without learners.
        episodes: metrics of the episodes that ended, by name.
    """

    def __init__(
        self,
        policy: str | Policy,
        task: Task,
        settings: Settings,
        *,
        delay: float = 0.0,
        cameras: str | Sensing | None = None,
        seed: int = 0,
        link: Link | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Open the connection.

        Args:
            policy: the policy, its name or its file, in the place of the task's learners.
            task: the task that it plays; blue is the team that is driven, whatever its color.
            settings: the settings.
            delay: time from a command until vision shows its effect, s: policies know the state
                after it. 0 for the state of the newest frame.
            cameras: senses whose noise and frame rate those of the cameras are; None for those of
                "rc2021" at 60 Hz.
            seed: seed of the policy's random numbers.
            link: what carries datagrams; None for sockets.
            clock: time on the wall, s.

        Raises:
            OSError: a port is taken, or an address is not one of this machine.
            ValueError: a policy that does not fit the task, one that has learned behind a forecast
                without a delay, or settings that do not fit.
        """
        sensing = forecasting(delay, cameras)
        config = task.config.with_sensing(sensing)
        rules = task.referee_config if isinstance(task, Match) else None
        self.connection = Connection(config, settings, rules=rules, link=link, clock=clock)
        try:
            if not delay and make_policy(policy, task).needs_forecast:
                raise ValueError(
                    "delay: expected that of the robots, in s, for a policy that has learned "
                    f"behind a forecast, got {delay:g}; `rsoccer identify` measures it"
                )
            opponent: Controller | None = STANDING if task.config.n_yellow else None
            controllers = lineup(task, policy, opponent, "blue")
            if isinstance(task, Match) and settings.referee != "ignore":
                task = _under(task, self.connection.officials)
            self.matches = Matches(
                task,
                seed=seed,
                controllers=controllers,
                simulator=UntouchedNetwork(self.connection),
                sensing=sensing,
            )
        except BaseException:
            self.connection.close()
            raise
        self.episodes: list[dict[str, float]] = []
        shape = (1, len(self.matches.agents), self.matches.action_size)
        self._actions: Floats = np.zeros(shape, np.float32)

    def begin(self) -> None:
        """Wait until all robots and the ball are in sight.

        Raises:
            ConnectionError: they are not for `Settings.patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        self.matches.reset()
        officials, settings = self.connection.officials, self.connection.settings
        if not officials.packets and settings.referee == "require":
            place = f"{settings.group_hosts['referee']}:{settings.port_numbers['referee']}"
            self.connection.tell(
                f"referee: none heard at {place} so far; robots stand until one is"
            )
        elif officials.is_awaited and isinstance(self.matches.task, Match):
            self.connection.tell(
                "referee: none heard so far; the rules of the task hold until then"
            )

    def step(self) -> Outcome:
        """Drive for a control step.

        Returns:
            What `Matches.step` returns.

        Raises:
            ConnectionError: there are no frames for `Settings.patience`.
            RuntimeError: the simulator refuses all commands, the guard has ended, or this program
                is late in many steps in a row.
        """
        outcome = self.matches.step(self._actions)
        if outcome.episodes is not None:
            metrics = outcome.episodes.metrics
            self.episodes.append({name: float(values[0]) for name, values in metrics.items()})
        return outcome

    def close(self) -> None:
        """Stop the robots and close the connection."""
        self.matches.close()


def _under(task: Match, officials: Officials) -> Match:
    """A match task under another referee."""
    others: Sequence[Rule] = [rule for rule in task.rules if not isinstance(rule, RefereeRule)]
    driven = replace(task)
    # `rules` is a cached property, so a value in the place of its result is what it returns.
    vars(driven)["rules"] = (ObeyedReferee(driven, officials), *others)
    return driven
