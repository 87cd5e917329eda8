"""The ablation: from the paper's setting of VSS-v0, where PPO failed, to the package's by parts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final

from benches.learning.experiments import Experiment

GROUP: Final = "ablation"
PAPER: Final = "paper"
OURS: Final = "ours"


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
    Change("discount", "discount .97 per control step of 25 ms, instead of .95", {"gamma": 0.95}),
    Change("repeat", "a decision every 75 ms, instead of every 25 ms", {"action_repeat": 1}),
    Change(
        "time-limits",
        "values bootstrapped at time limits, and random truncations, instead of ends",
        {"bootstrap_time_limits": False, "random_truncation": 0.0},
    ),
    Change(
        "headings",
        "headings of opponents observed",
        {"masked_observations": ("opponents:2,3",)},
    ),
    Change(
        "features",
        "the own action and features in the robot's coordinates observed",
        {
            "masked_observations": (
                *("ball_polar", "goal_polar", "shot", "body_velocities", "body_positions"),
                "action",
            )
        },
    ),
    Change(
        "normalisation",
        "observations and rewards normalised",
        {"normalise_observations": False, "normalise_rewards": False},
    ),
)
"""The learner itself is the same in all runs: the paper does not name the settings of its PPO."""


def experiments(task: str, samples: int, seeds: int) -> tuple[Experiment, ...]:
    """Return both settings, the paper's with one change each, and the package's without one each.

    Args:
        task: Registered task.
        samples: Samples of each run.
        seeds: Seeds of each experiment.
    """

    def experiment(name: str, text: str, parts: Iterable[Change]) -> Experiment:
        settings = {"samples": samples, **merged(parts)}
        return Experiment(GROUP, name, task, settings=settings, seeds=seeds, text=text)

    found = [
        experiment(PAPER, "the paper's setting", CHANGES),
        experiment(OURS, "the package's setting", ()),
    ]
    for change in CHANGES:
        others = [other for other in CHANGES if other is not change]
        found.append(experiment(f"{PAPER}+{change.name}", f"with: {change.text}", others))
        found.append(experiment(f"{OURS}-{change.name}", f"without: {change.text}", [change]))
    return tuple(found)


def merged(changes: Iterable[Change]) -> dict[str, Any]:
    """Return the settings of several changes; masks are joined."""
    settings: dict[str, Any] = {}
    for change in changes:
        for name, value in change.paper.items():
            joined = isinstance(value, tuple) and name in settings
            settings[name] = (*settings[name], *value) if joined else value
    return settings
