"""The simulators that play the games: ours, and whatever has the old one's interface."""

import time
from collections.abc import Callable
from itertools import count
from types import ModuleType
from typing import Any, Final, Protocol

import numpy as np

from benches.games import Driver, Game, Seen
from benches.measuring import SPEED, Measure, Quantity, Values
from rsoccer import Frame, Simulator, WorldRng
from rsoccer.frame import Floats

TOUCHING: Final = Quantity("robots touching", "share")
LEAST_TOUCHING: Final = {"random": 0.0, "crowd": 0.1}
"""Share of robots at the ball or at another one that makes the scene what it is called: more than
this."""
SAMPLES: Final = 10  # looks at an episode, to see whether robots touch
ENOUGH: Final = 6000  # looks at single robots; one match of random play may see no contact for long
OLD_FIELDS: Final = {"vss_3v3": 0, "vss_5v5": 1, "ssl_a": 0, "ssl_b": 1}


class Player(Protocol):
    """Plays a game in n worlds at once."""

    def place(self, start: Frame) -> None:
        """Begin anew."""

    def prepared(self, commands: Floats) -> Any:  # noqa: ANN401  (whatever its `step` takes)
        """Commands (n, robots, command) in the form that it steps with."""

    def step(self, commands: Any) -> None:  # noqa: ANN401
        """One control step; the state has been read when it returns."""

    def seen(self) -> Seen:
        """Where everything is."""


class Ours:
    """`rsoccer.Simulator`."""

    def __init__(self, game: Game, worlds: int, threads: int = 1) -> None:
        """Build the worlds."""
        config = game.config
        self._simulator = Simulator(config, worlds=worlds, threads=threads)
        self._frame = Frame.empty(worlds, config.n_blue, config.n_yellow)
        self._all = np.ones(worlds, np.bool_)

    def place(self, start: Frame) -> None:
        """Begin anew."""
        self._simulator.place(self._all, start.rows, self._frame.rows)

    def prepared(self, commands: Floats) -> Floats:
        """As they are."""
        return np.ascontiguousarray(commands, np.float32)

    def step(self, commands: Floats) -> None:
        """One control step; the state is in the frame."""
        self._simulator.step(commands, self._frame.rows)

    def seen(self) -> Seen:
        """Views of the frame."""
        frame = self._frame
        return Seen(frame.ball.position, frame.robots.position, frame.robots.heading)


class Old:
    """One match by the old simulator's interface: `robosim` itself, or our `compat.robosim`."""

    def __init__(self, game: Game, module: ModuleType) -> None:
        """Build the match, and one like any start."""
        self._blue, self._on_wheels = game.robots, game.on_wheels
        self._columns = 6 if game.on_wheels else 11
        league = module.VSS if game.on_wheels else module.SSL
        placed = self._poses(game.start(WorldRng.seeded(0, 1)))
        self._sim = league(OLD_FIELDS[game.field], game.robots, game.robots, 25, *placed)
        self._state: list[float] = self._sim.get_state()

    def place(self, start: Frame) -> None:
        """Begin anew."""
        self._sim.reset(*self._poses(start))
        self._state = self._sim.get_state()

    def prepared(self, commands: Floats) -> list[list[float]]:
        """Lists, which it takes fastest; an SSL robot's are by body velocity."""
        told = commands[0]
        if not self._on_wheels:
            none = np.zeros_like(told[:, :1])
            told = np.concatenate([none, told[:, :3], none, told[:, 3:]], axis=1)
        rows: list[list[float]] = told.tolist()
        return rows

    def step(self, commands: list[list[float]]) -> None:
        """One control step, and the state that comes of it."""
        self._sim.step(commands)
        self._state = self._sim.get_state()

    def seen(self) -> Seen:
        """Parsed from the state."""
        numbers = np.array(self._state, np.float32)
        robots = numbers[5:].reshape(1, -1, self._columns)
        angles = np.radians(robots[..., 2])
        headings = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return Seen(numbers[None, :2], robots[..., :2], headings)

    def _poses(self, start: Frame) -> tuple[list[float], list[list[float]], list[list[float]]]:
        """Ball, blue and yellow robots as it wants to be told."""
        cos, sin = start.robots.heading[0].T
        robots = np.column_stack([start.robots.position[0], np.degrees(np.arctan2(sin, cos))])
        rows: list[list[float]] = robots.tolist()
        ball: list[float] = [*start.ball.position[0].tolist(), 0.0, 0.0]
        return ball, rows[: self._blue], rows[self._blue :]


def bout(
    game: Game,
    player: Callable[[], Player],
    worlds: int = 1,
    starts: int | None = None,
    timed: range | None = None,
) -> Measure:
    """Whole episodes of a game, or these steps of it.

    A round has so many starts (one a world, if not told), the same for all who play it. Who plays
    fewer matches at once plays them one after the other, and who has time left begins again. Steps
    alone are timed, neither placing nor deciding.
    """
    timed, rounds = timed or range(game.episode), count()
    playing, driver = player(), Driver(game, worlds)
    turns = range(0, starts or worlds, worlds)
    touching: list[float] = []  # in all rounds

    def measure(seconds: float) -> Values:
        if not seconds:
            return {}
        seed = 1000 * next(rounds)
        took: list[float] = []
        while sum(took) < seconds:
            first = turns[len(took) % len(turns)]
            playing.place(game.start(WorldRng.seeded(seed + first, worlds)))
            spent, shares = play(game, playing, driver, timed)
            touching.extend(shares if len(took) < len(turns) else ())
            took.append(spent)
        speed = {SPEED: worlds * len(timed) * len(took) / sum(took)}
        share = float(np.mean(touching))
        expect_contacts(game, share, len(touching) * worlds * game.config.n_robots)
        return {**speed, TOUCHING: share}

    return measure


def play(game: Game, player: Player, driver: Driver, timed: range) -> tuple[float, list[float]]:
    """Seconds that these steps took, and shares of robots that touched, at a few moments of them.

    The steps before are played and not timed.
    """
    spent, touching, looks = 0.0, [], max(len(timed) // SAMPLES, 1)
    for first in range(0, timed.stop, driver.held):
        commands = player.prepared(driver.commands(first, player.seen()))
        held = min(driver.held, timed.stop - first)
        start = time.perf_counter()
        for _ in range(held):
            player.step(commands)
        took = time.perf_counter() - start
        if first < timed.start:
            continue
        spent += took
        if (first + held) % looks == 0:
            touching.append(game.touching(player.seen()))
    return spent, touching


def expect_contacts(game: Game, touching: float, looked_at: int) -> None:
    """Refuse figures of a scene in which nothing happened."""
    enough = looked_at >= ENOUGH or game.scene == "crowd"
    if enough and touching <= LEAST_TOUCHING[game.scene]:
        raise RuntimeError(f"{game.name}: only {touching:.1%} of the robots touched anything")
