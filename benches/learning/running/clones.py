"""Evaluation of a policy in a task that it has not learned, such as three clones of one robot."""

from __future__ import annotations

from typing import Any

from benches.learning.experiments import Run
from benches.learning.run_files import Folders
from benches.learning.running.learned import Learned
from benches.learning.running.workplace import reference


def learn(run: Run, folders: Folders) -> Learned:
    """Return the policy of the same seed of another experiment."""
    policy = str(reference(folders, run.experiment.settings["policy"], run))
    curve: dict[str, Any] = {"metric": "", "samples": [], "seconds": [], "values": []}
    return Learned({"sample": policy, "mean": f"{policy}:mean"}, 0, curve, {})
