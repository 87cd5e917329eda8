"""Runs of the package's own trainer, which resume from its checkpoint."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benches.learning import ppo_settings
from benches.learning.experiments import Run
from benches.learning.running.clock import timed
from benches.learning.running.curves import thinned
from benches.learning.running.learned import Learned
from rsoccer.arrays import Array
from rsoccer.registry import make_task
from rsoccer.train.run.ladder import OPPONENTS
from rsoccer.train.run.log import ladder_column


def samples_so_far(folder: Path) -> int | None:
    """Return the samples of the checkpoint in a folder; None without one that can be read."""
    from rsoccer.train.run import checkpoint

    try:
        return int(checkpoint.load(folder / checkpoint.FILE_NAME).info["samples"])
    except ValueError:
        return None


def forget(folder: Path) -> None:
    """Remove the checkpoint in a folder, if there is one."""
    from rsoccer.train.run import checkpoint

    (folder / checkpoint.FILE_NAME).unlink(missing_ok=True)


def learn(run: Run, folder: Path) -> Learned:
    """Train a policy, from the last checkpoint if there is one.

    Args:
        run: The run.
        folder: Folder for its files.

    Returns:
        The policy.

    Raises:
        Interrupted: A signal came; the checkpoint is saved.
    """
    from rsoccer.train import train
    from rsoccer.train.run.log import read_progress

    wanted = ppo_settings.args(run, folder)
    resume = samples_so_far(folder) is not None
    with timed(folder):
        policy = str(train(dataclasses.replace(wanted, resume=resume, overwrite=not resume)))
    progress = read_progress(folder)
    metric = make_task(run.experiment.task).success or "reward"
    seconds, samples = progress["seconds"], progress["samples"]
    values, weights = strength(progress, metric)
    extra = {"updates": len(samples), "trainer_seconds": round(float(seconds[-1]), 1)}
    return Learned(
        policies={"sample": policy, "mean": f"{policy}:mean"},
        samples=int(samples[-1]),
        curve=thinned(metric, samples, seconds, values, weights),
        extra={**extra, "ladder": ladder_curves(progress, metric)},
    )


def ladder_curves(progress: Mapping[str, Array], metric: str) -> dict[str, Any]:
    """Return the curves of the ladder by opponent; empty for a task without opponents.

    Args:
        progress: Columns of the run's log.
        metric: Metric of the task.
    """
    found = {}
    for opponent in OPPONENTS:
        values = progress.get(ladder_column(metric, opponent))
        if values is not None:
            weights = np.ones(len(values))
            found[opponent] = thinned(
                metric, progress["samples"], progress["seconds"], values, weights
            )
    return found


def strength(progress: Mapping[str, Array], metric: str) -> tuple[Array, Array]:
    """Return the values of a run's curve and their weights, (updates,) each.

    The ladder, which plays the same matches each time, comes first. Opponents of self-play change,
    so of its own matches those against `ou` count.

    Args:
        progress: Columns of the run's log.
        metric: Metric of the task.
    """
    episodes = progress["episodes"]
    columns = (f"ladder_ou_{metric}", f"ladder_{metric}", f"episode_ou/{metric}")
    for name in columns:
        values = progress.get(name)
        if values is not None and np.isfinite(values).any():
            return values, np.ones(len(values)) if name.startswith("ladder") else episodes
    return progress[f"episode/{metric}"], episodes
