"""Settings of the package's own trainer in a study."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any, Final

from benches.learning.experiments import Run
from rsoccer.lineup import learning_team
from rsoccer.registry import make_task
from rsoccer.train import Args, RunSettings
from rsoccer.train.args import CHANGEABLE_ON_RESUME

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
