"""Description of a study: experiments with their settings, and the runs that they consist of."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final

PPO: Final = "ppo"
SB3: Final = ("ddpg", "sac")
CLONES: Final = "clones"
ALGORITHMS: Final = (PPO, *SB3, CLONES)
AS_TRAINED: Final = {"network.play_action_repeat": None}
"""Policies decide as often as in their training, so that their rate is no second difference."""


@dataclass(frozen=True)
class Experiment:
    """One variant: a task, an algorithm and its settings.

    Raises:
        ValueError: An unknown algorithm, or a name that is no name of a file.
    """

    group: str
    """Part of the study: ppo, baselines, calibration, ablation, cooperation, robust or
    robust-shipped."""
    name: str
    """Name, unique in its group; also that of the folder with its runs."""
    task: str
    """Registered task that is learned and evaluated."""
    algorithm: str = PPO
    """"ppo" of the package, "ddpg" or "sac" of Stable-Baselines3, or "clones", which learns
    nothing: it evaluates the policy of another experiment, or one of the package."""
    settings: Mapping[str, Any] = field(default_factory=dict)
    """Settings that differ from the defaults of the algorithm; for PPO, from those recommended for
    the task."""
    seeds: int = 5
    """Number of runs."""
    opponents: tuple[str | None, ...] | None = None
    """Opponents of the evaluation: names, or the policy of another experiment as "@group/name", of
    the same seed. None is the task's own; by default those of `evaluation.opponents_of`."""
    needs: tuple[Experiment, ...] = ()
    """Experiments of which the same seed has to be finished before. A change of their settings
    makes the runs of this one stale, too."""
    text: str = ""
    """Description for tables."""
    conditions: tuple[str, ...] = ()
    """Conditions of the evaluation, names in `senses.CONDITIONS`, in which the first opponent is
    met; none for the true state, all opponents and all modes."""
    senses: Mapping[str, float] = field(default_factory=dict)
    """Numbers of `Sensing` that the policy needs in each of these conditions."""

    def __post_init__(self) -> None:
        """Check the names."""
        if self.algorithm not in ALGORITHMS:
            raise ValueError(f"algorithm must be one of {ALGORITHMS}, got {self.algorithm!r}")
        for name in (self.group, self.name):
            if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9.+=_-]*", name):
                raise ValueError(f"group and name must be names of files, got {name!r}")

    @property
    def key(self) -> str:
        """Group and name."""
        return f"{self.group}/{self.name}"


@dataclass(frozen=True)
class Run:
    """One seed of an experiment."""

    experiment: Experiment
    seed: int

    @property
    def key(self) -> str:
        """Group, name and seed, as in the path of its files."""
        return f"{self.experiment.key}/seed-{self.seed}"

    @property
    def needs(self) -> tuple[Run, ...]:
        """Runs that have to be finished before."""
        return tuple(Run(experiment, self.seed) for experiment in self.experiment.needs)


@dataclass(frozen=True)
class Protocol:
    """The evaluation of every policy of a study."""

    starts: int = 500
    """Initial states; in two-sided tasks every side has as many."""
    seed: int = 31
    """Seed of the initial states. `rsoccer.evaluate` hashes it to 63 bits, as the trainer hashes
    its seeds, so training and evaluation share no match."""


@dataclass(frozen=True)
class Study:
    """Experiments and the protocol of their evaluation.

    Raises:
        ValueError: Two experiments of the same key, or one that another needs is not in the study.
    """

    experiments: tuple[Experiment, ...]
    protocol: Protocol = Protocol()

    def __post_init__(self) -> None:
        """Check the keys."""
        keys = [experiment.key for experiment in self.experiments]
        if twice := sorted({key for key in keys if keys.count(key) > 1}):
            raise ValueError(f"expected experiments of different keys, got twice: {twice}")
        needed = {need.key for experiment in self.experiments for need in experiment.needs}
        if unknown := sorted(needed - set(keys)):
            raise ValueError(f"expected needs from the study's experiments, got {unknown}")

    def runs(self) -> list[Run]:
        """Return all runs; those of a group by seed, so that every experiment starts early."""
        groups = dict.fromkeys(experiment.group for experiment in self.experiments)
        return [
            Run(experiment, seed)
            for group in groups
            for seed in range(max(e.seeds for e in self.experiments if e.group == group))
            for experiment in self.experiments
            if experiment.group == group and seed < experiment.seeds
        ]

    def run(self, key: str) -> Run:
        """Return the run of a key.

        Raises:
            ValueError: There is none.
        """
        for run in self.runs():
            if run.key == key:
                return run
        raise ValueError(f"the study has no run {key!r}")
