"""The algorithms of a study by name: their settings, and their learning."""

from __future__ import annotations

from collections.abc import Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from benches.learning import clones, ppo_run, run_files, sb3_run
from benches.learning.clock import restart_clock
from benches.learning.experiments import CLONES, PPO, SB3, Run
from benches.learning.learned import Learned
from benches.learning.run_files import Folders
from rsoccer._core import build_info
from rsoccer.registry import make_task
from rsoccer.train.network.observation_mask import observation_mask


def settings(run: Run) -> dict[str, Any]:
    """Return all settings that decide the result of a run, as JSON values.

    `observation`, the blocks of the observation and their shapes, is not set but compared.

    Raises:
        TypeError: The algorithm has no such setting.
        ValueError: A setting outside its range.
    """
    values = _settings_of_algorithm(run)
    task = make_task(run.experiment.task, **values.get("task_options", {}))
    for name in ("network.masked_observations", "masked_observations"):
        observation_mask(task, values.get(name, ()))  # refuses unknown parts
    return {**values, "observation": task.layout}


def _settings_of_algorithm(run: Run) -> dict[str, Any]:
    algorithm = run.experiment.algorithm
    if algorithm == PPO:
        return ppo_run.settings(run)
    return clones.settings(run) if algorithm == CLONES else sb3_run.settings(run)


def missing_library(run: Run) -> str:
    """Return the name of a library that a run needs and that is not installed, or an empty text."""
    names = {PPO: "torch", **dict.fromkeys(SB3, "stable_baselines3")}
    name = names.get(run.experiment.algorithm)
    return name if name and find_spec(name) is None else ""


def defaults(run: Run) -> dict[str, Any]:
    """Return the defaults of settings that a result may lack, as it is older than the setting."""
    algorithm = run.experiment.algorithm
    if algorithm == PPO:
        return ppo_run.defaults()
    return {} if algorithm == CLONES else sb3_run.defaults()


def without_effect(run: Run) -> frozenset[str]:
    """Return the names of settings that leave the result of a run as it is."""
    return ppo_run.without_effect(run) if run.experiment.algorithm == PPO else frozenset()


def samples_so_far(run: Run, folder: Path) -> int | None:
    """Return the samples of an unfinished run that can continue; None for a new one."""
    return ppo_run.samples_so_far(folder) if run.experiment.algorithm == PPO else None


def conditions(run: Run, folders: Folders) -> dict[str, Any]:
    """Return all that decides what a run learns, as JSON values, for its result.

    Args:
        run: The run.
        folders: Folders with the results of the runs that it needs.
    """
    return {
        "settings": settings(run),
        "physics": build_info()["physics"],
        "needs": run_files.needs(folders, run),
    }


def learn(run: Run, folder: Path, folders: Folders, identity: Mapping[str, Any]) -> Learned:
    """Learn a policy, from the checkpoint of an interrupted run with the same settings.

    Args:
        run: The run.
        folder: Folder for its files.
        folders: Folders of the study.
        identity: Conditions of the run, from `conditions`.

    Returns:
        The policy, and how it was learned.
    """
    algorithm = run.experiment.algorithm
    if not run_files.is_same(folder, identity):
        (folder / run_files.LEARNED_FILE).unlink(missing_ok=True)
        ppo_run.forget(folder)
        restart_clock(folder)
        run_files.set_identity(folder, identity)
    if algorithm == PPO:
        return ppo_run.learn(run, folder)
    if algorithm == CLONES:
        return clones.learn(run, folders)
    return sb3_run.learn(run, folder)
