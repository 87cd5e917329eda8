"""The fit of two floors to tracked kicks, for docs/physics.md: a table and a picture."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from benches.markdown import table
from rsoccer._core import BallModel
from rsoccer.arrays import Array
from tools.physics.ball_pictures import figure
from tools.physics.ball_rolling import ENDLESS
from tools.physics.kicks import FIGURES
from tools.physics.scene import Scene, make_config

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = ("#3a7d44", "#d98e04", "#6b4fa0", "#b5483a", "#2f6f9f")


def figures() -> dict[str, Any]:
    """Return the figures of the fit by preset."""
    read: dict[str, Any] = json.loads(FIGURES.read_text())
    return read


def kick_table() -> str:
    """Return the table of kicks with their slides and the speeds that the fits predict."""
    header = (
        "preset",
        "kick (m/s)",
        "sliding deceleration (m/s²)",
        "rolling share",
        "speed after 3 m of rolling, measured (m/s)",
        "by the preset (m/s)",
        "error",
        "by the other kicks (m/s)",
        "error",
    )
    rows = []
    for preset, venue in figures().items():
        for kick in venue["kicks"]:
            if not (predictions := kick["predictions"]):
                continue
            row = [
                f"`{preset}`",
                f"{kick['speed']:.2f}",
                f"{kick['sliding_deceleration']:.2f}",
                f"{kick['slide_to_roll_ratio']:.2f}",
                f"{predictions['fit']['measured']:.2f}",
            ]
            for by in ("fit", "others"):
                row += _prediction(predictions.get(by))
            rows.append(tuple(row))
    return table(header, rows)


def _prediction(prediction: dict[str, float] | None) -> tuple[str, str]:
    """Return a predicted speed and its error as text; dashes if there is none."""
    if prediction is None:
        return "-", "-"
    error = prediction["predicted"] / prediction["measured"] - 1
    return f"{prediction['predicted']:.2f}", f"{error:+.1%}"


def roll(preset: str, speed: float, distance: float) -> tuple[Array, Array]:
    """Return distances (m) and speeds (m/s) of a simulated roll, up to a distance (m)."""
    scene = Scene(make_config(ENDLESS, 0, 0, ball=preset))
    scene.ball.velocity[:, 0] = speed
    scene.ball.spin[:, 1] = speed / BallModel(preset).radius
    ball = scene.play(12.0).ball
    away, speeds = ball.position[:, 0, 0], ball.velocity[:, 0, 0]
    part = away <= distance
    return np.append(0.0, away[part]), np.append(speed, speeds[part])


def draw_kicks() -> Figure:
    """Draw speeds of rolling balls over distance: measured as dots, simulated as lines."""
    made, axes = figure(2, width=10.0)
    for panel, (preset, venue) in zip(axes, figures().items(), strict=True):
        kicks = [kick for kick in venue["kicks"] if kick["speeds"]]
        for kick, color in zip(kicks, COLORS, strict=False):
            for run, filled in zip(kick["speeds"], (True, False), strict=False):
                _draw_run(panel, preset, np.array(run), color, filled)
            panel.plot([], [], "o", color=color, label=f"{kick['speed']:.1f} m/s")
        panel.set(xlim=(0, None), ylim=(0, None), xlabel="distance rolled (m)")
        panel.set_title(preset)
        panel.legend(frameon=False, title="kick")
    axes[0].set(ylabel="speed (m/s)")
    return made


def _draw_run(panel: Axes, preset: str, run: Array, color: str, filled: bool) -> None:
    distance = run[:, 0] - run[0, 0]
    panel.plot(*_nearest_roll(preset, distance, run[:, 1]), color=color, linewidth=1.2)
    face = color if filled else "white"
    panel.plot(distance, run[:, 1], "o", color=color, markerfacecolor=face, markersize=3.5)


def _nearest_roll(preset: str, distance: Array, speeds: Array) -> tuple[Array, Array]:
    """Return the simulated roll whose mean speed at these distances is the measured one."""
    slow, fast = 0.5 * float(speeds[0]), 1.5 * float(speeds[0])
    for _ in range(12):  # bisection for the first speed
        first = (slow + fast) / 2
        away, simulated = roll(preset, first, float(distance[-1]))
        too_slow = np.interp(distance, away, simulated).mean() < speeds.mean()
        slow, fast = (first, fast) if too_slow else (slow, first)
    return away, simulated
