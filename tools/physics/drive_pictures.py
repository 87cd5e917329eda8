"""Pictures of drives for docs/physics.md: step responses, and dribbling along a loop."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rsoccer.arrays import Array
from tools.physics import differential_drive, omni_drive
from tools.physics.ball_pictures import figure
from tools.physics.cited import GENERIC, VSS_ROBOTS
from tools.physics.kicker import front_offset
from tools.physics.scene import TICK, Scene, Trajectory, make_config

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BLUE, YELLOW, GREEN = "#2f6f9f", "#d98e04", "#3a7d44"
BALL = "#d9541e"


def draw_steps() -> Figure:
    """Draw step responses from rest to full speed and back, forward and turning on the spot."""
    made, (forward, turn) = figure(2, width=9.0)
    for axes, command, quantity, label in (
        (forward, {"v_x": 3.0}, "speed", "ssl_generic, command 3 m/s"),
        (turn, {"v_theta": 20.0}, "angular velocity", "ssl_generic, command 20 rad/s"),
    ):
        _draw_step(axes, omni_drive.lone_robot(), command, quantity, label, GREEN)
    for name, color in zip(VSS_ROBOTS, (BLUE, YELLOW), strict=True):
        full = {"left": 1e3, "right": 1e3}
        on_the_spot = {"left": -1e3, "right": 1e3}
        label = f"{name}, full speed"
        _draw_step(forward, differential_drive.lone_robot(name), full, "speed", label, color)
        _draw_step(
            turn, differential_drive.lone_robot(name), on_the_spot, "angular velocity", label, color
        )
    forward.set(xlabel="time (s)", ylabel="speed (m/s)", xlim=(0, 1.6), ylim=(0, 4.2))
    turn.set(xlabel="time (s)", ylabel="angular velocity (rad/s)", xlim=(0, 1.6), ylim=(0, 62))
    for axes in (forward, turn):
        axes.legend(frameon=False, loc="upper right")
    made.suptitle("Step response from rest to speed; stop command at 0.8 s")
    return made


def _draw_step(
    axes: Axes, scene: Scene, command: dict[str, float], quantity: str, label: str, color: str
) -> None:
    scene.command(0, **command)
    match = scene.begin()
    trajectories = [match.run(0.8)]
    scene.command(0, **dict.fromkeys(command, 0.0))
    trajectories.append(match.run(0.8))
    values = [_values(trajectory, quantity) for trajectory in trajectories]
    times = np.arange(len(values[0]) + len(values[1]) + 1) * TICK
    axes.plot(times, np.concatenate([[0.0], *values]), color=color, linewidth=2, label=label)


def _values(trajectory: Trajectory, quantity: str) -> Array:
    values: Array = (
        omni_drive.speeds(trajectory)[:, 0]
        if quantity == "speed"
        else trajectory.robots.angular_velocity[:, 0, 0]
    )
    return values


def draw_dribble() -> Figure:
    """Draw a robot and its ball from above: a loop with the dribbler on, then off."""
    scene = Scene(make_config("ssl_b", 1, 0, time_step=TICK))
    scene.ball.position[:] = (front_offset(), 0.0)
    scene.command(0, v_x=0.6, dribbler=1.0)
    match = scene.begin()
    parts = [match.run(0.8)]
    scene.command(0, v_theta=2.0)
    parts.append(match.run(2.4))
    scene.command(0, v_x=0.0, v_theta=0.0, dribbler=0.0)
    parts.append(match.run(1.2))
    made, [axes] = figure(width=8.0, height=4.5)
    robot = np.concatenate([part.robots.data[:, 0, 0] for part in parts])
    ball = np.concatenate([part.ball.position[:, 0] for part in parts])
    off = len(parts[0].times) + len(parts[1].times)
    axes.plot(*robot[:, :2].T, color=BLUE, linewidth=2, label="robot center")
    axes.plot(*ball[:off].T, color=BALL, linewidth=2, label="ball, dribbler on")
    axes.plot(*ball[off:].T, color=BALL, linewidth=2, linestyle=":", label="ball, dribbler off")
    for step in (0, *range(79, off, 100), off - 1):
        _draw_robot(axes, robot[step], ball[step])
    axes.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
    axes.set_title("Forward at 0.6 m/s, then turning at 2 rad/s, then dribbler off")
    axes.legend(frameon=False, loc="upper left")
    return made


def _draw_robot(axes: Axes, robot: Array, ball: Array) -> None:
    """Draw a robot's outline with its flat front, and the ball."""
    half = np.arccos(GENERIC.front_distance / GENERIC.radius)
    angles = np.arctan2(robot[3], robot[2]) + np.linspace(half, 2 * np.pi - half, 60)
    x, y = robot[:2, None] + GENERIC.radius * np.stack([np.cos(angles), np.sin(angles)])
    axes.fill(x, y, facecolor=BLUE, edgecolor=BLUE, alpha=0.25)
    angles = np.linspace(0, 2 * np.pi, 40)
    x, y = ball[:, None] + 0.0215 * np.stack([np.cos(angles), np.sin(angles)])
    axes.fill(x, y, facecolor=BALL, alpha=0.7)
