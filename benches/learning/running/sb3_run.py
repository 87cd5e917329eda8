"""Runs of DDPG and SAC through Stable-Baselines3, the algorithms of the paper.

An interrupted run starts again.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.learning import sb3_settings
from benches.learning.experiments import Protocol, Run
from benches.learning.running.clock import restart_clock, timed
from benches.learning.running.curves import thinned
from benches.learning.running.evaluation import evaluated
from benches.learning.running.learned import Learned
from benches.learning.running.relu_actor import ReluActor
from rsoccer.benchmark.protocol import opponents_of
from rsoccer.registry import make_task

FILE: Final = "actor.npz"
SNAPSHOT: Final = Protocol(starts=50, seed=32)
"""Evaluation of the points of a learning curve."""


def learn(run: Run, folder: Path) -> Learned:
    """Train an actor.

    Args:
        run: The run.
        folder: Folder for its files.

    Returns:
        The policy: for SAC drawn actions, as in training, and for both deterministic ones.
    """
    values = sb3_settings.settings(run)
    opponent = opponents_of(run.experiment.task)[0]
    restart_clock(folder)
    with timed(folder):
        from benches.learning.running.sb3_training import train  # needs Stable-Baselines3

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
