"""Evaluation of a policy in a task that it has not learned, such as three clones of one robot."""

from __future__ import annotations

from typing import Any

from benches.learning.experiments import Run
from benches.learning.learned import Learned
from benches.learning.run_files import Folders, reference


def settings(run: Run) -> dict[str, Any]:
    """Return the settings of a run: the experiment whose policy is evaluated.

    Raises:
        TypeError: An unknown setting, or none.
    """
    if set(run.experiment.settings) != {"policy"}:
        raise TypeError(f"expected the setting 'policy', got {sorted(run.experiment.settings)}")
    return dict(run.experiment.settings)


def learn(run: Run, folders: Folders) -> Learned:
    """Return the policy of the same seed of another experiment."""
    policy = str(reference(folders, settings(run)["policy"], run))
    curve: dict[str, Any] = {"metric": "", "samples": [], "seconds": [], "values": []}
    return Learned({"sample": policy, "mean": f"{policy}:mean"}, 0, curve, {})
