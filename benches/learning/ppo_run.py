"""Runs of the package's own trainer, which resume from its checkpoint."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.learning.clock import timed
from benches.learning.curves import thinned
from benches.learning.experiments import Run
from benches.learning.learned import Learned
from rsoccer.arrays import Array
from rsoccer.lineup import learning_team
from rsoccer.registry import make_task
from rsoccer.train import Args, RunSettings
from rsoccer.train.args import CHANGEABLE_ON_RESUME
from rsoccer.train.run.ladder import OPPONENTS
from rsoccer.train.run.log import ladder_column

NOT_COMPARED: Final = (*(name for name in CHANGEABLE_ON_RESUME if name != "samples"), "seed")
"""Settings that leave the result as it is, and the seed, which the name of a run holds."""
LADDER_POINTS: Final = 20
"""Measurements against fixed opponents in a run."""
LADDER_MATCHES: Final = 200
"""Matches of a measurement, over all opponents."""
SELF_PLAY_ONLY: Final = ("opponents.latest_fraction", "opponents.past_fraction")
"""Settings without effect where one team learns."""


def args(run: Run, folder: Path = Path("out")) -> Args:
    """Return the settings of a run on one core: recommended ones, and those of the experiment.

    Args:
        run: The run.
        folder: Folder for its files.

    Raises:
        TypeError: This trainer has no such setting.
        ValueError: A setting outside its range.
    """
    fixed: dict[str, Any] = {"seed": run.seed, "out": folder, "threads": 1, "torch_threads": 1}
    experiment = run.experiment
    wanted = Args.for_task(experiment.task, **{**experiment.settings, **fixed})
    learners = learning_team(wanted.make_task())
    per_update = wanted.rollout.worlds * wanted.rollout.horizon * len(learners)
    interval = max(1, round(wanted.samples / per_update / LADDER_POINTS))
    shown = RunSettings(
        progress=False, match_page=False, ladder_interval=interval, ladder_matches=LADDER_MATCHES
    )
    return dataclasses.replace(wanted, run=shown)


def settings(run: Run) -> dict[str, Any]:
    """Return all settings that decide the result, as JSON values."""
    values, ignored = args(run).to_json(), without_effect(run)
    return {name: value for name, value in values.items() if name not in ignored}


def without_effect(run: Run) -> frozenset[str]:
    """Return the names of settings that leave the result of a run as it is."""
    task = make_task(run.experiment.task)
    learners = learning_team(task)
    names = [*NOT_COMPARED]
    if len(learners) == len(task.agents):
        names += SELF_PLAY_ONLY
    if len(learners) == 1:
        names.append("opponents.solo_fraction")
    return frozenset(names)


def defaults() -> dict[str, Any]:
    """Return the defaults of all settings, as JSON values."""
    return Args().to_json()


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

    wanted = args(run, folder)
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
