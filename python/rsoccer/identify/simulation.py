"""Paths of single robots under logged commands, simulated in windows at once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer._core import (
    COMMAND_COLUMNS,
    MAX_PLACED_ANGULAR_VELOCITY,
    MAX_PLACED_SPEED,
    BallModel,
    Field,
    RobotModel,
    SimConfig,
    Simulator,
)
from rsoccer.arrays import Doubles, Floats
from rsoccer.frame import Frame

TICK: Final = 0.005
"""Physics tick of the simulation, s: that of all tasks."""
_SIZE: Final = 200.0  # m: of a floor whose ends no robot reaches


@dataclass(frozen=True)
class Paths:
    """Simulated poses of w windows at the ends of ticks, from the pose (0, 0, 0)."""

    positions: Doubles
    """(ticks + 1, w, 2) m."""
    headings: Doubles
    """(ticks + 1, w) rad, without jumps."""

    def at(self, ticks: Doubles) -> tuple[Doubles, Doubles]:
        """Return poses between ticks.

        Args:
            ticks: (n, w) times since the start, in ticks; clipped to the simulated time.

        Returns:
            Positions (n, w, 2) in m and headings (n, w) in rad.
        """
        ticks = np.clip(ticks, 0.0, len(self.headings) - 1.001)
        before = ticks.astype(np.intp)
        part = ticks - before
        window = np.arange(ticks.shape[1])
        first, last = self.positions[before, window], self.positions[before + 1, window]
        positions = first + part[..., None] * (last - first)
        first, last = self.headings[before, window], self.headings[before + 1, window]
        return positions, first + part * (last - first)


def simulate(model: RobotModel, commands: Doubles, velocities: Doubles) -> Paths:
    """Drive a robot of a model through w windows.

    Args:
        model: the robot.
        commands: (ticks, w, columns) commands of the wheels that hold in each tick.
        velocities: (w, 3) velocity forward and to the left (m/s) and angular velocity (rad/s) at
            the start.

    Returns:
        The paths.
    """
    windows, columns = commands.shape[1:]
    field = Field("ssl_a", length=_SIZE, width=_SIZE)
    ball = BallModel("ssl_tigers")
    config = SimConfig(field, 1, 0, robot=model, ball=ball, time_step=TICK, tick=TICK)
    simulator = Simulator(config, windows)
    rows = np.zeros((windows, config.row_size), np.float32)
    frame = Frame(rows, 1, 0)
    frame.ball.position[:] = (0.0, 0.4 * _SIZE)
    robot = frame.blue
    robot.heading[:, 0] = (1.0, 0.0)
    robot.velocity[:, 0] = _within(velocities[:, :2], MAX_PLACED_SPEED)
    limit = MAX_PLACED_ANGULAR_VELOCITY
    robot.angular_velocity[:, 0] = np.clip(velocities[:, 2], -limit, limit)
    simulator.place(np.ones(windows, np.bool_), rows, rows)
    return _driven(simulator, frame, _padded(commands, model, columns))


def _driven(simulator: Simulator, frame: Frame, commands: Floats) -> Paths:
    """Poses under commands that hold for a tick each."""
    ticks, windows = commands.shape[:2]
    poses = np.empty((ticks + 1, windows, 4), np.float64)
    robot = frame.blue
    for tick in range(ticks + 1):
        if tick:
            simulator.step(commands[tick - 1], frame.rows)
        poses[tick, :, :2], poses[tick, :, 2:] = robot.position[:, 0], robot.heading[:, 0]
    headings = np.unwrap(np.arctan2(poses[..., 3], poses[..., 2]), axis=0)
    return Paths(poses[..., :2], headings)


def _padded(commands: Doubles, model: RobotModel, columns: int) -> Floats:
    """Commands with all columns of the model's: no kick, no dribbler."""
    ticks, windows = commands.shape[:2]
    padded = np.zeros((ticks, windows, 1, len(COMMAND_COLUMNS[model.drive])), np.float32)
    padded[:, :, 0, :columns] = commands
    return padded


def _within(velocities: Doubles, limit: float) -> Doubles:
    """Velocities that are at most as fast as a limit."""
    speeds = np.linalg.norm(velocities, axis=1, keepdims=True)
    slower: Doubles = velocities * np.minimum(1.0, limit / np.maximum(speeds, 1e-9))
    return slower
