"""Results of a study for its report, by experiment."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from benches.learning import conditions, run_files
from benches.learning.experiments import Experiment, Run, Study
from benches.learning.reporting.statistics import Estimate, iqm
from benches.learning.run_files import Folders

Result = Mapping[str, Any]


@dataclass(frozen=True)
class Collected:
    """Results of one experiment, of the same settings."""

    experiment: Experiment
    results: tuple[Result, ...]
    """Results by seed; missing ones are left out."""
    stale: bool
    """The settings have changed since these results."""

    @property
    def missing(self) -> int:
        """Number of seeds without a result."""
        return self.experiment.seeds - len(self.results)

    @property
    def opponents(self) -> tuple[str, ...]:
        """Opponents of the evaluation, in order; "-" is the task's own."""
        rows = self.results[0]["evaluations"] if self.results else ()
        return tuple(dict.fromkeys(row["opponent"] for row in rows))

    @property
    def modes(self) -> tuple[str, ...]:
        """Modes of the policies; the first is the policies' own."""
        rows = self.results[0]["evaluations"] if self.results else ()
        return tuple(dict.fromkeys(row["mode"] for row in rows))

    def rows(self, opponent: str | None = None, mode: str | None = None) -> list[Result]:
        """Return an evaluation of every seed; by default against the first opponent, own mode."""
        wanted = (opponent or self.opponents[0], mode or self.modes[0])
        rows = [row for result in self.results for row in result["evaluations"]]
        return [row for row in rows if (row["opponent"], row["mode"]) == wanted]

    def scores(self, opponent: str | None = None, mode: str | None = None) -> list[float]:
        """Return the score of every seed."""
        return [float(row["score"]) for row in self.rows(opponent, mode)]

    def estimate(self, opponent: str | None = None, mode: str | None = None) -> Estimate:
        """Return the interquartile mean over the seeds."""
        return iqm(self.scores(opponent, mode))

    def full_success(self) -> Estimate:
        """Return the interquartile mean of the share of episodes with full success."""
        return iqm([row["decided"] / row["matches"] for row in self.rows()])

    def metric(self, name: str, opponent: str | None = None) -> Estimate:
        """Return the interquartile mean of another metric of the task, a mean over the matches."""
        return iqm([float(row["metrics"][name]) for row in self.rows(opponent)])

    def core_seconds(self) -> float:
        """Return the processor time of learning, a mean over the seeds."""
        seconds = [float(r.get("learning_seconds", r["seconds"]["cpu"])) for r in self.results]
        return sum(seconds) / len(seconds)

    def samples(self) -> float:
        """Return the samples of a run, a mean over the seeds."""
        return sum(float(result["samples"]) for result in self.results) / len(self.results)


def collect(study: Study, folders: Folders, group: str | None = None) -> list[Collected]:
    """Return the results of each experiment, in the order of the study.

    Args:
        study: The study.
        folders: Folders of its results.
        group: Only experiments of this group; None for all.
    """
    experiments = [e for e in study.experiments if group in (None, e.group)]
    return [_collected(experiment, study, folders) for experiment in experiments]


def finished(collected: Sequence[Collected], group: str) -> list[Collected]:
    """Return the experiments of a group that have results."""
    return [part for part in collected if part.results and part.experiment.group == group]


def find(collected: Sequence[Collected], task: str, algorithm: str = "ppo") -> Collected | None:
    """Return the experiment of an algorithm on a task, PPO or a baseline, if it has results."""
    parts = [*finished(collected, "ppo"), *finished(collected, "baselines")]
    wanted = (task, algorithm)
    return next((p for p in parts if (p.experiment.task, p.experiment.algorithm) == wanted), None)


def _collected(experiment: Experiment, study: Study, folders: Folders) -> Collected:
    """Current results; stale ones only if there are no others."""
    current: list[Result] = []
    stale: list[Result] = []
    for seed in range(experiment.seeds):
        run = Run(experiment, seed)
        result = run_files.load(folders, run.key)
        if result is not None:
            (stale if _changed(run, study, folders, result) else current).append(result)
    # Stale results may be of several settings, which must not mix: those of the last seed stay.
    stale = [r for r in stale if r["settings"] == stale[-1]["settings"]]
    return Collected(experiment, tuple(current or stale), bool(stale and not current))


def _changed(run: Run, study: Study, folders: Folders, result: Result) -> bool:
    """Whether a result is of other settings than the run has now."""
    try:
        settings = conditions.settings(run)
    except (TypeError, ValueError):
        return True
    return bool(conditions.differences(run, study, folders, settings, result))
