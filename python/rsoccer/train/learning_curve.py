"""Plot of a run's learning curve."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from rsoccer.arrays import Array
from rsoccer.registry import make_task
from rsoccer.train.args import SETTINGS_FILE
from rsoccer.train.log import GOAL_SCORE, opponent_column, read_progress

STYLES = {
    "ou": ("Ornstein-Uhlenbeck policy", "#3a7d44"),
    "past": ("past policies", "#d98e04"),
    "latest": ("current policy", "#8a8f98"),
}
"""Label and colour of the curve for each kind of opponent."""


def plot_learning_curve(folder: Path, path: Path, *, window: int = 15) -> Path:
    """Plot the goal score against each kind of opponent over samples as a PNG file.

    The title names the task of the run and the sizes of its teams.

    Args:
        folder: folder of the run, which holds its log.
        path: the file to write.
        window: updates that the moving average covers.

    Returns:
        `path`.

    Raises:
        ValueError: the log has no rows yet.
    """
    from matplotlib.figure import Figure

    progress = read_progress(folder)
    figure = Figure(figsize=(8.0, 4.5), dpi=130, layout="constrained")
    axes = figure.add_subplot()
    for kind, (label, colour) in STYLES.items():
        scores = progress.get(opponent_column(kind, GOAL_SCORE), np.zeros(0))
        if np.isfinite(scores).any():
            smooth = _moving_average(scores, window)
            axes.plot(progress["samples"] / 1e6, smooth, label=label, color=colour, linewidth=2)
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set(ylim=(-1.05, 1.05), xlabel="samples (millions of decisions)")
    axes.set_ylabel("goal score while exploring\n(wins - losses) / matches")
    axes.set_title(_title(folder))
    axes.grid(alpha=0.25)
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="lower right", frameon=False, title="against")
    figure.savefig(path)
    return path


def _title(folder: Path) -> str:
    """Title with the task of the run, if the folder holds its settings."""
    settings = folder / SETTINGS_FILE
    if not settings.is_file():
        return "Learning to play"
    saved = json.loads(settings.read_text())
    task = make_task(saved["task"], **saved.get("task_options", {}))
    return f"Learning to play {task.name}, {task.n_blue} v {task.n_yellow}"


def _moving_average(values: Array, window: int) -> Array:
    """Mean over the last `window` values without the NaN ones, (updates,)."""
    known = np.isfinite(values)
    sums = np.convolve(np.where(known, values, 0.0), np.ones(window))[: len(values)]
    counts = np.convolve(known.astype(float), np.ones(window))[: len(values)]
    means: Array = np.divide(sums, counts, out=np.full(len(values), np.nan), where=counts > 0)
    return means
