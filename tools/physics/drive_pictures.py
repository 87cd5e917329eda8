"""Pictures of drives: step responses, and a ball that is dribbled along."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rsoccer import SimConfig
from rsoccer.frame import Array
from tools.physics import differential, omni
from tools.physics.cited import GENERIC, VSS_ROBOTS
from tools.physics.kicker import reach
from tools.physics.pictures import figure
from tools.physics.scene import TICK, Scene, Track

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BLUE, YELLOW, GREEN = "#2f6f9f", "#d98e04", "#3a7d44"
BALL = "#d9541e"


def draw_steps() -> Figure:
    """From rest to full speed and back, forward and on the spot."""
    made, (forward, turn) = figure(2, width=9.0)
    for axes, command, what, label in (
        (forward, {"v_x": 3.0}, "speed", "ssl_generic, told 3 m/s"),
        (turn, {"v_theta": 20.0}, "spin", "ssl_generic, told 20 rad/s"),
    ):
        _draw_step(axes, omni.alone(), command, what, label, GREEN)
    for name, colour in zip(VSS_ROBOTS, (BLUE, YELLOW), strict=True):
        full = {"left": 1e3, "right": 1e3}
        about = {"left": -1e3, "right": 1e3}
        label = f"{name}, full speed"
        _draw_step(forward, differential.alone(name), full, "speed", label, colour)
        _draw_step(turn, differential.alone(name), about, "spin", label, colour)
    forward.set(xlabel="time (s)", ylabel="speed (m/s)", xlim=(0, 1.6), ylim=(0, 4.2))
    turn.set(xlabel="time (s)", ylabel="turn rate (rad/s)", xlim=(0, 1.6), ylim=(0, 62))
    for axes in (forward, turn):
        axes.legend(frameon=False, loc="upper right")
    made.suptitle("From rest to speed; at 0.8 s told to stop")
    return made


def _draw_step(
    axes: Axes, scene: Scene, command: dict[str, float], what: str, label: str, colour: str
) -> None:
    scene.tell(0, **command)
    match = scene.begin()
    tracks = [match.run(0.8)]
    scene.tell(0, **dict.fromkeys(command, 0.0))
    tracks.append(match.run(0.8))
    values = [_values(track, what) for track in tracks]
    times = np.arange(len(values[0]) + len(values[1]) + 1) * TICK
    axes.plot(times, np.concatenate([[0.0], *values]), color=colour, linewidth=2, label=label)


def _values(track: Track, what: str) -> Array:
    values: Array = omni.speeds(track)[:, 0] if what == "speed" else track.robots.spin[:, 0, 0]
    return values


def draw_dribble() -> Figure:
    """Robot and ball from above: along a loop with the dribbler on, then it is turned off."""
    scene = Scene(SimConfig("ssl_b", 1, 0, time_step=TICK))
    scene.ball.position[:] = (reach(), 0.0)
    scene.tell(0, v_x=0.6, dribbler=1.0)
    match = scene.begin()
    parts = [match.run(0.8)]
    scene.tell(0, v_theta=2.0)
    parts.append(match.run(2.4))
    scene.tell(0, v_x=0.0, v_theta=0.0, dribbler=0.0)
    parts.append(match.run(1.2))
    made, [axes] = figure(width=8.0, height=4.5)
    robot = np.concatenate([part.robots.data[:, 0, 0] for part in parts])
    ball = np.concatenate([part.ball.position[:, 0] for part in parts])
    off = len(parts[0].times) + len(parts[1].times)
    axes.plot(*robot[:, :2].T, color=BLUE, linewidth=2, label="robot's centre")
    axes.plot(*ball[:off].T, color=BALL, linewidth=2, label="ball, dribbler on")
    axes.plot(*ball[off:].T, color=BALL, linewidth=2, linestyle=":", label="ball, dribbler off")
    for step in (0, *range(79, off, 100), off - 1):
        _draw_robot(axes, robot[step], ball[step])
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    axes.set_title("Forward at 0.6 m/s, then also turning at 2 rad/s; then let go")
    axes.legend(frameon=False, loc="upper left")
    return made


def _draw_robot(axes: Axes, robot: Array, ball: Array) -> None:
    """Its outline, the flat front where it faces, and the ball."""
    half = np.arccos(GENERIC.front / GENERIC.radius)
    around = np.arctan2(robot[3], robot[2]) + np.linspace(half, 2 * np.pi - half, 60)
    x, y = robot[:2, None] + GENERIC.radius * np.stack([np.cos(around), np.sin(around)])
    axes.fill(x, y, facecolor=BLUE, edgecolor=BLUE, alpha=0.25)
    around = np.linspace(0, 2 * np.pi, 40)
    x, y = ball[:, None] + 0.0215 * np.stack([np.cos(around), np.sin(around)])
    axes.fill(x, y, facecolor=BALL, alpha=0.7)
