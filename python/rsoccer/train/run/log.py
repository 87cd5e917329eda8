"""Logs of a run: a progress bar, a CSV file for plots, and TensorBoard."""

from __future__ import annotations

import csv
import sys
from collections import deque
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer.arrays import Array
from rsoccer.train.rollout.episode_stats import EPISODE_PREFIX, GOAL_SCORE, Row

FILE_NAME = "progress.csv"
"""Name of the CSV file in a run's folder, one row per update."""
LADDER_PREFIX = "ladder_"
"""Prefix of the columns of the ladder."""


class Logger:
    """Writes one row per update; a resumed run drops the rows after its checkpoint."""

    def __init__(
        self, folder: Path, samples: int, total: int, size: int, *, progress: bool
    ) -> None:
        """Open the logs of a run, to continue after a checkpoint or from the start.

        Args:
            folder: folder of the run.
            samples: samples at the checkpoint; 0 for a new run.
            total: samples of the whole run.
            size: bytes that the CSV file is truncated to, if it is longer; 0 for a new run.
            progress: show a progress bar.
        """
        from torch.utils.tensorboard import SummaryWriter
        from tqdm import tqdm

        self._path = folder / FILE_NAME
        with self._path.open("ab") as file:
            # After a power failure the file may be shorter than its checkpoint says.
            file.truncate(min(size, file.tell()))
        self._tensorboard = SummaryWriter(str(folder / "tensorboard"), purge_step=samples + 1)
        self._bar = tqdm(
            total=total,
            initial=samples,
            disable=not progress,
            unit=" samples",
            unit_scale=True,
            smoothing=0.1,
            mininterval=0.5 if sys.stderr.isatty() else 10.0,
            dynamic_ncols=True,
        )
        self._recent: deque[Row] = deque(maxlen=20)

    @property
    def size(self) -> int:
        """Bytes of the CSV file, which a checkpoint stores."""
        return self._path.stat().st_size

    def write(self, samples: int, row: Row) -> None:
        """Log one update.

        Args:
            samples: samples at the end of the update.
            row: values by column, the same columns in every update; TensorBoard skips NaN.
        """
        with self._path.open("a", newline="") as file:
            writer = csv.DictWriter(file, list(row))
            if file.tell() == 0:
                writer.writeheader()
            writer.writerow(row)
        for name, value in row.items():
            if np.isfinite(value):
                self._tensorboard.add_scalar(name, value, samples)
        self._recent.append(row)
        self._bar.set_postfix_str(self._summary(), refresh=False)
        self._bar.update(samples - self._bar.n)

    def close(self) -> None:
        """Close the progress bar and the files."""
        self._bar.close()
        self._tensorboard.close()

    def _summary(self) -> str:
        """Shares of wins and losses in the last updates; the reward if the task has no goals."""
        total = {name: sum(row.get(name, 0.0) for row in self._recent) for name in _SUMMED}
        if EPISODE_PREFIX + GOAL_SCORE not in self._recent[-1] or not total["episodes"]:
            return f"reward {self._recent[-1]['reward']:.3f}"
        won, lost = (total[name] / total["episodes"] for name in ("wins", "losses"))
        return f"won {won:.0%}, lost {lost:.0%}"


_SUMMED = ("episodes", "wins", "losses")


def ladder_column(metric: str, opponent: str | None = None) -> str:
    """Return the column of a metric in the matches of the ladder.

    Args:
        metric: name of the metric.
        opponent: name of the opponent; None if the task is played with its own robots.
    """
    return LADDER_PREFIX + (metric if opponent is None else f"{opponent}_{metric}")


def read_progress(folder: Path) -> dict[str, Array]:
    """Return the columns of a run's CSV file by name, each (updates,).

    Args:
        folder: folder of the run.

    Raises:
        ValueError: the file has no rows yet.
    """
    with (folder / FILE_NAME).open(newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{folder / FILE_NAME} holds no rows yet")
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def append_row(folder: Path, row: Mapping[str, Any]) -> None:
    """Append a row to the log of a run in which all rows have the same columns.

    Args:
        folder: folder of the run.
        row: values by column.
    """
    with (folder / FILE_NAME).open("a", newline="") as file:
        writer = csv.DictWriter(file, list(row))
        if file.tell() == 0:
            writer.writeheader()
        writer.writerow(row)
