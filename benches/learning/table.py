"""The experiments of the study: tasks, algorithms and variants with their settings.

Change a line, and `python -m benches.learning --list` shows the runs that it makes stale.
"""

from __future__ import annotations

from typing import Any, Final

from benches.learning.experiments import Experiment, Study

M: Final = 1_000_000

PPO_SETTINGS: Final[dict[str, dict[str, Any]]] = {
    "VSS-v0": {"samples": 10 * M},
    "VSSMulti-v0": {"samples": 20 * M},
    "VSSSelfPlay-v0": {"samples": 20 * M},
    "SSLGoToBall-v0": {"samples": 3 * M},
    "SSLPassEndurance-v0": {"samples": 5 * M},
    "SSLContestedPossession-v0": {"samples": 10 * M},
    "SSLStaticDefenders-v0": {"samples": 10 * M},
    "SSLDribbling-v0": {"samples": 10 * M},
    "SSLPassEnduranceMulti-v0": {"samples": 20 * M},
    "SSLSelfPlay-v0": {"samples": 20 * M},
}
"""Settings of each task that differ from the defaults of `rsoccer.train.Args`."""

PPO_RUNS: Final = tuple(
    Experiment("ppo", task, task, settings=settings, text=f"PPO on {task}")
    for task, settings in PPO_SETTINGS.items()
)

STUDY: Final = Study(PPO_RUNS)
