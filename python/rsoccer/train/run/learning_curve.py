"""Plot of a run's learning curve."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rsoccer.arrays import Array
from rsoccer.evaluate.episodes import RETURN
from rsoccer.registry import make_task
from rsoccer.task import Task
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.rollout.episode_stats import EPISODE_PREFIX, GOAL_SCORE, opponent_column
from rsoccer.train.run.log import LADDER_PREFIX, ladder_column, read_progress

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLORS = {
    "zero": "#8a8f98",
    "ou": "#3a7d44",
    "chase": "#2f6db3",
    "scripted": "#b3402f",
    "strike": "#b3402f",
    "past": "#d98e04",
    "latest": "#8a8f98",
}
"""Color of the curve for each opponent; other policies have colors of matplotlib's cycle."""
LABELS = {"past": "past policies", "latest": "current policy"}
"""Labels of opponents that are not named as policies."""


def plot_learning_curve(folder: Path, path: Path, *, window: int = 15) -> Path:
    """Plot the strength of the policy over samples as a PNG file.

    For tasks with opponents this is the goal score against each opponent of the ladder, for others
    the task's success metric. Without measurements of the ladder it is the score while exploring,
    against each kind of opponent in training. The title names the task and the sizes of its teams.

    Args:
        folder: folder of the run, which holds its log.
        path: the file to write.
        window: updates that the moving average of scores while exploring covers.

    Returns:
        `path`.

    Raises:
        ValueError: the log has no rows yet.
    """
    from matplotlib.figure import Figure

    progress, task = read_progress(folder), _task(folder)
    figure = Figure(figsize=(8.0, 4.5), dpi=130, layout="constrained")
    axes = figure.add_subplot()
    metric = GOAL_SCORE if task is None else task.success or RETURN
    exploring = _plot_scores(axes, progress, metric, window)
    axes.set_xlabel("samples (millions of decisions)")
    _set_scale(axes, task, metric, exploring)
    axes.set_title(_title(task))
    axes.grid(alpha=0.25)
    if axes.get_legend_handles_labels()[0]:
        against = exploring or len(axes.get_lines()) > 1
        axes.legend(frameon=False, title="against" if against else None)
    figure.savefig(path)
    return path


def _plot_scores(axes: Axes, progress: dict[str, Array], metric: str, window: int) -> bool:
    """Plot the measurements of the ladder, or without one the scores while exploring; which."""
    ladder = _by_opponent(progress, LADDER_PREFIX, f"_{metric}")
    single = progress.get(ladder_column(metric))
    millions = progress["samples"] / 1e6
    for name, scores in ladder.items():
        known = np.isfinite(scores)
        _plot(axes, name, millions[known], scores[known], marker="o", markersize=3.5)
    if single is not None and (known := np.isfinite(single)).any():
        axes.plot(millions[known], single[known], "o-", color=COLORS["ou"], linewidth=2)
    if ladder or axes.get_lines():
        return False
    by_kind = _by_opponent(progress, *opponent_column(" ", metric).split(" "))
    for name, scores in by_kind.items():
        _plot(axes, name, millions, _moving_average(scores, window))
    own = progress.get(EPISODE_PREFIX + metric, np.zeros(0))
    if not by_kind and np.isfinite(own).any():
        axes.plot(millions, _moving_average(own, window), color=COLORS["ou"], linewidth=2)
    return True


def _by_opponent(progress: dict[str, Array], start: str, end: str) -> dict[str, Array]:
    """Columns with some known values, by the name between the start and the end of theirs."""
    return {
        name[len(start) : -len(end)]: values
        for name, values in progress.items()
        if name.startswith(start) and name.endswith(end) and len(name) > len(start) + len(end)
        if np.isfinite(values).any()
    }


def _plot(axes: Axes, name: str, x: Array, y: Array, **style: Any) -> None:  # noqa: ANN401
    """Plot the scores against one opponent."""
    label, color = LABELS.get(name, name), COLORS.get(name)
    axes.plot(x, y, label=label, color=color, linewidth=2, **style)


def _set_scale(axes: Axes, task: Task | None, metric: str, exploring: bool) -> None:
    """Set the label and the limits of the scores."""
    label = metric.replace("_", " ") + (" while exploring" if exploring else "")
    is_result = task is None or (task.two_sided and task.full_success is not None)
    if metric == GOAL_SCORE and is_result:
        axes.set_ylim(-1.05, 1.05)
        axes.axhline(0.0, color="black", linewidth=0.6)
        label += "\n(wins - losses) / matches"
    elif task is not None and task.success is not None:
        full = task.full_success
        axes.set_ylim(None if metric == GOAL_SCORE else 0.0, None if full is None else 1.05 * full)
    axes.set_ylabel(label)


def _task(folder: Path) -> Task | None:
    """Task of the run, if the folder holds its settings."""
    settings = folder / SETTINGS_FILE
    if not settings.is_file():
        return None
    saved = json.loads(settings.read_text())
    return make_task(saved["task"], **saved.get("task_options", {}))


def _title(task: Task | None) -> str:
    """Title with the task of the run."""
    if task is None:
        return "Learning to play"
    return f"Learning to play {task.name}, {task.n_blue} v {task.n_yellow}"


def _moving_average(values: Array, window: int) -> Array:
    """Mean over the last `window` values without the NaN ones, (updates,)."""
    known = np.isfinite(values)
    sums = np.convolve(np.where(known, values, 0.0), np.ones(window))[: len(values)]
    counts = np.convolve(known.astype(float), np.ones(window))[: len(values)]
    means: Array = np.divide(sums, counts, out=np.full(len(values), np.nan), where=counts > 0)
    return means
