"""The ablation: from the paper's setting of VSS-v0, where PPO failed, to the package's by parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from benches.learning.experiments import AS_TRAINED, Experiment
from rsoccer.train.task_settings import recommended_settings

GROUP: Final = "ablation"
PAPER: Final = "paper"
OURS: Final = "ours"
OPPONENTS: Final = ("ou", "zero")
"""Opponents of the evaluation; the first is the paper's."""


@dataclass(frozen=True)
class Change:
    """One difference between the two settings."""

    name: str
    """Name for files."""
    text: str
    """Description, from the paper's setting to the package's."""
    paper: Mapping[str, Any]
    """Settings of the trainer in the paper's setting."""


CHANGES: Final = (
    Change(
        "rewards",
        "goals are most of the return, instead of a tenth",
        {"task_options": {"reward_weights": "paper"}},
    ),
    Change("discount", "a longer horizon than .95 per control step of 25 ms", {"ppo.gamma": 0.95}),
    Change(
        "repeat",
        "decisions held, instead of one in every control step",
        {"rollout.action_repeat": 1},
    ),
    Change(
        "time-limits",
        "values bootstrapped at time limits, and random truncations, instead of ends",
        {"ppo.bootstrap_time_limits": False, "rollout.random_truncation": 0.0},
    ),
    Change(
        "headings",
        "headings of opponents observed",
        {"network.masked_observations": ("opponents:2,3",)},
    ),
    Change(
        "features",
        "the own action and features in the robot's coordinates observed",
        {
            "network.masked_observations": (
                *("ball_polar", "goal_polar", "shot", "own_goal_polar", "own_goal_shot"),
                *("body_velocities", "body_positions"),
                "action",
            )
        },
    ),
    Change(
        "normalization",
        "observations and rewards normalized",
        {"rollout.normalize_observations": False, "rollout.normalize_rewards": False},
    ),
    Change(
        "reflections",
        "samples learned from a second time with left and right swapped",
        {"ppo.mirror_augmentation": False},
    ),
)
"""The learner itself is the same in all runs: the paper does not name the settings of its PPO."""


PAPER_MASK: Final = tuple(
    part for change in CHANGES for part in change.paper.get("network.masked_observations", ())
)
"""Parts of the observation that the paper's task does not have."""


def experiments(task: str, samples: int, seeds: int) -> tuple[Experiment, ...]:
    """Return both settings, the paper's with one change each, and the package's without one each.

    Args:
        task: Registered task.
        samples: Samples of each run.
        seeds: Seeds of each experiment.
    """

    def experiment(name: str, text: str, parts: Iterable[Change]) -> Experiment:
        settings = {"samples": samples, **AS_TRAINED, **merged(task, parts)}
        return Experiment(
            GROUP, name, task, settings=settings, seeds=seeds, opponents=OPPONENTS, text=text
        )

    found = [
        experiment(PAPER, "the paper's setting", CHANGES),
        experiment(OURS, "the package's setting", ()),
    ]
    for change in CHANGES:
        others = [other for other in CHANGES if other is not change]
        found.append(experiment(f"{PAPER}+{change.name}", f"with: {change.text}", others))
        found.append(experiment(f"{OURS}-{change.name}", f"without: {change.text}", [change]))
    return tuple(found)


def merged(task: str, changes: Iterable[Change]) -> dict[str, Any]:
    """Return the settings of several changes; masks, and options of the task, are joined."""
    settings: dict[str, Any] = {}
    recommended = recommended_settings(task)
    for change in changes:
        for name, value in change.paper.items():
            before = settings.get(name, recommended.get(name))
            if isinstance(value, tuple):
                settings[name] = (*(before or ()), *value)
            elif isinstance(value, Mapping):
                settings[name] = {**(before or {}), **value}
            else:
                settings[name] = value
    return settings
