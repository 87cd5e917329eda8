"""What the numbers look like: pictures of roll-outs, chips, bounces, drives and a dribble."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, radians, sin
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rsoccer.frame import Array
from tools.physics.air import chip
from tools.physics.bounces import at_wall, off_wall
from tools.physics.cited import BALLS, GENERIC
from tools.physics.closed_form import RollOut
from tools.physics.floor import roll_out

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = {
    "ssl_tigers": "#3a7d44",
    "ssl_erforce": "#d98e04",
    "ssl_vision": "#8a8f98",
    "grsim": "#b5483a",
    "vss_rsim": "#2f6f9f",
}
DASHED = {"ssl_vision", "vss_rsim"}  # so that what they lie on shows
KICK = 4.0  # m/s


def figure(columns: int = 1, width: float = 8.0, height: float = 4.5) -> tuple[Figure, list[Axes]]:
    """An empty picture in the style of the others in `docs/`."""
    from matplotlib.figure import Figure

    made = Figure(figsize=(width, height), dpi=130, layout="constrained")
    axes = [made.add_subplot(1, columns, 1 + column) for column in range(columns)]
    for each in axes:
        each.grid(alpha=0.25)
    return made, axes


def draw_roll() -> Figure:
    """Speed of a kick against its way, with the closed form as dots."""
    made, [axes] = figure()
    for name, ball in BALLS.items():
        form = RollOut(ball, KICK)
        track = roll_out(name, (KICK,), form.stop_time + 0.5).ball
        way = np.append(0.0, track.position[:, 0, 0])
        speed = np.append(KICK, track.velocity[:, 0, 0])
        axes.plot(way, speed, color=COLOURS[name], linewidth=2, label=name)
        marks = np.arange(0.5, form.stop, 1.5)
        expected = [form.speed_at(at) or 0.0 for at in marks]
        axes.plot(marks, expected, "o", color=COLOURS[name], markersize=4)
    axes.set(xlim=(0, 29), ylim=(0, 4.2), xlabel="way (m)", ylabel="speed (m/s)")
    axes.set_title(f"A straight kick of {KICK:g} m/s: it slides, then rolls (dots: closed form)")
    axes.legend(frameon=False, title="ball")
    return made


def draw_chip() -> Figure:
    """Where chips of 5.5 m/s at 45 degrees fly and hop."""
    made, [axes] = figure(height=4.0)
    for name in BALLS:
        track = chip(name, 5.5, 3.0).ball
        x, z = np.append(0.0, track.position[:, 0, 0]), np.append(0.0, track.height[:, 0])
        shown = x < 7.5
        style = (0, (4, 2)) if name in DASHED else "-"
        axes.plot(x[shown], z[shown], color=COLOURS[name], linestyle=style, linewidth=2, label=name)
    axes.axhline(GENERIC.height, color="black", linewidth=0.8, linestyle="--")
    axes.text(7.45, GENERIC.height + 0.01, "height of a robot", ha="right", va="bottom")
    axes.set(xlim=(0, 7.5), ylim=(0, 0.85), xlabel="way (m)", ylabel="height (m)")
    axes.set_title("A chip of 5.5 m/s at 45 degrees")
    axes.legend(frameon=False, title="ball")
    return made


def draw_bounce() -> Figure:
    """What is left of the speed along a wall, and the spin, over the angle of incidence."""
    made, axes = figure(2, width=9.0)
    for name, first in (("ssl_tigers", 6.0), ("grsim", 9.0)):
        angles = np.arange(first, 88.0, 6.0)
        after = at_wall(name, *_split(4.0, angles)).ball
        fine = np.linspace(1.0, 89.0, 177)
        law = np.array([_coulomb(name, float(angle)) for angle in fine])
        colour = COLOURS[name]
        measured = (after.velocity[-1, :, 0], after.spin[-1, :, 2])
        for panel, values, expected in zip(axes, measured, law.T, strict=True):
            panel.plot(fine, expected, color=colour, linewidth=2, label=f"{name}, Coulomb's law")
            panel.plot(angles, values, "o", color=colour, markersize=4, label=f"{name}, measured")
    axes[0].set(ylabel="speed along the wall afterwards (m/s)", ylim=(0, 4.1))
    axes[1].set(ylabel="spin about the vertical axis (rad/s)", ylim=(0, None))
    for panel in axes:
        panel.set(xlim=(0, 90), xlabel="angle between way and wall (degrees)")
    axes[1].legend(frameon=False)
    made.suptitle("A ball of 4 m/s off a wall")
    return made


def _split(speed: float, degrees: Array) -> tuple[Array, Array]:
    """Towards a wall and along it."""
    return speed * np.sin(np.radians(degrees)), speed * np.cos(np.radians(degrees))


def _coulomb(name: str, degrees: float) -> tuple[float, float]:
    towards, along = 4.0 * sin(radians(degrees)), 4.0 * cos(radians(degrees))
    velocity, spin = off_wall(BALLS[name], towards, along)
    return float(velocity[0]), float(spin[2])


def draw_all(folder: Path, pictures: dict[str, Callable[[], Figure]]) -> None:
    """Write each picture into `folder`."""
    for name, draw in pictures.items():
        draw().savefig(folder / f"physics_{name}.png", metadata={"Software": None})
