"""The study of robustness: which training survives late and noisy senses, and varied numbers."""

from __future__ import annotations

from typing import Any, Final

from benches.learning.experiments import AS_TRAINED, CLONES, Experiment
from rsoccer import Sensing
from rsoccer.benchmark.conditions import CONDITIONS
from rsoccer.benchmark.protocol import opponents_of
from rsoccer.policies import trained
from rsoccer.train.task_settings import recommended_settings

GROUP: Final = "robust"
SHIPPED_GROUP: Final = "robust-shipped"

SAMPLES: Final[dict[str, int]] = {
    "VSS-v0": 5_000_000,
    "VSSSelfPlay-v0": 6_000_000,
    "SSLGoToBall-v0": 3_000_000,
    "SSLContestedPossession-v0": 6_000_000,
    "SSLPassEnduranceMulti-v1": 6_000_000,
}
"""Tasks that are learned in the study, and the samples of each run.

At most those of the recommended settings: the study compares trainings at equal cost.
"""
SHIPPED_TASKS: Final = (
    *("SSLGoToBall-v0", "VSS-v0", "SSLContestedPossession-v0", "SSLStaticDefenders-v0"),
    *("SSLDribbling-v0", "SSLPassEnduranceMulti-v1", "VSSSelfPlay-v0"),
)
"""Tasks whose policies in the package are evaluated."""

SENSES: Final[dict[str, Any]] = {
    "sensing": "rc2021",
    "randomization": {"sensing.command_delay": [0.0, 0.1]},
}
"""Senses of the training: those of a tournament, and commands up to 100 ms late."""
VARIATION: Final = {
    "robot.mass": [0.85, 1.15],
    "robot.acceleration": [0.85, 1.15],
    "robot.speed": [0.9, 1.1],
    "robot.traction": [0.85, 1.15],
}
"""Factors on the numbers of each robot."""
ROLLING: Final = {"SSL": [0.15, 0.35], "VSS": [0.1, 0.2]}
"""Rolling deceleration of the ball by league, m/s^2; the models have .26 and .14."""
HISTORY: Final = 5
"""Observations in a stacked one: its actions are those of the last two decisions, 150 ms."""
FORECAST: Final = {"forecast": 1.0}
"""Number of `Sensing` for policies behind the forecaster."""
HAS_FORECASTER: Final = hasattr(Sensing(), "forecast")
"""Whether the package has a forecaster."""

VARIANTS: Final = {
    "truth": "(a) the true state",
    "senses": "(b) senses",
    "variation": "(c) senses and variation",
    "history": "(d) senses, variation and history",
    "forecast": "(e) (a) behind the forecaster",
    "best": "`best`",
    "best-robust": "`best:robust`",
    "best-forecast": "`best` behind the forecaster",
}
"""Descriptions of the variants, in the order of the tables."""


def varied(task: str) -> dict[str, Any]:
    """Return the randomization of a training with senses and variation.

    Args:
        task: registered task.
    """
    rolling = {"ball.rolling_deceleration": ROLLING[task[:3]]}
    return {**SENSES["randomization"], **VARIATION, **rolling}


def experiments(seeds: int) -> tuple[Experiment, ...]:
    """Return the experiments that learn, and those behind the forecaster where there is one.

    Args:
        seeds: Seeds of each experiment.
    """
    found: list[Experiment] = []
    for task, samples in SAMPLES.items():
        recommended = {**recommended_settings(task), **AS_TRAINED, "samples": samples}
        with_variation = {**SENSES, "randomization": varied(task)}
        settings = {
            "truth": {},
            "senses": SENSES,
            "variation": with_variation,
            "history": {**with_variation, "history": HISTORY},
        }
        made = {
            name: Experiment(
                GROUP,
                f"{task}-{name}",
                task,
                settings={**recommended, **own},
                seeds=seeds,
                opponents=opponents_of(task)[:1],
                text=VARIANTS[name],
                conditions=tuple(CONDITIONS),
            )
            for name, own in settings.items()
        }
        found += made.values()
        if HAS_FORECASTER:
            found.append(_behind_forecaster(made["truth"], seeds))
    return tuple(found)


def _behind_forecaster(experiment: Experiment, seeds: int) -> Experiment:
    """The policies of an experiment that knew the true state, behind the forecaster."""
    return Experiment(
        GROUP,
        f"{experiment.task}-forecast",
        experiment.task,
        CLONES,
        settings={"policy": f"@{experiment.key}"},
        seeds=seeds,
        opponents=experiment.opponents,
        needs=(experiment,),
        text=VARIANTS["forecast"],
        conditions=experiment.conditions,
        senses=FORECAST,
    )


def shipped() -> tuple[Experiment, ...]:
    """Return the evaluations of the policies in the package, which learn nothing."""
    found: list[Experiment] = []
    robust = trained.list_trained(trained.ROBUST)
    for task in SHIPPED_TASKS:
        policies = {"best": trained.BEST}
        if task in robust:
            policies["best-robust"] = f"{trained.BEST}:{trained.ROBUST}"
        if HAS_FORECASTER:
            policies["best-forecast"] = trained.BEST
        found += [
            Experiment(
                SHIPPED_GROUP,
                f"{task}-{variant}",
                task,
                CLONES,
                settings={"policy": policy},
                seeds=1,
                opponents=opponents_of(task)[:1],
                text=VARIANTS[variant],
                conditions=tuple(CONDITIONS),
                senses=FORECAST if variant == "best-forecast" else {},
            )
            for variant, policy in policies.items()
        ]
    return tuple(found)


ROBUST: Final = (*shipped(), *experiments(seeds=3))
