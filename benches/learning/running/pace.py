"""Speed of DDPG and SAC relative to PPO, from which the samples of their runs follow.

.venv-libraries/bin/python -m benches.learning.running.pace
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from benches.learning import ppo_settings, sb3_settings
from benches.learning.experiments import Experiment, Run
from benches.learning.run_files import Folders
from benches.learning.table import BASELINES, PPO
from benches.measuring import Benchmark, Measure, Quantity, Variant, measure, select
from benches.result_files import Figure, format_number, store, this_machine
from rsoccer.registry import make_task

SOURCE: Final = "amd-epyc-2-cores.csv"
"""The figures in it from which the table of the study has its samples."""
GROUP: Final = "pace"
"""Group of the benchmarks, and folder of the figures in that of the study's results."""
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
    return ratio.median * ppo_settings.args(Run(PPO[ratio.scenario], 0)).samples


def _benchmark(experiments: list[Experiment]) -> Benchmark:
    def variant(experiment: Experiment) -> Variant:
        run = Run(experiment, 0)
        if experiment.algorithm == "ppo":
            worlds = ppo_settings.args(run).rollout.worlds
            start = _start_ppo
        else:
            settings = sb3_settings.settings(run)
            task = make_task(experiment.task, **settings["task_options"])
            worlds = sb3_settings.number_of_matches(task, settings["rows"])
            start = _start_baseline
        return Variant(experiment.algorithm, worlds, 1, lambda: start(run))

    variants = tuple(map(variant, experiments))
    pairs = tuple((i, 0) for i in range(1, len(variants)))
    return Benchmark(GROUP, experiments[0].task, variants, pairs)


def _start_ppo(run: Run) -> Measure:
    """Return a measure of updates after the first ones, in which all robots learn."""
    import torch

    from rsoccer.train.run.trainer import Trainer

    trainer = Trainer(ppo_settings.args(run, Path("nowhere")))  # it writes no files
    if trainer.is_solo:
        trainer.start_team()

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
    from benches.learning.running.sb3_training import create_model

    values = sb3_settings.settings(run)
    model, _ = create_model(run.experiment.task, values, seed=0)
    model.learn(values["learning_starts"], log_interval=None)

    def learn() -> int:
        before = int(model.num_timesteps)
        samples = STEPS * int(model.n_envs)
        model.learn(samples, reset_num_timesteps=False, log_interval=None)
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
    """Measure, and print the samples of each algorithm in the time of PPO.

    Without options the figures are stored, too.

    Args:
        arguments: Command line without the program name; default: that of the process.

    Returns:
        The exit status.
    """
    options, chosen = parse_arguments(arguments)
    # One task after another: the replay buffers of all at once need too much memory.
    figures = [
        figure
        for benchmark in chosen
        for figure in measure([benchmark], options.rounds, options.seconds, _log)
    ]
    sys.stdout.write("".join(map(_line, figures)))
    if (options.only, options.rounds, options.seconds) == ("", ROUNDS, SECONDS):
        path = store(figures, this_machine(), Folders().results / GROUP)
        sys.stdout.write(f"{path}\n")
    return 0


def parse_arguments(
    arguments: list[str] | None,
) -> tuple[argparse.Namespace, list[Benchmark]]:
    """Return the options of a command line, and the benchmarks that they select."""
    parser = argparse.ArgumentParser(
        prog="python -m benches.learning.running.pace", description=__doc__
    )
    parser.add_argument("--only", default="", help="only tasks whose name contains this")
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--seconds", type=float, default=SECONDS, help="of a measurement")
    options = parser.parse_args(arguments)
    if options.rounds < 1 or options.seconds < 0.0:
        parser.error(
            "expected rounds of at least 1 and seconds of at least 0, "
            f"got {options.rounds} and {options.seconds}"
        )
    if find_spec("stable_baselines3") is None:
        parser.error("Stable-Baselines3 is missing: make .venv-libraries/made, and its python")
    if (profile := this_machine().profile) != "release":
        parser.error(f"expected a release build, got a {profile} build")
    try:
        return options, select(benchmarks(), options.only)
    except ValueError as error:
        parser.error(str(error))


def _log(text: str) -> None:
    sys.stderr.write(f"{text}\n")


def _line(figure: Figure) -> str:
    """A figure as a line, with the samples that follow from a ratio."""
    numbers = (figure.median, figure.minimum, figure.maximum)
    line = f"{figure.scenario:26} {figure.variant:10}"
    line += "".join(f" {format_number(x):>8}" for x in numbers)
    if figure.unit == "x":
        line += f"  {samples_in_time_of_ppo(figure):12,.0f} samples"
    return f"{line}\n"


if __name__ == "__main__":
    sys.exit(main())
