"""Simulators of the physics benchmarks: `rsoccer.Simulator`, and all with rSim's interface."""

import time
from collections.abc import Callable
from itertools import count
from types import ModuleType
from typing import Any, Final, Protocol

import numpy as np

from benches.measuring import SPEED, Measure, Quantity, Values
from benches.scenarios import Driver, Positions, Scenario
from rsoccer import Frame, Simulator, WorldRng
from rsoccer.arrays import Floats

CONTACTS: Final = Quantity("robots in contact", "share")
MIN_CONTACT_SHARE: Final = {"random": 0.0, "crowd": 0.1}
"""Share of robots in contact that a kind of play must exceed."""
SAMPLES: Final = 10  # samples of contacts per episode
MIN_SAMPLES: Final = 6000  # sampled robots before a random scenario must show contacts
ROBOSIM_FIELDS: Final = {"vss_3v3": 0, "vss_5v5": 1, "ssl_a": 0, "ssl_b": 1}


class BenchmarkedSimulator(Protocol):
    """Simulator of a scenario in n worlds."""

    def place(self, start: Frame) -> None:
        """Place a start and read the state."""

    def prepare(self, commands: Floats) -> Any:  # noqa: ANN401  (type of argument of `step`)
        """Convert commands (n, robots, command) to the argument of `step`."""

    def step(self, commands: Any) -> None:  # noqa: ANN401
        """Simulate one control step and read the state."""

    def positions(self) -> Positions:
        """Return the positions of the current state."""


class SimulatorAdapter:
    """Adapter of `rsoccer.Simulator`."""

    def __init__(self, scenario: Scenario, worlds: int, threads: int = 1) -> None:
        """Create the worlds."""
        config = scenario.config
        self._simulator = Simulator(config, worlds=worlds, threads=threads)
        self._frame = Frame.empty(worlds, config.n_blue, config.n_yellow)
        self._all = np.ones(worlds, np.bool_)

    def place(self, start: Frame) -> None:
        """Place a start and read the state."""
        self._simulator.place(self._all, start.rows, self._frame.rows)

    def prepare(self, commands: Floats) -> Floats:
        """Return the commands as a contiguous array."""
        return np.ascontiguousarray(commands, np.float32)

    def step(self, commands: Floats) -> None:
        """Simulate one control step and read the state."""
        self._simulator.step(commands, self._frame.rows)

    def positions(self) -> Positions:
        """Return views of the frame."""
        frame = self._frame
        return Positions(frame.ball.position, frame.robots.position, frame.robots.heading)


class RobosimAdapter:
    """Adapter of rSim's interface for one match: `robosim` itself, or `rsoccer.compat.robosim`."""

    def __init__(self, scenario: Scenario, module: ModuleType) -> None:
        """Create the match at an arbitrary start."""
        self._blue, self._has_wheel_commands = scenario.robots, scenario.has_wheel_commands
        self._columns = 6 if scenario.has_wheel_commands else 11
        league = module.VSS if scenario.has_wheel_commands else module.SSL
        placed = self._poses(scenario.start(WorldRng.seeded(0, 1)))
        self._sim = league(
            ROBOSIM_FIELDS[scenario.field], scenario.robots, scenario.robots, 25, *placed
        )
        self._state: list[float] = self._sim.get_state()

    def place(self, start: Frame) -> None:
        """Place a start and read the state."""
        self._sim.reset(*self._poses(start))
        self._state = self._sim.get_state()

    def prepare(self, commands: Floats) -> list[list[float]]:
        """Return lists, the fastest argument type; SSL commands are body velocities."""
        rows = commands[0]
        if not self._has_wheel_commands:
            none = np.zeros_like(rows[:, :1])
            rows = np.concatenate([none, rows[:, :3], none, rows[:, 3:]], axis=1)
        lists: list[list[float]] = rows.tolist()
        return lists

    def step(self, commands: list[list[float]]) -> None:
        """Simulate one control step and read the state."""
        self._sim.step(commands)
        self._state = self._sim.get_state()

    def positions(self) -> Positions:
        """Parse the positions from the state."""
        numbers = np.array(self._state, np.float32)
        robots = numbers[5:].reshape(1, -1, self._columns)
        angles = np.radians(robots[..., 2])
        headings = np.stack([np.cos(angles), np.sin(angles)], axis=-1)
        return Positions(numbers[None, :2], robots[..., :2], headings)

    def _poses(self, start: Frame) -> tuple[list[float], list[list[float]], list[list[float]]]:
        """Return ball, blue and yellow robots as arguments of rSim's `reset`."""
        cos, sin = start.robots.heading[0].T
        robots = np.column_stack([start.robots.position[0], np.degrees(np.arctan2(sin, cos))])
        rows: list[list[float]] = robots.tolist()
        ball: list[float] = [*start.ball.position[0].tolist(), 0.0, 0.0]
        return ball, rows[: self._blue], rows[self._blue :]


