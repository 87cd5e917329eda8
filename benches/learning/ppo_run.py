"""Runs of the package's own trainer, which resume from its checkpoint."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import Any, Final

from benches.learning.experiments import Run
from benches.learning.learned import Learned, curve, restart_clock, timed
from rsoccer.frame import team_of
from rsoccer.registry import make_task
from rsoccer.train.args import CHANGEABLE_ON_RESUME, Args

NOT_COMPARED: Final = (*(name for name in CHANGEABLE_ON_RESUME if name != "samples"), "seed")
"""Settings that leave the result as it is, and the seed, which the name of a run holds."""
SELF_PLAY_ONLY: Final = (
    *("latest_fraction", "past_fraction", "ou_fraction", "pool_size", "pool_interval"),
    "pfsp_power",
)
"""Settings without effect where one team learns."""


def args(run: Run, folder: Path = Path("out")) -> Args:
    """Return the settings of a run on one core.

    Raises:
        TypeError: This trainer has no such setting.
        ValueError: A setting outside its range.
    """
    fixed: dict[str, Any] = {
        "task": run.experiment.task,
        "seed": run.seed,
        "out": folder,
        "threads": 1,
        "torch_threads": 1,
        "progress": False,
        "match_page": False,
    }
    return Args(**{**run.experiment.settings, **fixed})


def settings(run: Run) -> dict[str, Any]:
    """Return all settings that decide the result, as JSON values."""
    values, ignored = args(run).to_json(), without_effect(run)
    return {name: value for name, value in values.items() if name not in ignored}


def without_effect(run: Run) -> frozenset[str]:
    """Return the names of settings that leave the result of a run as it is."""
    agents = make_task(run.experiment.task).agents
    names = [*NOT_COMPARED]
    if len({team_of(name) for name in agents}) == 1:
        names += SELF_PLAY_ONLY
    if len(agents) == 1:
        names.append("solo_fraction")
    return frozenset(names)


def defaults() -> dict[str, Any]:
    """Return the defaults of all settings, as JSON values."""
    return Args().to_json()


def samples_so_far(folder: Path) -> int | None:
    """Return the samples of the checkpoint in a folder; None without one."""
    from rsoccer.train import checkpoint

    path = folder / checkpoint.FILE_NAME
    return int(checkpoint.load(path).info["samples"]) if path.is_file() else None


def _continues(wanted: Args, folder: Path) -> bool:
    """Whether the folder has a checkpoint of a run with the same settings."""
    from rsoccer.train import checkpoint

    path = folder / checkpoint.FILE_NAME
    return path.is_file() and not wanted.differences(checkpoint.load(path).info["args"])


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
    from rsoccer.train.log import read_progress

    wanted = args(run, folder)
    resume = _continues(wanted, folder)
    if not resume:
        restart_clock(folder)
    with timed(folder):
        policy = str(train(dataclasses.replace(wanted, resume=resume, overwrite=not resume)))
    progress = read_progress(folder)
    metric = make_task(run.experiment.task).success or "reward"
    values = progress[f"episode/{metric}"]
    # Opponents of self-play change, so its curve counts the matches against a fixed one.
    against_ou = progress.get(f"episode_ou/{metric}")
    if against_ou is not None and any(map(math.isfinite, against_ou)):
        values = against_ou
    seconds, samples = progress["seconds"], progress["samples"]
    return Learned(
        policies={"sample": policy, "mean": f"{policy}:mean"},
        samples=int(samples[-1]),
        curve=curve(metric, samples, seconds, values, progress["episodes"]),
        extra={"updates": len(samples), "trainer_seconds": round(float(seconds[-1]), 1)},
    )
