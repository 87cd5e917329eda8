"""Runs that end early, and the files that runs leave."""

import csv
import hashlib
from collections.abc import Iterable
from pathlib import Path

import pytest

from rsoccer.train import Args, train
from rsoccer.train.network import evaluator
from rsoccer.train.ppo import loss_gradient
from rsoccer.train.run import checkpoint
from rsoccer.train.run.loop import Loop
from rsoccer.train.run.stop_signal import Stopped, StopSignal
from rsoccer.train.run.trainer import Trainer


def digest(folder: Path) -> str:
    """Return the SHA-256 of every array of a run's checkpoint, and of its counters."""
    saved = checkpoint.load(folder / checkpoint.FILE_NAME)
    total = hashlib.sha256()
    for name, array in sorted(saved.arrays.items()):
        total.update(f"{name} {array.shape} {array.dtype}".encode() + array.tobytes())
    total.update(f"{saved.info['samples']} {saved.info['updates']}".encode())
    return total.hexdigest()


def digests_by_small_parts(runs: Iterable[Args], monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Train runs that share out few samples at a time, so that all threads work; their digests."""
    monkeypatch.setattr(loss_gradient, "SHARD", 10)
    monkeypatch.setattr(evaluator, "SHARD", 5)
    return {digest(train(args).parent) for args in runs}


def progress(folder: Path) -> list[dict[str, str]]:
    """Return the rows of the log without the columns that depend on wall-clock time."""
    with (folder / "progress.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    times = ("seconds", "samples_per_second", "time_")
    return [{k: v for k, v in row.items() if not k.startswith(times)} for row in rows]


class StopAfter(StopSignal):
    """A signal that comes at the given check."""

    def __init__(self, checks: int) -> None:
        super().__init__()
        self.checks_left = checks

    def check(self) -> None:
        self.checks_left -= 1
        if self.checks_left < 0:
            raise Stopped("test")


def run_until(args: Args, checks: int) -> int:
    """Train until a signal at the given check, and return the number of updates."""
    trainer = Trainer(args)
    with pytest.raises(Stopped):
        Loop(trainer, {}).run(StopAfter(checks), 0)
    return trainer.updates
