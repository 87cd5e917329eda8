"""Evaluation of a policy that another experiment has learned, or of one of the package."""

from __future__ import annotations

from typing import Any

from benches.learning.experiments import Run
from benches.learning.run_files import Folders
from benches.learning.running.learned import Learned
from benches.learning.running.workplace import reference


def learn(run: Run, folders: Folders) -> Learned:
    """Return the policy of the same seed of another experiment, or of its name."""
    name = str(run.experiment.settings["policy"])
    policy = str(reference(folders, name, run)) if name.startswith("@") else name
    curve: dict[str, Any] = {"metric": "", "samples": [], "seconds": [], "values": []}
    return Learned({"sample": policy, "mean": f"{policy}:mean"}, 0, curve, {})
