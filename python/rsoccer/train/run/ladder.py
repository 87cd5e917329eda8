"""Ladder of a run: strength of the current policy against fixed opponents, measured as it learns.

Opponents of self-play improve with the policy, so its results against them show no progress. The
ladder plays the same matches with the same seeds each time, apart from those that it learns from.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Mask
from rsoccer.evaluate.episodes import RETURN, EpisodeRunner
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy
from rsoccer.policies.network import Network
from rsoccer.randomization import Ranges
from rsoccer.rng import WorldRng
from rsoccer.sources import SensingSource, SimulatorSource
from rsoccer.task import LEARN, Task
from rsoccer.train.clock import Clock
from rsoccer.train.opponents.policy_mix import PolicyMix
from rsoccer.train.rollout.episode_stats import Row, mean_or_nan
from rsoccer.train.run.log import ladder_column
from rsoccer.train.run.settings import RunSettings

OPPONENTS = ("zero", "ou", "chase", "scripted", "strike")
"""Opponents in tasks that two teams play, those of them that fit the task's robots."""
SEED = 2**40
"""Seed of the first match, the same in all runs and apart from the seeds of evaluations."""


class Ladder:
    """Measures the current policy in the same matches each time.

    Attributes:
        opponents: names of the opponents; empty if the task is played with its own robots.
        columns: columns of the log, one for each opponent, or one.
    """

    def __init__(
        self,
        settings: RunSettings,
        task: Task,
        threads: int,
        *,
        simulator: SimulatorSource | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
    ) -> None:
        """Choose the opponents.

        Args:
            settings: interval and number of matches.
            task: the task that is trained.
            threads: threads of the simulator, at least 1.
            simulator: moves the robots, as for `Matches`.
            sensing: what robots know of the true state, as for `Matches`.
            randomization: numbers that each episode draws, as for `Matches`.
        """
        self.opponents = tuple(filter(lambda name: _fits(name, task), OPPONENTS))
        if not task.two_sided:
            self.opponents = ()
        metric = task.success or RETURN
        self.columns = tuple(ladder_column(metric, name) for name in self.opponents or (None,))
        self._settings, self._task, self._threads = settings, task, threads
        self._simulator, self._sensing = simulator, sensing
        self._randomization = randomization

    def is_due(self, updates: int, *, last: bool) -> bool:
        """Return whether the policy is measured after an update; it is after the last one.

        Args:
            updates: number of updates.
            last: whether the update is the last one.
        """
        interval = self._settings.ladder_interval
        return interval > 0 and (last or updates % interval == 0)

    def measure(self, network: Network) -> Row:
        """Play the matches, on the task with its options for training.

        Args:
            network: the current policy, which plays as in training.

        Returns:
            Mean score by column.
        """
        count, threads = self._settings.ladder_matches, self._threads
        opponents = _InTurn(self._task, self.opponents) if self.opponents else None
        controllers = lineup(self._task, LEARN, opponents)
        before_step = None if opponents is None else opponents.play_in
        runner = EpisodeRunner(
            self._task,
            controllers,
            network,
            count,
            threads,
            before_step,
            simulator=self._simulator,
            sensing=self._sensing,
            randomization=self._randomization,
        )
        scores = runner.run(count, SEED).scores
        step = len(self.columns)
        return {name: mean_or_nan(scores[first::step]) for first, name in enumerate(self.columns)}

    def skip(self) -> Row:
        """Return the columns of an update without a measurement, NaN."""
        return dict.fromkeys(self.columns, float("nan"))


class _InTurn(PolicyMix):
    """Policies that take the worlds in turn, and act while their matches are played."""

    def __init__(self, task: Task, names: tuple[str, ...]) -> None:
        # Its time counts as the ladder's, not as that of the opponents in training.
        super().__init__(task, dict.fromkeys(names, 1.0), Clock())
        self._playing: Mask | None = None

    def play_in(self, playing: Mask) -> None:
        """Act in some worlds only: scripts are the larger part of the time.

        Args:
            playing: (n,) mask of these worlds.
        """
        self._playing = playing

    def _worlds_of(self, code: int, drawn: Array) -> NDArray[np.intp]:
        worlds = super()._worlds_of(code, drawn)
        return worlds if self._playing is None else worlds[self._playing[worlds]]

    def _draw(self, rng: WorldRng) -> Array:
        return np.arange(len(rng)) % len(self.kinds)


def _fits(name: str, task: Task) -> bool:
    """Whether a policy can drive the robots of a task."""
    try:
        make_policy(name, task)
    except ValueError:
        return False
    return True
