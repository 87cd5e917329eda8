"""Scenarios for the physics benchmarks: fields, teams, starts and commands for every simulator.

In a random scenario new commands are drawn every ten steps. In a crowd every robot drives at the
ball, by the positions read from the simulator. At the end of an episode everything is placed again,
anywhere on the field.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from rsoccer import Frame, SimConfig, WorldRng, spawn
from rsoccer.arrays import Floats

DEFAULT_ENGINE: Final = SimConfig().engine
ENGINES: Final = (DEFAULT_ENGINE, *({"compact", "rapier"} - {DEFAULT_ENGINE}))
"""The contact engines, the default first."""

EPISODE: Final = 400  # steps of a random scenario between two placements
HELD: Final = 10  # steps for which a random command is held

# Maximum commands for SSL robots in the environments of the rSoccer paper.
SPEED: Final = np.float32(2.5)  # m/s
TURNING: Final = np.float32(10.0)  # rad/s
KICK: Final = np.float32(5.0)  # m/s

NEAR: Final = np.float32(0.015)  # m, largest gap that counts as contact


class Positions(NamedTuple):
    """Positions in n worlds, from which a crowd's commands are computed."""

    ball: Floats  # (n, 2), m
    robots: Floats  # (n, robots, 2), m
    headings: Floats  # (n, robots, 2), cosine and sine


@dataclass(frozen=True)
class Scenario:
    """League, team size and kind of play."""

    teams: str
    """League and team size as shown in tables, such as "VSSS 3 v 3"."""
    field: str
    robots: int
    """Robots per team."""
    play: str
    """Kind of play: "random" or "crowd"."""
    episode: int = EPISODE
    """Steps between two placements."""
    engine: str = DEFAULT_ENGINE
    """Contact engine."""

    @property
    def name(self) -> str:
        """Name as shown in tables."""
        return f"{self.teams} {self.play}"

    @cached_property
    def config(self) -> SimConfig:
        """Simulator configuration: steps of 25 ms, ticks of 5 ms, the league's robots and ball."""
        return SimConfig(self.field, self.robots, self.robots, engine=self.engine)

    @property
    def has_wheel_commands(self) -> bool:
        """True if commands are two wheel speeds, False if they are body velocities."""
        return len(self.config.command_columns) == 2

    @property
    def radius(self) -> np.float32:
        """Distance from a robot's center to its nearest side, m."""
        robot = self.config.robot
        return np.float32(robot.side_length / 2 if self.has_wheel_commands else robot.radius)

    def start(self, rng: WorldRng) -> Frame:
        """Return n random starts at rest and without contacts."""
        return spawn.random_frame(rng, self.config, 0.0)

    def contact_share(self, positions: Positions) -> float:
        """Return the share of robots in contact with the ball or another robot."""
        to_ball = _distance(positions.robots - positions.ball[:, None])
        to_robots = _distance(positions.robots[:, :, None] - positions.robots[:, None])
        to_robots[:, np.eye(self.config.n_robots, dtype=np.bool_)] = np.inf
        at_ball = to_ball < self.radius + np.float32(self.config.ball.radius) + NEAR
        at_robot = (to_robots < 2 * self.radius + NEAR).any(axis=2)
        return float((at_ball | at_robot).mean())


class Driver:
    """Commands for the robots of n worlds."""

    def __init__(self, scenario: Scenario, worlds: int) -> None:
        """Keep scenario and size; commands are drawn later to save memory."""
        self._scenario, self._worlds = scenario, worlds
        self.held = HELD if scenario.play == "random" else 1

    def commands(self, step: int, positions: Positions) -> Floats:
        """Return the commands at a step of an episode, shape (n, robots, command)."""
        if self._scenario.play == "random":
            return self._random_commands(np.random.default_rng(step // HELD))
        offset = positions.ball[:, None] - positions.robots
        cos, sin = positions.headings[..., 0], positions.headings[..., 1]
        ahead = offset[..., 0] * cos + offset[..., 1] * sin
        left = offset[..., 1] * cos - offset[..., 0] * sin
        return self._drive_toward(ahead, left)

    def _random_commands(self, rng: np.random.Generator) -> Floats:
        config = self._scenario.config
        shape = (self._worlds, config.n_robots)
        if self._scenario.has_wheel_commands:
            return _random_wheels(rng, shape, config.robot.max_wheel_speed)
        return _random_bodies(rng, shape)

    def _drive_toward(self, ahead: Floats, left: Floats) -> Floats:
        """Return commands that drive to a point ahead and to the left (m) while facing it."""
        bearing = np.arctan2(left, ahead)
        if self._scenario.has_wheel_commands:
            turn = np.float32(0.3) * bearing
            wheels = np.stack([1 - turn, 1 + turn], axis=-1)
            return wheels * np.float32(self._scenario.config.robot.max_wheel_speed)
        scale = SPEED / np.maximum(np.hypot(ahead, left), np.float32(1e-3))
        commands = np.zeros((*ahead.shape, len(self._scenario.config.command_columns)), np.float32)
        commands[..., 0], commands[..., 1] = ahead * scale, left * scale
        commands[..., 2] = np.clip(5 * bearing, -TURNING, TURNING)
        return commands


# A crowd is placed again earlier: once it is dense, a single step of eleven a side takes rSim half
# a second. The last column is the number of steps that rSim simulates in acceptable time.
_TEAMS: Final = (
    ("VSSS 3 v 3", "vss_3v3", 3, 200),
    ("VSSS 5 v 5", "vss_5v5", 5, 100),
    ("SSL 1 v 1", "ssl_b", 1, EPISODE),
    ("SSL 6 v 6", "ssl_b", 6, 150),
    ("SSL 11 v 11", "ssl_a", 11, 100),
)
RANDOM: Final = tuple(Scenario(*row[:3], "random") for row in _TEAMS)
CROWD: Final = tuple(Scenario(*row[:3], "crowd", row[3]) for row in _TEAMS)
SCENARIOS: Final = RANDOM + CROWD


def _random_wheels(rng: np.random.Generator, shape: tuple[int, ...], limit: float) -> Floats:
    """Draw two wheel speeds per robot, shape (*shape, 2), rad/s."""
    return rng.uniform(-limit, limit, (*shape, 2)).astype(np.float32)


def _random_bodies(rng: np.random.Generator, shape: tuple[int, ...]) -> Floats:
    """Draw SSL commands, shape (*shape, 6); half of the robots kick, a quarter chip."""
    drawn = rng.uniform(-1.0, 1.0, (*shape, 6)).astype(np.float32)
    drawn[..., 3:] = np.maximum(drawn[..., 3:], 0.0)
    drawn[..., 4] *= drawn[..., 3] > 0.0
    return drawn * np.array([SPEED, SPEED, TURNING, KICK, KICK / 2, 1.0], np.float32)


def _distance(offset: Floats) -> Floats:
    distance: Floats = np.sqrt(np.square(offset).sum(axis=-1))
    return distance
