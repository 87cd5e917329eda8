"""Games that both simulators play: who stands where, and what all are told.

In random play commands are drawn anew every ten steps; in a crowd everybody drives at the ball, as
read from the simulator's own state. Now and then all are placed anew, anywhere on the field.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Final, NamedTuple

import numpy as np

from rsoccer import Frame, SimConfig, WorldRng, spawn
from rsoccer.frame import Floats

EPISODE: Final = 400  # steps of random play between two placements
HELD: Final = 10  # steps that a random command is kept

# What the environments of the rSoccer paper ask of SSL robots at most.
SPEED: Final = np.float32(2.5)  # m/s
TURNING: Final = np.float32(10.0)  # rad/s
KICK: Final = np.float32(5.0)  # m/s

NEAR: Final = np.float32(0.015)  # metres between bodies that count as touching


class Seen(NamedTuple):
    """What the commands of a crowd follow from."""

    ball: Floats  # (n, 2) metres
    robots: Floats  # (n, robots, 2) metres
    headings: Floats  # (n, robots, 2) cosine and sine


@dataclass(frozen=True)
class Game:
    """A league, its team sizes, and what goes on."""

    teams: str
    field: str
    robots: int
    """Robots a side."""
    scene: str
    episode: int = EPISODE
    """Steps between two placements."""

    @property
    def name(self) -> str:
        """As in tables."""
        return f"{self.teams} {self.scene}"

    @cached_property
    def config(self) -> SimConfig:
        """Steps of 25 ms in ticks of 5 ms, with the league's robots and ball."""
        return SimConfig(self.field, self.robots, self.robots)

    @property
    def on_wheels(self) -> bool:
        """Whether commands are speeds of two wheels, and not velocities of the body."""
        return len(self.config.command_columns) == 2

    @property
    def radius(self) -> np.float32:
        """From a robot's centre to its nearest side, metres."""
        robot = self.config.robot
        return np.float32(robot.side / 2 if self.on_wheels else robot.radius)

    def start(self, rng: WorldRng) -> Frame:
        """Everything somewhere, at rest, nothing touching; (n)."""
        return spawn.random_frame(rng, self.config, 0.0)

    def touching(self, seen: Seen) -> float:
        """Share of the robots that are at another one or at the ball."""
        to_ball = _distance(seen.robots - seen.ball[:, None])
        to_robots = _distance(seen.robots[:, :, None] - seen.robots[:, None])
        to_robots[:, np.eye(self.config.n_robots, dtype=np.bool_)] = np.inf
        at_ball = to_ball < self.radius + np.float32(self.config.ball.radius) + NEAR
        at_robot = (to_robots < 2 * self.radius + NEAR).any(axis=2)
        return float((at_ball | at_robot).mean())


class Driver:
    """Decides what the robots of n worlds are told."""

    def __init__(self, game: Game, worlds: int) -> None:
        """Nothing is drawn yet: of many worlds, all that is to come takes much memory."""
        self._game, self._worlds = game, worlds
        self.held = HELD if game.scene == "random" else 1

    def commands(self, step: int, seen: Seen) -> Floats:
        """(n, robots, command) at some step of an episode."""
        if self._game.scene == "random":
            return self._drawn(np.random.default_rng(step // HELD))
        offset = seen.ball[:, None] - seen.robots
        cos, sin = seen.headings[..., 0], seen.headings[..., 1]
        ahead = offset[..., 0] * cos + offset[..., 1] * sin
        left = offset[..., 1] * cos - offset[..., 0] * sin
        return self._towards(ahead, left)

    def _drawn(self, chance: np.random.Generator) -> Floats:
        config = self._game.config
        shape = (self._worlds, config.n_robots)
        if self._game.on_wheels:
            return _random_wheels(chance, shape, config.robot.max_wheel_speed)
        return _random_bodies(chance, shape)

    def _towards(self, ahead: Floats, left: Floats) -> Floats:
        """Commands that drive at what lies so many metres ahead and to the left, facing it."""
        bearing = np.arctan2(left, ahead)
        if self._game.on_wheels:
            turn = np.float32(0.3) * bearing
            powers = np.stack([1 - turn, 1 + turn], axis=-1)
            return powers * np.float32(self._game.config.robot.max_wheel_speed)
        pace = SPEED / np.maximum(np.hypot(ahead, left), np.float32(1e-3))
        told = np.zeros((*ahead.shape, len(self._game.config.command_columns)), np.float32)
        told[..., 0], told[..., 1] = ahead * pace, left * pace
        told[..., 2] = np.clip(5 * bearing, -TURNING, TURNING)
        return told


# A crowd is placed anew earlier: deep in one, a single step of eleven a side takes the old
# simulator half a second. The numbers are as many steps as it can be waited for.
_TEAMS: Final = (
    ("VSSS 3 v 3", "vss_3v3", 3, 200),
    ("VSSS 5 v 5", "vss_5v5", 5, 100),
    ("SSL 1 v 1", "ssl_b", 1, EPISODE),
    ("SSL 6 v 6", "ssl_b", 6, 150),
    ("SSL 11 v 11", "ssl_a", 11, 100),
)
RANDOM: Final = tuple(Game(*told[:3], "random") for told in _TEAMS)
CROWD: Final = tuple(Game(*told[:3], "crowd", told[3]) for told in _TEAMS)
GAMES: Final = RANDOM + CROWD


def _random_wheels(chance: np.random.Generator, shape: tuple[int, ...], most: float) -> Floats:
    """Speeds of two wheels (..., 2)."""
    return chance.uniform(-most, most, (*shape, 2)).astype(np.float32)


def _random_bodies(chance: np.random.Generator, shape: tuple[int, ...]) -> Floats:
    """Velocities, kicks and dribblers (..., 6); half of the robots kick, a quarter chip."""
    drawn = chance.uniform(-1.0, 1.0, (*shape, 6)).astype(np.float32)
    drawn[..., 3:] = np.maximum(drawn[..., 3:], 0.0)
    drawn[..., 4] *= drawn[..., 3] > 0.0
    return drawn * np.array([SPEED, SPEED, TURNING, KICK, KICK / 2, 1.0], np.float32)


def _distance(offset: Floats) -> Floats:
    distance: Floats = np.sqrt(np.square(offset).sum(axis=-1))
    return distance
