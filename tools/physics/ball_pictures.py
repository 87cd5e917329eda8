"""Pictures of straight kicks, chips and bounces for docs/physics.md."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, radians, sin
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.arrays import Array
from tools.physics.ball_bounces import at_wall, off_wall
from tools.physics.ball_flight import chip
from tools.physics.ball_rolling import simulate_kicks
from tools.physics.cited import BALLS, GENERIC
from tools.physics.closed_form import StraightKick

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = {
    "ssl_tigers": "#3a7d44",
    "ssl_erforce": "#d98e04",
    "ssl_erforce_simulator": "#8a5a00",
    "ssl_vision": "#8a8f98",
    "ssl_robocup_2023": "#6b4fa0",
    "ssl_lab_2023": "#c05a9a",
    "grsim": "#b5483a",
    "vss_rsim": "#2f6f9f",
}
DASHED = {
    "ssl_erforce_simulator",
    "ssl_vision",
    "ssl_robocup_2023",
    "ssl_lab_2023",
    "vss_rsim",
}  # so that curves below them stay visible
KICK = 4.0  # m/s


def figure(columns: int = 1, width: float = 8.0, height: float = 4.5) -> tuple[Figure, list[Axes]]:
    """Return an empty figure and its axes in the style of the pictures in `docs/`."""
    from matplotlib.figure import Figure

    made = Figure(figsize=(width, height), dpi=130, layout="constrained")
    axes = [made.add_subplot(1, columns, 1 + column) for column in range(columns)]
    for each in axes:
        each.grid(alpha=0.25)
    return made, axes


def draw_roll() -> Figure:
    """Draw the speed of a kick over distance, with the closed form as dots."""
    made, [axes] = figure()
    for name, ball in BALLS.items():
        form = StraightKick(ball, KICK)
        trajectory = simulate_kicks(name, (KICK,), form.stop_time + 0.5).ball
        distance = np.append(0.0, trajectory.position[:, 0, 0])
        speed = np.append(KICK, trajectory.velocity[:, 0, 0])
        axes.plot(distance, speed, color=COLORS[name], linewidth=2, label=name)
        marks = np.arange(0.5, form.stop_distance, 1.5)
        expected = [form.speed_at(at) or 0.0 for at in marks]
        axes.plot(marks, expected, "o", color=COLORS[name], markersize=4)
    axes.set(xlim=(0, 29), ylim=(0, 4.2), xlabel="distance (m)", ylabel="speed (m/s)")
    axes.set_title(f"Straight kick of {KICK:g} m/s: sliding, then rolling (dots: closed form)")
    axes.legend(frameon=False, title="ball")
    return made


def draw_chip() -> Figure:
    """Draw chips of 5.5 m/s at 45 degrees."""
    made, [axes] = figure(height=4.0)
    for name in BALLS:
        trajectory = chip(name, 5.5, 3.0).ball
        x, z = np.append(0.0, trajectory.position[:, 0, 0]), np.append(0.0, trajectory.height[:, 0])
        visible = x < 7.5
        style = (0, (4, 2)) if name in DASHED else "-"
        axes.plot(
            x[visible], z[visible], color=COLORS[name], linestyle=style, linewidth=2, label=name
        )
    axes.axhline(GENERIC.height, color="black", linewidth=0.8, linestyle="--")
    axes.text(7.45, GENERIC.height + 0.01, "robot height", ha="right", va="bottom")
    axes.set(xlim=(0, 7.5), ylim=(0, 0.85), xlabel="distance (m)", ylabel="height (m)")
    axes.set_title("Chip of 5.5 m/s at 45 degrees")
    axes.legend(frameon=False, title="ball")
    return made


def draw_bounce() -> Figure:
    """Draw tangential speed and spin after a wall bounce over the angle of incidence."""
    made, axes = figure(2, width=9.0)
    for name, smallest in (("ssl_tigers", 6.0), ("grsim", 9.0)):
        angles = np.arange(smallest, 88.0, 6.0)
        after = at_wall(name, *_split(4.0, angles)).ball
        fine = np.linspace(1.0, 89.0, 177)
        law = np.array([_coulomb(name, float(angle)) for angle in fine])
        color = COLORS[name]
        measured = (after.velocity[-1, :, 0], after.spin[-1, :, 2])
        for panel, values, expected in zip(axes, measured, law.T, strict=True):
            panel.plot(fine, expected, color=color, linewidth=2, label=f"{name}, Coulomb friction")
            panel.plot(angles, values, "o", color=color, markersize=4, label=f"{name}, measured")
    axes[0].set(ylabel="tangential speed after the bounce (m/s)", ylim=(0, 4.1))
    axes[1].set(ylabel="vertical spin after the bounce (rad/s)", ylim=(0, None))
    for panel in axes:
        panel.set(xlim=(0, 90), xlabel="angle between path and wall (degrees)")
    axes[1].legend(frameon=False)
    made.suptitle("Bounce of a ball off a wall at 4 m/s")
    return made


def _split(speed: float, degrees: Array) -> tuple[Array, Array]:
    """Return the speeds toward a wall and along it."""
    return speed * np.sin(np.radians(degrees)), speed * np.cos(np.radians(degrees))


def _coulomb(name: str, degrees: float) -> tuple[float, float]:
    toward, along = 4.0 * sin(radians(degrees)), 4.0 * cos(radians(degrees))
    velocity, spin = off_wall(BALLS[name], toward, along)
    return float(velocity[0]), float(spin[2])


def draw_all(folder: Path, pictures: dict[str, Callable[[], Figure]]) -> None:
    """Write each picture as PNG into `folder`."""
    for name, draw in pictures.items():
        draw().savefig(folder / f"physics_{name}.png", metadata={"Software": None})
