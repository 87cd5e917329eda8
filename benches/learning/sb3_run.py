"""Runs of DDPG and SAC through Stable-Baselines3, the algorithms of the paper.

An interrupted run starts again.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.learning.clock import restart_clock, timed
from benches.learning.curves import thinned
from benches.learning.evaluation import evaluated, opponents_of
from benches.learning.experiments import Protocol, Run
from benches.learning.learned import Learned
from benches.learning.relu_actor import ReluActor
from rsoccer.lineup import learning_team
from rsoccer.registry import make_task
from rsoccer.task import Task
from rsoccer.train import NetworkSettings, PpoSettings, RolloutSettings
from rsoccer.train.setting_types import converted

DEFAULTS: Final[dict[str, Any]] = {
    "samples": 1_000_000,
    "task_options": {},
    "rows": 60,
    "samples_per_gradient_step": 10,
    "action_repeat": RolloutSettings.action_repeat,
    "gamma": PpoSettings.gamma,
    "hidden_sizes": list(NetworkSettings.hidden_sizes),
    "learning_rate": 1e-3,
    "batch_size": 256,
    "buffer_size": 1_000_000,
    "learning_starts": 10_000,
    "tau": 0.005,
    "n_steps": 1,
    "noise": [0.15, 0.8, 0.15],
    "masked_observations": [],
}
"""Settings and their defaults.

`samples` are decisions of single robots, rounded up to whole steps of the environments. Discount,
decision rate and network size are those of PPO; `gamma` is per control step. `rows` is the least
number of robots that act at once; it is a multiple of `samples_per_gradient_step`, which is that of
the paper, for teams of any size. `noise` of DDPG is an Ornstein-Uhlenbeck process: theta, and sigma
at the start and at the end of the run, as in the paper; its time is match time.
`masked_observations` are parts that the networks do not read, as in the settings of PPO.
"""
FILE: Final = "actor.npz"
SNAPSHOT: Final = Protocol(starts=50, seed=32)
"""Evaluation of the points of a learning curve."""


def settings(run: Run) -> dict[str, Any]:
    """Return all settings of a run, as JSON values.

    Raises:
        TypeError: An unknown setting.
        ValueError: A number of another type.
    """
    given = run.experiment.settings
    if unknown := sorted(set(given) - set(DEFAULTS)):
        raise TypeError(f"expected settings of {sorted(DEFAULTS)}, got {unknown}")
    for name, value in given.items():
        if type(DEFAULTS[name]) in (int, float):
            converted(name, value, type(DEFAULTS[name]))
    values = {**DEFAULTS, **given, "algorithm": run.experiment.algorithm}
    if run.experiment.algorithm != "ddpg":
        del values["noise"]
    return values


def defaults() -> dict[str, Any]:
    """Return the defaults of settings that a result may lack, as it is older than the setting.

    Older results had a limit of time, not of samples, so they lack no default number of samples.
    """
    return {name: value for name, value in DEFAULTS.items() if name != "samples"}


def number_of_matches(task: Task, rows: int) -> int:
    """Return the least number of matches in which that many robots learn."""
    return -(-rows // len(learning_team(task)))


def learn(run: Run, folder: Path) -> Learned:
    """Train an actor.

    Args:
        run: The run.
        folder: Folder for its files.

    Returns:
        The policy: for SAC drawn actions, as in training, and for both deterministic ones.
    """
    values = settings(run)
    opponent = opponents_of(run.experiment.task)[0]
    restart_clock(folder)
    with timed(folder):
        from benches.learning.sb3_training import train

        def measure(actor: ReluActor) -> float:
            row = evaluated(run.experiment.task, actor.mean(), opponent, SNAPSHOT)
            return float(row["score"])

        actor, log = train(run.experiment.task, values, run.seed, measure)
    actor.save(folder / FILE)
    drawn: dict[str, Any] = {} if actor.log_std is None else {"sample": actor}
    policies = {**drawn, "mean": actor.mean()}
    metric = make_task(run.experiment.task).success or "return"
    samples, times, scores = map(np.array, (log.samples, log.seconds, log.scores))
    extra = {
        "learning_seconds": round(log.learning_seconds, 1),
        "gradient_steps": log.gradient_steps,
    }
    points = thinned(metric, samples, times, scores, np.ones(len(scores)))
    return Learned(policies, log.total, points, extra)
