"""Pictures of the report: learning curves of all tasks, and bars of the ablation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from benches.learning.ablation import CHANGES, OURS, PAPER
from benches.learning.reporting.collection import Collected, finished
from benches.learning.reporting.curves import band

if TYPE_CHECKING:
    from matplotlib.axes import Axes

COLORS: Final = {"ppo": "#1f6f8b", "ddpg": "#c8553d", "sac": "#d9a441"}
BAR, REFERENCE, POINT = "#7fb7c9", "#1f6f8b", "#333333"
COLUMNS: Final = 2
PANEL: Final = (4.4, 2.3)  # inches
SCRIPTS: Final = ("scripted", "strike")
"""Strongest scripts of the leagues."""
SHARES: Final = ("goal_score", "reached", "received")
"""Metrics of which 1 is the best value."""


def draw_curves(collected: Sequence[Collected], path: Path) -> Path | None:
    """Write a picture of the learning curves of all tasks; None without any."""
    from matplotlib.figure import Figure

    shown = [*finished(collected, "ppo"), *finished(collected, "baselines")]
    shown = [part for part in shown if band([result["curve"] for result in part.results])]
    tasks = list(dict.fromkeys(part.experiment.task for part in shown))
    if not tasks:
        return None
    rows = -(-len(tasks) // COLUMNS)
    size = (PANEL[0] * min(COLUMNS, len(tasks)), PANEL[1] * rows + 0.3)
    figure = Figure(figsize=size, dpi=110, layout="constrained")
    handles: dict[str, Any] = {}
    for index, task in enumerate(tasks):
        axes = figure.add_subplot(rows, min(COLUMNS, len(tasks)), index + 1)
        _draw_task(axes, task, [part for part in shown if part.experiment.task == task])
        lines, labels = axes.get_legend_handles_labels()
        handles.update(zip(labels, lines, strict=True))
    style = {"frameon": False, "fontsize": 9, "ncols": len(handles)}
    figure.legend(handles.values(), handles, loc="outside upper center", **style)
    caption = "millions of samples; mean of the seeds, its 95% interval, and each seed"
    figure.supxlabel(caption, fontsize=9)
    figure.savefig(path)
    return path


def _draw_task(axes: Axes, task: str, parts: Sequence[Collected]) -> None:
    """Curves of one task: means over seeds with their intervals, and the curve of each seed."""
    from matplotlib.ticker import LogLocator, NullFormatter

    metric = ""
    for part in parts:
        curves = [result["curve"] for result in part.results]
        drawn, color = band(curves), COLORS[part.experiment.algorithm]
        if drawn is None:
            continue
        samples, means, low, high = drawn
        metric = curves[0]["metric"]
        axes.fill_between(samples, low, high, color=color, alpha=0.25, linewidth=0)
        label = part.experiment.algorithm.upper()
        axes.plot(samples, means, color=color, linewidth=1.8, label=label)
        for curve in curves:
            axes.plot(curve["samples"], curve["values"], color=color, alpha=0.3, linewidth=0.6)
        _draw_script(axes, part, color)
    # DDPG and SAC have a tenth of the samples of PPO, or fewer.
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 3.0)))
    axes.xaxis.set_major_formatter(lambda value, _: f"{value / 1e6:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    if metric in SHARES:
        lines = (np.asarray(line.get_ydata(), np.float64) for line in axes.get_lines())
        lowest = min(float(values.min(initial=0.0)) for values in lines)
        axes.set_ylim(lowest - 0.04, 1.04)
        axes.axhline(0.0, color="black", linewidth=0.6)
    stale = "*" if any(part.stale for part in parts) else ""
    axes.set_title(f"{task}{stale}: {_measured(metric, parts[0].opponents[0])}", fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(alpha=0.25)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _draw_script(axes: Axes, part: Collected, color: str) -> None:
    """Mean of the curves against the strongest script, if the run was measured against one."""
    ladders = [result.get("ladder", {}) for result in part.results]
    for script in SCRIPTS:
        drawn = band([ladder[script] for ladder in ladders if script in ladder])
        if drawn is not None:
            samples, means, _, _ = drawn
            label = f"{part.experiment.algorithm.upper()} against {script}"
            axes.plot(samples, means, color=color, linewidth=1.2, linestyle="--", label=label)


def draw_ablation(collected: Sequence[Collected], path: Path) -> Path | None:
    """Write a picture of the ablation: one change added to the paper's setting, one left out."""
    from matplotlib.figure import Figure

    parts = {part.experiment.name: part for part in finished(collected, "ablation")}
    if not parts:
        return None
    figure = Figure(figsize=(8.8, 3.6), dpi=110, layout="constrained")
    panels = (
        ("The paper's setting, and one change to it", PAPER, "+"),
        ("The package's setting, and one change less", OURS, "-"),
    )
    names = [change.name for change in CHANGES]
    lowest = min(min(part.scores()) for part in parts.values())
    for index, (title, base, sign) in enumerate(panels):
        axes = figure.add_subplot(1, 2, index + 1)
        labels = [base, *(f"{sign} {name}" for name in names)]
        keys = [base, *(f"{base}{sign}{name}" for name in names)]
        _draw_bars(axes, labels, [parts.get(key) for key in keys])
        axes.set_xlim(min(lowest, 0.0) - 0.05, 1.05)
        axes.set_title(title, fontsize=10)
    score = next(iter(parts.values())).rows()[0]
    measured = _measured(score["metric"], score["opponent"])
    caption = f"{measured}: interquartile mean, 95% interval, and each seed"
    figure.supxlabel(caption, fontsize=9)
    figure.savefig(path)
    return path


def _measured(metric: str, opponent: str) -> str:
    """Metric in words, and its opponent unless it is the task's own."""
    return metric.replace("_", " ") + ("" if opponent == "-" else f" against {opponent}")


def _draw_bars(axes: Axes, labels: Sequence[str], parts: Sequence[Collected | None]) -> None:
    """A bar for each experiment, with its interval and a point for each seed."""
    labels = [
        f"{label}*" if part is not None and part.stale else label
        for label, part in zip(labels, parts, strict=True)
    ]
    for height, part in enumerate(parts):
        if part is None:
            axes.text(0.02, height, "missing", va="center", fontsize=8, color="#777777")
            continue
        estimate = part.estimate()
        axes.barh(height, estimate.value, 0.7, color=BAR if height else REFERENCE)
        axes.plot([estimate.low, estimate.high], [height, height], color=POINT, linewidth=1.2)
        scores = part.scores()
        axes.plot(scores, [height] * len(scores), "o", color="white", markersize=4, mec=POINT)
        if height == 0:
            axes.axvline(estimate.value, color=REFERENCE, linewidth=0.8, linestyle=":")
    axes.set_yticks(range(len(labels)), labels)
    axes.axvline(0.0, color="black", linewidth=0.6)
    axes.invert_yaxis()
    axes.grid(axis="x", alpha=0.25)
    axes.set_axisbelow(True)
    axes.tick_params(axis="y", length=0, labelsize=8)
    axes.tick_params(axis="x", labelsize=8)
    for side in ("top", "right", "left"):
        axes.spines[side].set_visible(False)