def timed_episodes(
    scenario: Scenario,
    create: Callable[[], BenchmarkedSimulator],
    worlds: int = 1,
    starts: int | None = None,
    timed: range | None = None,
) -> Measure:
    """Return a measure of speed and contacts over episodes of a scenario.

    All simulators of a scenario get the same starts in a round. A simulator with fewer worlds than
    starts simulates them one after the other, and repeats them if time is left. Only steps are
    timed, neither placing nor the computation of commands.

    Args:
        scenario: Scenario to simulate.
        create: Creates the simulator.
        worlds: Number of worlds of the simulator.
        starts: Number of starts per round; default: one per world.
        timed: Steps of an episode to time; default: all.

    Returns:
        Measure of SPEED and CONTACTS.
    """
    timed, rounds = timed or range(scenario.episode), count()
    simulator, driver = create(), Driver(scenario, worlds)
    batches = range(0, starts or worlds, worlds)
    contact_shares: list[float] = []  # of all rounds

    def measure(seconds: float) -> Values:
        if not seconds:
            return {}
        seed = 1000 * next(rounds)
        took: list[float] = []
        while sum(took) < seconds:
            first = batches[len(took) % len(batches)]
            simulator.place(scenario.start(WorldRng.seeded(seed + first, worlds)))
            spent, shares = run_episode(scenario, simulator, driver, timed)
            contact_shares.extend(shares if len(took) < len(batches) else ())
            took.append(spent)
        speed = {SPEED: worlds * len(timed) * len(took) / sum(took)}
        share = float(np.mean(contact_shares))
        check_contacts(scenario, share, len(contact_shares) * worlds * scenario.config.n_robots)
        return {**speed, CONTACTS: share}

    return measure


def run_episode(
    scenario: Scenario, simulator: BenchmarkedSimulator, driver: Driver, timed: range
) -> tuple[float, list[float]]:
    """Simulate an episode up to the last timed step.

    Args:
        scenario: Scenario to simulate.
        simulator: Simulator with a placed start.
        driver: Source of commands.
        timed: Steps to time; earlier steps are simulated without timing.

    Returns:
        Duration of the timed steps (s), and the share of robots in contact at a few of them.
    """
    spent, contact_shares, interval = 0.0, [], max(len(timed) // SAMPLES, 1)
    for first in range(0, timed.stop, driver.held):
        commands = simulator.prepare(driver.commands(first, simulator.positions()))
        held = min(driver.held, timed.stop - first)
        start = time.perf_counter()
        for _ in range(held):
            simulator.step(commands)
        took = time.perf_counter() - start
        if first < timed.start:
            continue
        spent += took
        if (first + held) % interval == 0:
            contact_shares.append(scenario.contact_share(simulator.positions()))
    return spent, contact_shares


def check_contacts(scenario: Scenario, share: float, samples: int) -> None:
    """Check that a scenario had the contacts of its kind.

    Raises:
        RuntimeError: The share of robots in contact is too small.
    """
    enough = samples >= MIN_SAMPLES or scenario.play == "crowd"
    limit = MIN_CONTACT_SHARE[scenario.play]
    if enough and share <= limit:
        expected = f"expected more than {limit:.1%} of the robots in contact"
        raise RuntimeError(f"{scenario.name}: {expected}, got {share:.1%}")
