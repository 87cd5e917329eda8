"""Updates of the trainer on demand, one a line of the input: a process of `training_speed`.

It is started by its path, so that it measures whatever package is first on the path of modules.
"""

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

    A line of the output has seconds of the simulator, of the rollout, of the update, and the time
    of the processor for both, each per decision.

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
    update.TARGET_KL = math.inf
    for _ in sys.stdin:
        trainer.clock.take()
        before, start, processor = trainer.samples, time.perf_counter(), time.process_time()
        batch = trainer.collect_rollout(lambda: None)
        played = time.perf_counter()
        trainer.update(batch, lambda: None)
        end, processor = time.perf_counter(), time.process_time() - processor
        total, shares = trainer.clock.take()
        times = shares["physics"] * total, played - start, end - played, processor
        decisions = trainer.samples - before
        sys.stdout.write(" ".join(str(seconds / decisions) for seconds in times) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
