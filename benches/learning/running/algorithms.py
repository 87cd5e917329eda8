"""The algorithms of a study by name: their learning."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from benches.learning.experiments import CLONES, PPO, Run
from benches.learning.run_files import Folders
from benches.learning.running import clones, ppo_run, sb3_run, workplace
from benches.learning.running.clock import restart_clock
from benches.learning.running.learned import Learned


def samples_so_far(run: Run, folder: Path) -> int | None:
    """Return the samples of an unfinished run that can continue; None for a new one."""
    return ppo_run.samples_so_far(folder) if run.experiment.algorithm == PPO else None


def learn(run: Run, folder: Path, folders: Folders, identity: Mapping[str, Any]) -> Learned:
    """Learn a policy, from the checkpoint of an interrupted run with the same settings.

    Args:
        run: The run.
        folder: Folder for its files.
        folders: Folders of the study.
        identity: Conditions of the run, from `conditions.conditions`.

    Returns:
        The policy, and how it was learned.
    """
    algorithm = run.experiment.algorithm
    if not workplace.is_same(folder, identity):
        (folder / workplace.LEARNED_FILE).unlink(missing_ok=True)
        ppo_run.forget(folder)
        restart_clock(folder)
        workplace.set_identity(folder, identity)
    if algorithm == PPO:
        return ppo_run.learn(run, folder)
    if algorithm == CLONES:
        return clones.learn(run, folders)
    return sb3_run.learn(run, folder)
