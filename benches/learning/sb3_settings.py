"""Settings of DDPG and SAC of Stable-Baselines3 in a study."""

from __future__ import annotations

from typing import Any, Final

from benches.learning.experiments import Run
from rsoccer.lineup import learning_team
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
