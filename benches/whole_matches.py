"""Speed of whole matches under a referee: `python -m benches.whole_matches`.

Two tables: the share of the referee in a step, and how many times faster than real time matches of
ten minutes are played, until each world has played one to its end. All times are of the processor,
on one thread, so that other programs on the machine count less; a share is that of one run.
`--store` renews the tables in `benches/results/whole_matches.md`, which `make docs` puts into
`docs/speed.md`.
"""

import argparse
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final
from unittest import mock

import numpy as np

import rsoccer
from benches.interfaces import held_actions, random_actions
from benches.markdown import table
from benches.result_files import RESULTS, format_number
from rsoccer import SimConfig, Simulator
from rsoccer._core import Threads
from rsoccer.controllers import Controllers
from rsoccer.play import Play
from rsoccer.rules import Restart
from rsoccer.rules.referee import RefereeRule
from rsoccer.task import Learn
from rsoccer.train.clock import Clock, TimedSimulator

STORED: Final = RESULTS / "whole_matches.md"
SIDES: Final[dict[str, str | Learn]] = {"random": rsoccer.LEARN, "scripted": "scripted"}
"""Policies of all robots by the names of the tables; random actions are those of learners."""
WARM_UP: Final = 200
"""Steps before a measurement, so that matches are in progress."""
HALF_SECONDS: Final = 300.0
QUICK_HALF_SECONDS: Final = 3.0


@dataclass(frozen=True)
class Teams:
    """League and size of both teams."""

    name: str
    task: str
    options: dict[str, Any] = field(default_factory=dict)


VSSS: Final = Teams("VSSS 3 v 3", "VSSMatch-v0")
SSL: Final = Teams("SSL 6 v 6", "SSLMatch-v0")
SSL_A: Final = Teams("SSL 11 v 11", "SSLMatch-v0", {"division": "A", "n_blue": 11, "n_yellow": 11})


@dataclass
class JudgeClock:
    """Processor time that the referee takes, s."""

    seconds: float = 0.0

    def timed(self) -> Callable[[RefereeRule, Play], Restart | None]:
        """Return `RefereeRule.judge` with the clock around it."""
        judge = RefereeRule.judge

        def timed_judge(rule: RefereeRule, play: Play) -> Restart | None:
            start = time.process_time()
            restart = judge(rule, play)
            self.seconds += time.process_time() - start
            return restart

        return timed_judge


def begin(
    teams: Teams, sides: str, worlds: int, half_seconds: float, clock: Clock
) -> tuple[rsoccer.Matches, Callable[[], None]]:
    """Return matches that have begun, and a function that steps them.

    Args:
        teams: League and size of the teams.
        sides: Name in `SIDES`.
        worlds: Number of matches at once. Where one ends, another begins.
        half_seconds: Playing time of a half, s.
        clock: Gets the time of the physics.
    """

    def simulator(config: SimConfig, worlds: int, threads: Threads) -> TimedSimulator:
        return TimedSimulator(Simulator(config, worlds, threads), clock)

    task = rsoccer.make_task(teams.task, half_seconds=half_seconds, **teams.options)
    controllers: Controllers = {"all": SIDES[sides]}
    matches = rsoccer.Matches(task, worlds, 0, 1, controllers=controllers, simulator=simulator)
    matches.reset()
    actions = random_actions((worlds, len(matches.agents), task.action_size))
    return matches, held_actions(actions, matches.step)


def referee_share(teams: Teams, sides: str, worlds: int, seconds: float) -> tuple[float, float]:
    """Return the referee's share of a step, and its time per world and step, s.

    Args:
        teams: League and size of the teams.
        sides: Name in `SIDES`.
        worlds: Number of worlds.
        seconds: Processor time of the measurement, s.
    """
    _, step = begin(teams, sides, worlds, HALF_SECONDS, Clock())
    for _ in range(WARM_UP if seconds > 0.0 else 1):
        step()
    clock, steps, spent = JudgeClock(), 0, 0.0
    with mock.patch.object(RefereeRule, "judge", clock.timed()):
        start = time.process_time()
        while not steps or spent < seconds:
            step()
            steps += 1
            spent = time.process_time() - start
    return clock.seconds / spent, clock.seconds / (steps * worlds)


def times_real_time(
    teams: Teams, sides: str, worlds: int, half_seconds: float
) -> tuple[float, float]:
    """Return the time of play of all worlds per processor time, and the same of the physics alone.

    Args:
        teams: League and size of the teams.
        sides: Name in `SIDES`.
        worlds: Number of matches at once.
        half_seconds: Playing time of a half, s.
    """
    clock = Clock()
    matches, step = begin(teams, sides, worlds, half_seconds, clock)
    ended, steps = np.zeros(worlds, np.bool_), 0
    clock.take()
    start = time.process_time()
    while not ended.all():
        step()
        steps += 1
        ended |= matches.play.steps == 0  # another match has begun
    played = steps * worlds * matches.task.config.time_step
    times = played / (time.process_time() - start)
    return times, times / clock.take()[1]["physics"]


def share_row(teams: Teams, sides: str, batch: int, seconds: float) -> tuple[str, ...]:
    """Return the cells of the referee's share in a batch, and of its time in one world."""
    share, in_batch = referee_share(teams, sides, batch, seconds)
    _, alone = referee_share(teams, sides, 1, seconds)
    times = (format_number(1e6 * value, 2) for value in (in_batch, alone))
    return teams.name, sides, f"{share:.1%}", *times


def tables(batch: int, seconds: float, half_seconds: float) -> str:
    """Measure, and return both tables.

    Args:
        batch: Worlds of a batch.
        seconds: Processor time of each measurement of the referee's share, s.
        half_seconds: Playing time of a half of the matches that are played to their end, s.
    """
    rows = [
        share_row(teams, sides, batch, seconds) for teams in (VSSS, SSL, SSL_A) for sides in SIDES
    ]
    per_world = f"us per world-step, {batch} worlds"
    header = ("referee", "sides", f"share, {batch} worlds", per_world, "us per step, 1 world")
    played = [
        (
            teams.name,
            sides,
            *map(format_number, times_real_time(teams, sides, batch, half_seconds)),
        )
        for teams in (VSSS, SSL)
        for sides in SIDES
    ]
    minutes = format_number(2.0 * half_seconds / 60.0, 2)
    matches = (
        f"matches of {minutes} minutes, {batch} at once",
        "sides",
        "times real time",
        "physics alone",
    )
    return f"{table(header, rows)}\n\n{table(matches, played)}\n"


def main(arguments: list[str] | None = None) -> None:
    """Measure, print and on demand store the tables.

    Args:
        arguments: Command line without the program name; default: that of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="a few steps of short matches")
    parser.add_argument("--store", action="store_true", help=f"write {STORED.name}")
    options = parser.parse_args(arguments)
    text = tables(4, 0.0, QUICK_HALF_SECONDS) if options.quick else tables(64, 2.0, HALF_SECONDS)
    sys.stdout.write(text)
    if options.store:
        STORED.write_text(text)


if __name__ == "__main__":
    main()
