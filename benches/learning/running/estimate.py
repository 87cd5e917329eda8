"""Expected time of the open runs of a study, from the finished ones."""

from __future__ import annotations

import statistics
from collections.abc import Mapping, Sequence
from typing import Any, Final

from benches.learning import conditions
from benches.learning.experiments import CLONES, PPO, SB3, Run
from benches.learning.running.status import Status

SAMPLES_PER_SECOND: Final = {PPO: 8_000.0, **dict.fromkeys(SB3, 800.0)}
"""Guess for algorithms of which no run has finished yet."""


def expected_seconds(run: Run, known: Sequence[Status]) -> float:
    """Return the expected seconds of a run, evaluation included, from finished runs.

    Args:
        run: The run.
        known: States of all runs.
    """
    results = [entry.result for entry in known if entry.result]
    same = [r for r in results if r["run"].startswith(f"{run.experiment.key}/")]
    task, algorithm = run.experiment.task, run.experiment.algorithm
    if algorithm == CLONES:  # they learn nothing
        return statistics.median(_seconds(result) for result in same) if same else 0.0
    samples = conditions.settings(run)["samples"]
    alike = (
        same,  # their number of samples may have been another
        [r for r in results if (r["task"], r["algorithm"]) == (task, algorithm)],
        [r for r in results if r["algorithm"] == algorithm],
    )
    for group in alike:
        rates = [r["samples"] / _seconds(r) for r in group if r["samples"]]
        if rates:
            return float(samples / statistics.median(rates))
    return float(samples / SAMPLES_PER_SECOND[algorithm])


def _seconds(result: Mapping[str, Any]) -> float:
    return float(max(result["seconds"]["wall"] + result["evaluation_seconds"], 1.0))
