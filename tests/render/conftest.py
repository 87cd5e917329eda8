"""A moment of play that every drawing test can use: all robots apart, a fast ball."""

import math

import pytest

from rsoccer import SimConfig
from rsoccer.frame import Floats, Frame


@pytest.fixture
def config() -> SimConfig:
    return SimConfig()


@pytest.fixture
def row(config: SimConfig) -> Floats:
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    frame.ball.position[0] = 0.12, 0.41
    frame.ball.velocity[0] = 1.1, 0.5
    for i in range(config.n_robots):
        angle = 0.7 * i - 1.3
        frame.robots.position[0, i] = -0.5 + 0.2 * i, 0.3 * math.sin(2.0 * i)
        frame.robots.heading[0, i] = math.cos(angle), math.sin(angle)
    filled: Floats = frame.rows[0]
    return filled
