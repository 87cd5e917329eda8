"""The algorithms of a study by name: their settings, and their learning."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from benches.learning import ppo_run
from benches.learning.experiments import PPO, Run
from benches.learning.learned import Learned
from benches.learning.run_files import Folders


def settings(run: Run) -> dict[str, Any]:
    """Return all settings that decide the result of a run, as JSON values.

    Raises:
        TypeError: The algorithm has no such setting.
        ValueError: A setting outside its range.
    """
    return ppo_run.settings(run)


def defaults(run: Run) -> dict[str, Any]:
    """Return the defaults of settings that a result may lack, as it is older than the setting."""
    return ppo_run.defaults()


def samples_so_far(run: Run, folder: Path) -> int | None:
    """Return the samples of an unfinished run that can continue; None for a new one."""
    return ppo_run.samples_so_far(folder)


def learn(run: Run, folder: Path, folders: Folders) -> Learned:
    """Learn a policy.

    Args:
        run: The run.
        folder: Folder for its files.
        folders: Folders of the study.
    """
    assert run.experiment.algorithm == PPO
    return ppo_run.learn(run, folder)
