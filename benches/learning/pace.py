"""Speed of DDPG and SAC relative to PPO, from which the samples of their runs follow.

python -m benches.learning.pace
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Final

from benches.learning import ppo_run, sb3_run
from benches.learning.experiments import Experiment, Run
from benches.learning.run_files import Folders
from benches.learning.table import BASELINES, PPO
from benches.measuring import Benchmark, Measure, Quantity, Variant, measure, select
from benches.result_files import Figure, format_number, store, this_machine
from rsoccer.registry import make_task

FOLDER: Final = "pace"
"""Folder of the figures, in that of the study's results."""
SOURCE: Final = "amd-epyc-2-cores.csv"
"""The figures in it from which the table of the study has its samples."""
GROUP: Final = "pace"
SPEED: Final = Quantity("speed", "samples/s")
SECONDS: Final = 4.0
"""Processor time of a measurement."""
ROUNDS: Final = 5
STEPS: Final = 20
"""Steps of the vector environment in a call of `learn` of Stable-Baselines3."""
WARM_UP: Final = 40
"""Updates of PPO before it is measured.

The first ones end early: the policy still changes by more than the limit of the KL divergence, and
the adaptive learning rate has not fallen yet. They would make PPO look faster than a run is.
"""


def benchmarks() -> list[Benchmark]:
    """Return a benchmark for each task of the baselines, whose ratios are relative to PPO."""
    tasks = dict.fromkeys(experiment.task for experiment in BASELINES)
    return [_benchmark([PPO[task], *(e for e in BASELINES if e.task == task)]) for task in tasks]


def samples_in_time_of_ppo(ratio: Figure) -> float:
    """Return the samples of an algorithm in the time that PPO's recommended samples take.

    Args:
        ratio: Speed of the algorithm relative to PPO.
    """
    return ratio.median * ppo_run.args(Run(PPO[ratio.scenario], 0)).samples


def _benchmark(experiments: list[Experiment]) -> Benchmark:
    def variant(experiment: Experiment) -> Variant:
        run = Run(experiment, 0)
        if experiment.algorithm == "ppo":
            worlds = ppo_run.args(run).worlds
            start = _start_ppo
        else:
            settings = sb3_run.settings(run)
            task = make_task(experiment.task, **settings["task_options"])
            worlds = sb3_run.number_of_matches(task, settings["rows"])
            start = _start_baseline
        return Variant(experiment.algorithm, worlds, 1, lambda: start(run))

    variants = tuple(map(variant, experiments))
    pairs = tuple((i, 0) for i in range(1, len(variants)))
    return Benchmark(GROUP, experiments[0].task, variants, pairs)


def _start_ppo(run: Run) -> Measure:
    """Return a measure of updates after the first ones, in which all robots learn."""
    import torch

    from rsoccer.train.trainer import Trainer

    # `Trainer.run` alone writes to the folder, so none is made.
    trainer = Trainer(ppo_run.args(run, Path("nowhere")))
    if trainer.is_solo:
        trainer.start_self_play()

    def update() -> int:
        torch.set_num_threads(1)
        before = trainer.samples
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
        return trainer.samples - before

    for _ in range(WARM_UP):
        update()
    return _measured(update)


def _start_baseline(run: Run) -> Measure:
    """Return a measure of steps with gradient steps, without the random ones at the start."""
    from benches.learning.sb3_training import create_model

    values = sb3_run.settings(run)
    model, _ = create_model(run.experiment.task, values, seed=0)
    model.learn(values["learning_starts"])

    def learn() -> int:
        before = int(model.num_timesteps)
        model.learn(STEPS * int(model.n_envs), reset_num_timesteps=False)
        return int(model.num_timesteps) - before

    return _measured(learn)


def _measured(learn: Callable[[], int]) -> Measure:
    """Return a measure of the samples per second of processor time.

    Args:
        learn: Learns from some samples and returns their number.
    """

    def speed(seconds: float) -> dict[Quantity, float]:
        samples, start, spent = 0, time.process_time(), 0.0
        while not samples or spent < seconds:
            samples += learn()
            spent = time.process_time() - start
        return {SPEED: samples / spent}

    return speed


def main(arguments: list[str] | None = None) -> int:
    """Measure, store the figures and print the samples of each algorithm in the time of PPO."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="only tasks whose name contains this; no file")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of a measurement")
    options = parser.parse_args(arguments)
    chosen = select(benchmarks(), options.only)

    def log(text: str) -> None:
        sys.stderr.write(f"{text}\n")

    # One task after another: the replay buffers of all at once need too much memory.
    figures = [
        figure
        for benchmark in chosen
        for figure in measure([benchmark], options.rounds, options.seconds, log)
    ]
    for figure in figures:
        line = f"{figure.scenario:26} {figure.variant:10}"
        line += "".join(
            f" {format_number(x):>8}" for x in (figure.median, figure.minimum, figure.maximum)
        )
        if figure.unit == "x":
            line += f"  {samples_in_time_of_ppo(figure):12,.0f} samples"
        sys.stdout.write(f"{line}\n")
    if not options.only:
        store(figures, this_machine(), Folders().results / FOLDER)
    return 0


if __name__ == "__main__":
    sys.exit(main())
