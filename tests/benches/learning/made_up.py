"""Made-up results of a study."""

from dataclasses import asdict
from typing import Any

import numpy as np

from benches.learning import conditions
from benches.learning.experiments import Experiment, Run, Study
from benches.learning.opponents import OFFICIAL, SCENARIOS
from benches.learning.run_files import Folders, save
from benches.learning.run_files import needs as run_needs
from rsoccer._core import build_info
from rsoccer.benchmark import protocol
from rsoccer.registry import make_task

MODES = {"ppo": ("sample", "mean"), "ddpg": ("mean",), "sac": ("sample", "mean")}


def store(study: Study, folders: Folders, *, missing: tuple[str, ...] = ()) -> None:
    """Write a result of each run that can run with this trainer, except the missing ones."""
    for run in study.runs():
        try:
            settings = conditions.settings(run)
        except TypeError:
            continue
        if not any(name in run.key for name in missing):
            save(folders, run.key, result(run, study, settings, run_needs(folders, run)))


def result(
    run: Run, study: Study, settings: dict[str, Any], needs: dict[str, str]
) -> dict[str, Any]:
    """Return a result with a score between .5 and 1, worse in the paper's setting."""
    experiment = run.experiment
    rng = np.random.default_rng([run.seed, *experiment.key.encode()])
    score = rng.uniform(0.6, 0.95) * (0.3 if experiment.name.startswith("paper") else 1.0)
    samples = int(settings.get("samples", 1_000_000))
    metric = make_task(experiment.task).success
    scale = 7.0 if metric == "gates" else 1.0
    grid = np.linspace(samples / 50, samples, 50)
    values = score * scale * (1 - np.exp(-4 * grid / samples)) + rng.normal(0, 0.03, 50)
    return {
        "run": run.key,
        "task": experiment.task,
        "algorithm": experiment.algorithm,
        "text": experiment.text,
        "settings": settings,
        "protocol": asdict(study.protocol),
        "physics": build_info()["physics"],
        "needs": needs,
        "machine": {"machine": "Some CPU", "cores": 2},
        "libraries": {},
        "samples": samples,
        "seconds": {"wall": 660.0, "cpu": 600.0, "attempts": 1},
        "evaluation_seconds": 30.0,
        "gradient_steps": 90_000,
        "curve": {
            "metric": metric,
            "samples": grid.astype(int).tolist(),
            "seconds": np.linspace(12.0, 600.0, 50).tolist(),
            "values": values.round(3).tolist(),
        },
        "evaluations": evaluations(experiment, round(score * scale, 3)),
    }


def evaluations(experiment: Experiment, score: float) -> list[dict[str, Any]]:
    """Return the rows of an experiment; under each further condition a tenth is lost."""
    modes = MODES.get(experiment.algorithm, MODES["ppo"])
    opponents = [opponent or "-" for opponent in opponents_of(experiment)]
    if not experiment.conditions:
        return [row(experiment, opponent, mode, score) for opponent in opponents for mode in modes]
    return [
        {"condition": name, **row(experiment, opponents[0], modes[0], round(score * 0.9**i, 3))}
        for i, name in enumerate(experiment.conditions)
    ]


def opponents_of(experiment: Experiment) -> list[str | None]:
    """Return the opponents of the rows of an experiment."""
    opponents = experiment.opponents or protocol.opponents_of(experiment.task)
    has_scenarios = experiment.task in SCENARIOS
    return [*opponents, *([OFFICIAL] if has_scenarios else [])]


def row(experiment: Experiment, opponent: str, mode: str, score: float) -> dict[str, Any]:
    """Return an evaluation of 1000 matches."""
    task = make_task(experiment.task)
    wins = round(1000 * min(score, 1.0))
    return {
        "opponent": opponent,
        "mode": mode,
        "metric": task.success,
        "matches": 1000,
        "wins": wins,
        "draws": 1000 - wins,
        "losses": 0,
        "score": score,
        "low": score - 0.02,
        "high": score + 0.02,
        "sides": {"blue": score, "yellow": score} if task.two_sided else {},
        "decided": wins,
        "own_goals": 3 if task.two_sided else 0,
        "seconds": 8.0,
        "seconds_to_decision": 5.0,
        "metrics": {"own_passes": 1.5, "opponent_passes": 0.0} if "SSLSelf" in task.name else {},
    }
