"""Training speed: rollouts and updates of the trainer."""

import time
from functools import partial
from pathlib import Path
from typing import Final
from unittest import mock

from benches.measuring import Measure, Quantity, Values

DECISIONS: Final = Quantity("speed", "decisions/s")


def training(task: str, engine: str, worlds: int, threads: int) -> Measure:
    """Measure updates in which all robots of a team learn, as in most of a run; at least one."""
    import torch

    from rsoccer.registry import make_task
    from rsoccer.train import trainer as module
    from rsoccer.train.args import Args

    # `Trainer.run` alone writes to the folder, so it stays empty here.
    args = Args(
        task, Path("nowhere"), worlds=worlds, threads=threads, solo_fraction=0.0, progress=False
    )
    # The trainer takes a task by name; an alias with this option would stay registered.
    with mock.patch.object(module, "make_task", partial(make_task, engine=engine)):
        trainer = module.Trainer(args)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(args.torch_threads)
        before, start, elapsed = trainer.samples, time.perf_counter(), 0.0
        while not elapsed or elapsed < seconds:
            trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
            elapsed = time.perf_counter() - start
        return {DECISIONS: (trainer.samples - before) / elapsed}

    return measure
