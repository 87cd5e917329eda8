"""Outcome of the learning of one run, and the time that it took over several attempts."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from rsoccer.arrays import Array
from rsoccer.files import write_atomically
from rsoccer.policies import PolicyLike

POINTS: Final = 50
"""Most points of a stored curve."""
TIME_FILE: Final = "time.json"
TIME_INTERVAL: Final = 5.0
"""Time between two writings of the time of a run, s: what a run that is killed may lose."""


@dataclass(frozen=True)
class Learned:
    """A policy, and its learning."""

    policies: dict[str, PolicyLike]
    """Policy by mode, "sample" or "mean"; the first mode is the policy's own."""
    samples: int
    """Decisions of single robots that were learned from."""
    curve: dict[str, Any]
    """Learning curve: name of the metric, and lists `samples`, `seconds` and `values`."""
    extra: dict[str, Any]
    """More numbers for the result."""


@contextmanager
def timed(folder: Path) -> Iterator[dict[str, float]]:
    """Add the time within the block to that of earlier attempts.

    A thread writes it every few seconds, so that a process that is killed leaves it, too.

    Yields:
        Seconds before this attempt: `wall`, `cpu` and the number of `attempts`.
    """
    before = spent(folder)
    wall, cpu = time.monotonic(), time.process_time()
    ended = threading.Event()

    def write() -> None:
        after = {
            "wall": before["wall"] + time.monotonic() - wall,
            "cpu": before["cpu"] + time.process_time() - cpu,
            "attempts": before["attempts"] + 1,
        }
        write_atomically(folder / TIME_FILE, (json.dumps(after) + "\n").encode())

    def write_until_ended() -> None:
        while not ended.wait(TIME_INTERVAL):
            write()

    writer = threading.Thread(target=write_until_ended, daemon=True)
    writer.start()
    try:
        yield before
    finally:
        ended.set()
        writer.join()
        write()


def restart_clock(folder: Path) -> None:
    """Forget the time of earlier attempts, as the run starts again."""
    (folder / TIME_FILE).unlink(missing_ok=True)


def spent(folder: Path) -> dict[str, float]:
    """Return the seconds that the attempts of a run took so far."""
    path = folder / TIME_FILE
    if not path.is_file():
        return {"wall": 0.0, "cpu": 0.0, "attempts": 0}
    seconds: dict[str, float] = json.loads(path.read_text())
    return seconds


def curve(metric: str, samples: Array, seconds: Array, values: Array, weights: Array) -> Any:  # noqa: ANN401
    """Return a curve of at most `POINTS` points, means over equal ranges of samples.

    Args:
        metric: Name of the metric.
        samples: (updates,) samples at the end of each update, rising.
        seconds: (updates,) seconds of training at the end of each update.
        values: (updates,) mean of the metric over the episodes of an update; NaN without episodes.
        weights: (updates,) number of these episodes.

    Returns:
        Values ready for JSON; points without episodes are left out.
    """
    points: list[tuple[int, float, float]] = []
    if len(samples):
        edges = np.linspace(0.0, samples[-1], POINTS + 1)[1:]
        bins = np.searchsorted(edges, samples - 1e-6)
        weights = np.where(np.isfinite(values), weights, 0.0)
        for index in range(POINTS):
            chosen = np.flatnonzero(bins == index)
            if total := weights[chosen].sum():
                mean = np.nansum(values[chosen] * weights[chosen]) / total
                last = chosen[-1]
                points.append((int(samples[last]), float(seconds[last]), float(mean)))
    columns: list[list[Any]] = [list(column) for column in zip(*points, strict=True)]
    columns = columns or [[], [], []]
    return {
        "metric": metric,
        "samples": columns[0],
        "seconds": [round(second, 1) for second in columns[1]],
        "values": [round(value, 4) for value in columns[2]],
    }
