"""Configurations and states for the tests of pictures: robots apart, a fast ball."""

import math

import pytest

from rsoccer import SimConfig
from rsoccer._core import Field
from rsoccer.arrays import Floats
from rsoccer.frame import Frame


@pytest.fixture
def config() -> SimConfig:
    return SimConfig()


@pytest.fixture
def row(config: SimConfig) -> Floats:
    return example_row(config)


@pytest.fixture(params=Field.PRESETS)
def any_config(request: pytest.FixtureRequest) -> SimConfig:
    return SimConfig(request.param, 3, 3)


@pytest.fixture
def any_row(any_config: SimConfig) -> Floats:
    return example_row(any_config)


def example_row(config: SimConfig) -> Floats:
    frame = Frame.empty(1, config.n_blue, config.n_yellow)
    x, y = config.field.half_length, config.field.half_width
    frame.ball.position[0] = 0.16 * x, 0.63 * y
    frame.ball.velocity[0] = 1.1, 0.5
    for i in range(config.n_robots):
        angle = 0.7 * i - 1.3
        frame.robots.position[0, i] = (-0.67 + 0.27 * i) * x, 0.46 * y * math.sin(2.0 * i)
        frame.robots.heading[0, i] = math.cos(angle), math.sin(angle)
    row: Floats = frame.rows[0]
    return row
