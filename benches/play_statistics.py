"""Statistics of play under a contact engine: contacts, ball speed, possession and goals."""

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np

import rsoccer
from benches.measuring import Quantity
from benches.scenarios import Driver, Positions, Scenario
from rsoccer import Frame, Matches, SimConfig, Simulator, WorldRng
from rsoccer.arrays import Doubles, Floats
from rsoccer.vectors import norm

BALL_SPEED: Final = Quantity("mean ball speed", "m/s")
FAST_BALL: Final = Quantity("90th percentile of the ball speed", "m/s")
TOUCHING: Final = Quantity("robots in contact with the ball", "per step")
MEETING: Final = Quantity("robots in contact with an opponent", "per step")
POSSESSION: Final = Quantity("changes of possession", "per minute")
GOALS: Final = Quantity("goals", "per hour")

OU_TASK: Final = "VSSSelfPlay-v0"

Statistics = dict[Quantity, Doubles]
"""Value of each quantity in each world, shape (worlds,)."""


def play_scenario(
    scenario: Scenario, engine: str, tick: float, worlds: int, seed: int
) -> Statistics:
    """Play one episode of a scenario in every world.

    Args:
        scenario: Field, teams and kind of play.
        engine: Contact engine.
        tick: Length of a physics tick, s.
        worlds: Number of worlds.
        seed: Seed of the first world's start; the next world has the next seed.

    Returns:
        Statistics of each world.
    """
    config = SimConfig(scenario.field, scenario.robots, scenario.robots, engine=engine, tick=tick)
    frame, driver = scenario.start(WorldRng.seeded(seed, worlds)), Driver(scenario, worlds)
    simulator = Simulator(config, worlds)
    simulator.place(np.ones(worlds, np.bool_), frame.rows.copy(), frame.rows)

    def frames() -> Iterator[Frame]:
        for step in range(scenario.episode):
            ball, robots = frame.ball, frame.robots
            at = Positions(ball.position, robots.position, robots.heading)
            simulator.step(np.ascontiguousarray(driver.commands(step, at)), frame.rows)
            yield frame

    return _statistics(frames(), scenario.robots, scenario.episode * config.time_step)


def play_ou(engine: str, seconds: float, worlds: int, seed: int) -> Statistics:
    """Play matches of three VSSS robots a side, all with the policy `ou`.

    Args:
        engine: Contact engine.
        seconds: Duration in each world, s.
        worlds: Number of worlds.
        seed: Seed of the first world; the next world has the next seed.

    Returns:
        Statistics of each world, with goals.
    """
    task = rsoccer.make_task(OU_TASK, engine=engine)
    matches = Matches(task, worlds, seed, controllers={"all": "ou"})
    matches.reset()
    actions = np.zeros((worlds, len(matches.agents), matches.action_size), np.float32)
    goals = np.zeros(worlds)

    def frames() -> Iterator[Frame]:
        for _ in range(round(seconds / task.config.time_step)):
            goals[:] += matches.step(actions).terminated
            yield matches.frame

    found = _statistics(frames(), task.config.n_blue, seconds)
    return {**found, GOALS: goals * (3600.0 / seconds)}


def _statistics(frames: Iterator[Frame], n_blue: int, seconds: float) -> Statistics:
    """Statistics of the frames after each step of `seconds` (s) of play."""
    speeds: list[Floats] = []
    touching: list[Floats] = []
    meeting: list[Floats] = []
    touched: list[Floats] = []
    for frame in frames:
        speeds.append(norm(frame.ball.velocity[:, 0], frame.ball.velocity[:, 1]))
        touching.append((frame.robots.touched_ball > 0).sum(axis=1))
        meeting.append((frame.robots.touched_opponent > 0).sum(axis=1))
        touched.append(frame.ball.last_touch.copy())
    speed = np.stack(speeds)
    return {
        BALL_SPEED: speed.mean(axis=0, dtype=np.float64),
        FAST_BALL: np.percentile(speed, 90, axis=0).astype(np.float64),
        TOUCHING: np.stack(touching).mean(axis=0),
        MEETING: np.stack(meeting).mean(axis=0),
        POSSESSION: _changes_of_team(np.stack(touched), n_blue) * (60.0 / seconds),
    }


def _changes_of_team(touched: Floats, n_blue: int) -> Doubles:
    """Number of times that the team of the last touch (steps, worlds) changes in each world."""
    teams = np.where(touched < 0, np.nan, touched >= n_blue)
    before, after = teams[:-1], teams[1:]
    changes: Doubles = (np.isfinite(before) & np.isfinite(after) & (before != after)).sum(
        axis=0, dtype=np.float64
    )
    return changes


def in_batches(
    play: Callable[[int, int], Statistics], worlds: int, batch: int, seed: int
) -> Statistics:
    """Return the statistics of `worlds` worlds, played `batch` at a time.

    Args:
        play: Plays a number of worlds from a seed.
        worlds: Number of worlds.
        batch: Number of worlds at a time.
        seed: Seed of the first world.

    Returns:
        Statistics of each world.
    """
    parts = [play(min(batch, worlds - start), seed + start) for start in range(0, worlds, batch)]
    return {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
