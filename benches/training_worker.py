"""Updates of the trainer on demand, one a line of the input: a process of `training_speed`.

It is started by its path, so that it measures whatever package is first on the path of modules.
"""

import itertools
import math
import sys
import time
from pathlib import Path

from rsoccer.train import Args
from rsoccer.train.ppo import update
from rsoccer.train.run.trainer import Trainer

PASSES = 3
"""Passes over each batch. In whole runs the KL divergence ends them after 2 to 3 on average."""


def main(task: str, threads: int, worlds: int) -> None:
    """Play and learn once for each line, and print the times.

    A line of the output has seconds of the simulator, of the rollout, of learning, and the time of
    the processor for all, each per decision. The first three are made of the least times of single
    decisions and minibatches, which other programs disturb least.

    Args:
        task: name of the task, with its recommended settings; whole teams learn.
        threads: threads of the run.
        worlds: matches at once; 0 for the recommended number.
    """
    settings = {"rollout": {"worlds": worlds}} if worlds else {}
    trainer = Trainer(
        Args.for_task(
            task,
            out=Path("nowhere"),  # a trainer alone writes no files
            threads=threads,
            ppo={"n_epochs": PASSES},
            opponents={"solo_fraction": 0.0},
            **settings,
        )
    )
    vars(update)["TARGET_KL"] = math.inf  # all passes
    per_pass = trainer.args.ppo.n_minibatches
    stamps: list[tuple[float, float]] = []

    def stamp() -> None:
        physics = trainer.clock.seconds.get("physics", 0.0)
        stamps.append((time.perf_counter(), physics))

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
        sys.stdout.write(" ".join(str(seconds / samples) for seconds in times) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
