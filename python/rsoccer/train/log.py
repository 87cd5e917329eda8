"""What a run tells: a progress bar for people, a CSV file for plots, TensorBoard for both."""

from __future__ import annotations

import csv
import os
import sys
from collections import deque
from pathlib import Path

import numpy as np

from rsoccer.frame import Array
from rsoccer.train.args import Args

FILE_NAME = "progress.csv"
SCORE = "goal_score"
"""Metric of an ended episode that counts as goals and wins: +1 for us, -1 against us."""
EPISODE = "episode/"
"""What columns of a task's metrics begin with: whatever it calls them, the run's own are others."""

Row = dict[str, float]


class EpisodeStats:
    """Ended episodes since the last `take`, by kind of opponent."""

    def __init__(self, kinds: tuple[str, ...]) -> None:
        """Start empty; `kinds` names the opponents."""
        self._kinds = kinds
        self._ended: list[tuple[Array, dict[str, Array]]] = []

    def add(self, kinds: Array, metrics: dict[str, Array]) -> None:
        """Note episodes that ended: kind of opponent (k,), and each metric (k,)."""
        self._ended.append((kinds, metrics))

    def take(self) -> Row:
        """Means of the metrics, of all and by opponent (NaN where no match ended)."""
        kinds = np.concatenate([kinds for kinds, _ in self._ended])
        row: Row = {"episodes": len(kinds)}
        for name in self._ended[0][1]:
            values = np.concatenate([metrics[name] for _, metrics in self._ended])
            row[EPISODE + name] = _mean(values)
            for index, kind in enumerate(self._kinds):
                row[against(kind, name)] = _mean(values[kinds == index])
            if name == SCORE:
                row["goals_for"] = float((values > 0).sum())
                row["goals_against"] = float((values < 0).sum())
        self._ended = []
        return row


class Log:
    """Writes one row per update; a resumed run drops the rows after its checkpoint."""

    def __init__(self, args: Args, samples: int, size: int) -> None:
        """Go on after `samples`, with a CSV file cut back to `size` bytes."""
        from torch.utils.tensorboard import SummaryWriter
        from tqdm import tqdm

        self._path = args.out / FILE_NAME
        with self._path.open("ab"):
            os.truncate(self._path, size)
        self._board = SummaryWriter(str(args.out / "tensorboard"), purge_step=samples + 1)
        self._bar = tqdm(
            total=args.samples,
            initial=samples,
            disable=not args.progress,
            unit=" samples",
            unit_scale=True,
            smoothing=0.1,
            mininterval=0.5 if sys.stderr.isatty() else 10.0,
            dynamic_ncols=True,
        )
        self._recent: deque[Row] = deque(maxlen=20)

    @property
    def size(self) -> int:
        """Bytes of the CSV file, as a checkpoint remembers them."""
        return self._path.stat().st_size

    def write(self, samples: int, row: Row) -> None:
        """Log one update that ended at `samples`."""
        with self._path.open("a", newline="") as file:
            writer = csv.DictWriter(file, list(row))
            if file.tell() == 0:
                writer.writeheader()
            writer.writerow(row)
        for name, value in row.items():
            if np.isfinite(value):
                self._board.add_scalar(name, value, samples)
        self._recent.append(row)
        self._bar.set_postfix_str(self._summary(), refresh=False)
        self._bar.update(samples - self._bar.n)

    def say(self, message: str) -> None:
        """Show a line above the bar; silent where the bar is off."""
        if not self._bar.disable:
            self._bar.write(message, file=sys.stderr)

    def close(self) -> None:
        """Finish the bar and the files."""
        self._bar.close()
        self._board.close()

    def _summary(self) -> str:
        """Goals and share of wins over the last updates; the reward, where nobody scores."""
        total = {name: sum(row.get(name, 0.0) for row in self._recent) for name in _SUMMED}
        if EPISODE + SCORE not in self._recent[-1] or not total["episodes"]:
            return f"reward {self._recent[-1]['reward']:.3f}"
        goals_for, goals_against = total["goals_for"], total["goals_against"]
        won = goals_for / total["episodes"]
        return f"goals {goals_for:.0f}:{goals_against:.0f}, won {won:.0%}"


_SUMMED = ("episodes", "goals_for", "goals_against")


def against(kind: str, metric: str) -> str:
    """Column of a metric's mean over episodes against one kind of opponent."""
    return f"episode_{kind}/{metric}"


def read_progress(folder: Path) -> dict[str, Array]:
    """Columns of a run's CSV file, each (updates,)."""
    with (folder / FILE_NAME).open(newline="") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{folder / FILE_NAME} holds no rows yet")
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def _mean(values: Array) -> float:
    return float(values.mean()) if len(values) else float("nan")
