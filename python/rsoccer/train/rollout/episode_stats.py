"""Statistics of the episodes that end while a policy learns, as columns of the log."""

from __future__ import annotations

import numpy as np

from rsoccer.arrays import Array

GOAL_SCORE = "goal_score"
"""Metric of an ended episode that counts goals and wins: +1 for the learners, -1 against them."""
EPISODE_PREFIX = "episode/"
"""Prefix of the columns of a task's metrics, which keeps them apart from the run's own columns."""

Row = dict[str, float]
"""Values of one update by column."""


class EpisodeStats:
    """Statistics of the episodes that ended since the last `take`, by kind of opponent."""

    def __init__(self, kinds: tuple[str, ...]) -> None:
        """Start without episodes.

        Args:
            kinds: names of the kinds of opponents.
        """
        self._kinds = kinds
        self._ended: list[tuple[Array, dict[str, Array]]] = []

    def add(self, kinds: Array, metrics: dict[str, Array]) -> None:
        """Add k episodes that ended.

        Args:
            kinds: (k,) index of each episode's opponent into the names of the kinds.
            metrics: (k,) values by metric.
        """
        self._ended.append((kinds, metrics))

    def take(self) -> Row:
        """Return the statistics, and start again without episodes.

        Returns:
            The number of episodes, the mean of each metric over all of them and by kind of
            opponent (NaN where no episode ended), and the episodes won and lost if the task has
            the metric `goal_score`.
        """
        kinds = np.concatenate([kinds for kinds, _ in self._ended])
        row: Row = {"episodes": len(kinds)}
        for name in self._ended[0][1]:
            values = np.concatenate([metrics[name] for _, metrics in self._ended])
            row[EPISODE_PREFIX + name] = mean_or_nan(values)
            for index, kind in enumerate(self._kinds):
                row[opponent_column(kind, name)] = mean_or_nan(values[kinds == index])
            if name == GOAL_SCORE:
                row["wins"] = float((values > 0).sum())
                row["losses"] = float((values < 0).sum())
        self._ended = []
        return row


def opponent_column(kind: str, metric: str) -> str:
    """Return the column of a metric's mean over episodes against one kind of opponent.

    Args:
        kind: name of the kind, such as "ou".
        metric: name of the metric.
    """
    return f"episode_{kind}/{metric}"


def mean_or_nan(values: Array) -> float:
    """Return the mean of values, NaN without any.

    Args:
        values: (k,) numbers.
    """
    return float(values.mean()) if len(values) else float("nan")
