"""Layouts and states for tests of messages."""

from typing import Final

import numpy as np

from rsoccer import SimConfig
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.protocols.layout import WireLayout

SSL: Final = SimConfig("ssl_b", 3, 4)
VSSS: Final = SimConfig("vss_3v3", 3, 3)
WHEELS: Final = SimConfig("ssl_b", 3, 4, robot="ssl_generic_wheels")
SIDES: Final = (False, True)


def layout(config: SimConfig = SSL, *, positive: bool = False) -> WireLayout:
    """A match whose robots have unusual numbers."""
    blue = (5, 0, 11)[: config.n_blue]
    yellow = (7, 3, 1, 15)[: config.n_yellow]
    return WireLayout(config, blue, yellow, positive)


def state(config: SimConfig = SSL, worlds: int = 2, seed: int = 0) -> Frame:
    """States in which all columns that messages have differ."""
    rng, shape = np.random.default_rng(seed), (worlds, config.n_robots)
    frame = Frame.empty(worlds, config.n_blue, config.n_yellow)
    angles = rng.uniform(-np.pi, np.pi, shape)
    frame.robots.position[:] = rng.uniform(-0.6, 0.6, (*shape, 2))
    frame.robots.heading[:] = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    frame.robots.velocity[:] = rng.uniform(-2.0, 2.0, (*shape, 2))
    frame.robots.angular_velocity[:] = rng.uniform(-5.0, 5.0, shape)
    frame.ball.position[:] = rng.uniform(-0.6, 0.6, (worlds, 2))
    frame.ball.velocity[:] = rng.uniform(-3.0, 3.0, (worlds, 2))
    frame.ball.height[:] = rng.uniform(0.0, 0.5, worlds)
    frame.ball.vertical_velocity[:] = rng.uniform(-1.0, 1.0, worlds)
    return frame


def commands(config: SimConfig = SSL, seed: int = 0) -> Floats:
    """Commands of all robots, with kicks and dribblers."""
    rng = np.random.default_rng(seed)
    rows = rng.uniform(-2.0, 2.0, (config.n_robots, len(config.command_columns)))
    for name in ("kick_v_x", "kick_v_z", "dribbler"):
        if name in config.command_columns:
            rows[:, config.command_columns.index(name)] = rng.uniform(0.1, 1.0, config.n_robots)
    return rows.astype(np.float32)


def codes(problems: object) -> list[str]:
    """Codes of problems."""
    return [str(problem.code) for problem in problems]  # type: ignore[attr-defined]
