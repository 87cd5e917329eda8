"""Scenes to simulate: a start in one or more worlds, commands, and the resulting trajectory."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

import numpy as np

from benches.scenarios import DEFAULT_ENGINE
from rsoccer import Frame, SimConfig, Simulator
from rsoccer._core import (
    BALL_COLUMNS,
    BALL_PARAMETERS,
    ROBOT_COLUMNS,
    ROBOT_PARAMETERS,
    BallModel,
    Field,
    RobotModel,
)
from rsoccer.arrays import Array, Floats
from rsoccer.frame import BallColumns, RobotColumns

TICK = 0.005  # s
STEP = 0.025  # s

_engine: ContextVar[str] = ContextVar("engine", default=DEFAULT_ENGINE)


@contextmanager
def contact_engine(name: str) -> Iterator[None]:
    """Let the configurations made in the `with` block have this contact engine."""
    token = _engine.set(name)
    try:
        yield
    finally:
        _engine.reset(token)


def make_config(
    field: str | Field,
    n_blue: int,
    n_yellow: int,
    *,
    robot: str | RobotModel | tuple[RobotModel, ...] | None = None,
    ball: str | BallModel | None = None,
    time_step: float = STEP,
    tick: float = TICK,
) -> SimConfig:
    """Return a configuration with the contact engine of `contact_engine`, or the default engine."""
    return SimConfig(
        field,
        n_blue,
        n_yellow,
        robot=robot,
        ball=ball,
        time_step=time_step,
        tick=tick,
        engine=_engine.get(),
    )


class Trajectory:
    """State rows after each control step, with named columns."""

    def __init__(self, rows: Floats, config: SimConfig) -> None:
        """Name the columns of `rows` (steps, worlds, row)."""
        split = len(BALL_COLUMNS)
        shape = (*rows.shape[:2], config.n_robots, len(ROBOT_COLUMNS))
        self.rows = rows
        self.times: Array = np.arange(1, len(rows) + 1) * config.time_step  # s, of each step's end
        self.ball = BallColumns(rows[..., :split])  # (steps, worlds, ...)
        self.robots = RobotColumns(rows[..., split:].reshape(shape))  # (steps, worlds, robots, ...)


class Scene:
    """Start state and commands of `worlds` worlds.

    Initially everything is at rest at the center, and robots face +x.
    """

    def __init__(self, config: SimConfig, worlds: int = 1) -> None:
        """Allocate the start; set `ball`, `robots` and commands before `play`."""
        self.config = config
        self.start = Frame.empty(worlds, config.n_blue, config.n_yellow)
        self.ball, self.robots = self.start.ball, self.start.robots
        width = len(config.command_columns)
        self.commands = np.zeros((worlds, config.n_robots, width), np.float32)
        self.parameters = np.ones((worlds, config.parameters_size), np.float32)

    def face(self, robot: int, degrees: float | Array) -> None:
        """Set a robot's heading (degrees), one for all worlds or one per world."""
        radians = np.radians(degrees)
        self.robots.heading[:, robot, 0] = np.cos(radians)
        self.robots.heading[:, robot, 1] = np.sin(radians)

    def command(self, robot: int, **command: float | Array) -> None:
        """Set a robot's command by column names, one value for all worlds or one per world."""
        for name, value in command.items():
            column = self.config.robots[robot].command_columns.index(name)
            self.commands[:, robot, column] = value

    def vary_ball(self, name: str, factor: float | Array) -> None:
        """Scale a parameter of the ball model, one factor for all worlds or one per world."""
        self.parameters[:, BALL_PARAMETERS.index(name)] = factor

    def vary_robot(self, robot: int, name: str, factor: float | Array) -> None:
        """Scale a parameter of a robot's model, one factor for all worlds or one per world."""
        robots = len(BALL_PARAMETERS) + robot * len(ROBOT_PARAMETERS)
        self.parameters[:, robots + ROBOT_PARAMETERS.index(name)] = factor

    def begin(self) -> "Match":
        """Return matches placed at this start."""
        return Match(self)

    def play(self, seconds: float) -> Trajectory:
        """Simulate some seconds from the start and return the trajectory."""
        return self.begin().run(seconds)


class Match:
    """Running simulation of a scene."""

    def __init__(self, scene: Scene) -> None:
        """Place every world."""
        self.config = scene.config
        self.commands = scene.commands
        self.frame = scene.start.copy()  # current state
        worlds = len(scene.start)
        self.simulator = Simulator(scene.config, worlds)
        every = np.ones(worlds, np.bool_)
        varied = scene.parameters if (scene.parameters != 1.0).any() else None
        self.simulator.place(every, scene.start.rows, self.frame.rows, varied)

    def run(self, seconds: float) -> Trajectory:
        """Simulate some seconds with the current commands."""
        steps = round(seconds / self.config.time_step)
        rows = np.empty((steps, *self.frame.rows.shape), np.float32)
        for row in rows:
            self.simulator.step(self.commands, row)
        self.frame.rows[:] = rows[-1]
        return Trajectory(rows, self.config)


def first_true(mask: Array) -> Array:
    """Return the index of the first True along the first axis; -1 where there is none."""
    positions: Array = np.where(mask.any(axis=0), mask.argmax(axis=0), -1)
    return positions
