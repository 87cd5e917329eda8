"""Updates of the trainer on demand, one a line of the input: a process of `training_speed`.

It is started by its path, so that it measures whatever package is first on the path of modules.
"""

import argparse
import itertools
import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from rsoccer.train import Args, clock
from rsoccer.train.ppo import update
from rsoccer.train.run.trainer import Trainer

PASSES = 3
"""Passes over each batch. In whole runs the KL divergence ends them after 2 to 3 on average."""


def main(arguments: list[str] | None = None) -> None:
    """Play and learn once for each line, and print the times.

    Args:
        arguments: command line without the program name; default: that of the process. The task
            has its recommended settings; whole teams learn.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("task", help="name of the task")
    parser.add_argument("threads", type=int, help="threads of the run")
    parser.add_argument("worlds", type=int, help="matches at once; 0 for the recommended number")
    parser.add_argument("--device", default="cpu", help="device of the updates")
    parser.add_argument("--overlap", action="store_true", help="play during the updates")
    parser.add_argument("--whole", action="store_true", help="measure whole updates")
    options = parser.parse_args(arguments)
    # Packages from before the option are measured without it.
    overlap = {"overlap": True} if options.overlap else {}
    ppo: dict[str, Any] = {"n_epochs": PASSES, **overlap}
    settings = {"rollout": {"worlds": options.worlds}} if options.worlds else {}
    vars(update)["TARGET_KL"] = math.inf  # all passes
    # Other programs make the processor wait, but change its own time little.
    by_processor = options.threads == 1 and not options.whole
    timer = time.process_time if by_processor else time.perf_counter
    vars(clock)["time"] = SimpleNamespace(perf_counter=timer)
    trainer = Trainer(
        Args.for_task(
            options.task,
            out=Path("nowhere"),  # a trainer alone writes no files
            threads=options.threads,
            device=options.device,
            ppo=ppo,
            opponents={"solo_fraction": 0.0},
            **settings,
        )
    )
    if options.whole:
        _measure_whole(trainer, overlap=options.overlap)
    else:
        _measure_least(trainer, timer)


def _measure_whole(trainer: Trainer, *, overlap: bool) -> None:
    """Print seconds of the rollout, of learning and waiting, of the update, and its samples.

    Each line is of one update, by wall time. Learning includes values and reflections of samples.
    """
    if overlap:  # packages from before the option have no such module
        from rsoccer.train.run.overlap import update as overlapped_update

    def play_and_learn() -> None:
        if overlap:
            overlapped_update(trainer, lambda: None)
        else:
            trainer.update(trainer.collect_rollout(lambda: None), lambda: None)

    for _ in sys.stdin:
        trainer.clock.take()
        before, started = trainer.samples, time.perf_counter()
        play_and_learn()
        seconds = time.perf_counter() - started
        parts = trainer.clock.seconds
        rollout = parts["acting"] + parts["matches"]
        _print(rollout, parts["learning"], seconds, trainer.samples - before)


def _measure_least(trainer: Trainer, timer: Callable[[], float]) -> None:
    """Print seconds of the simulator, of the rollout, of learning, and processor time of all.

    They are per decision. The first three are made of the least times of single decisions and
    minibatches, which other programs disturb least; on one thread they are times of the
    processor, too.
    """
    per_pass = trainer.args.ppo.n_minibatches
    stamps: list[tuple[float, float]] = []

    def stamp() -> None:
        physics = trainer.clock.seconds.get("physics", 0.0)
        stamps.append((timer(), physics))

    for _ in sys.stdin:
        trainer.clock.take()
        stamps.clear()
        before, processor = trainer.samples, time.process_time()
        batch = trainer.collect_rollout(stamp)
        decisions = len(stamps)
        trainer.update(batch, stamp)
        processor = time.process_time() - processor
        stamp()
        spans = [
            (end[0] - start[0], end[1] - start[1]) for start, end in itertools.pairwise(stamps)
        ]
        decision = min(spans[: decisions - 1])[0]
        simulation = min(physics for _, physics in spans[: decisions - 1])
        # The last decision, values, advantages, reflections.
        batching = spans[decisions - 1][0] - decision
        minibatches = [seconds for seconds, _ in spans[decisions:]]
        last = minibatches[per_pass - 1 :: per_pass]  # of a pass, with what precedes the next one
        one_pass = min(last) + (per_pass - 1) * min(minibatches)
        times = (
            simulation * decisions,
            decision * decisions,
            batching + PASSES * one_pass,
            processor,
        )
        samples = trainer.samples - before
        _print(*(seconds / samples for seconds in times))


def _print(*numbers: float) -> None:
    """Print a line of numbers at once."""
    sys.stdout.write(" ".join(map(str, numbers)) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main()
