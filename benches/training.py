"""The speed of learning: updates of the trainer, playing included."""

import time
from pathlib import Path
from typing import Final

from benches.measuring import Measure, Quantity, Values

DECISIONS: Final = Quantity("speed", "decisions/s")


def training(task: str, worlds: int, threads: int) -> Measure:
    """Updates with all robots of a side learning, as in most of a run; one at least."""
    import torch

    from rsoccer.train.args import Args
    from rsoccer.train.trainer import Trainer

    # Nothing is written: the folder belongs to what `run` keeps.
    args = Args(
        task, Path("nowhere"), worlds=worlds, threads=threads, solo_fraction=0.0, progress=False
    )
    trainer = Trainer(args)

    def measure(seconds: float) -> Values:
        torch.set_num_threads(args.torch_threads)
        before, start, spent = trainer.samples, time.perf_counter(), 0.0
        while not spent or spent < seconds:
            trainer.learn(trainer.play(lambda: None), lambda: None)
            spent = time.perf_counter() - start
        return {DECISIONS: (trainer.samples - before) / spent}

    return measure
