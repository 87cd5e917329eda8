"""Cost of senses in a step of `Matches`: `python -m benches.senses`.

The same task plays without senses, with the preset of its league, and with every number of
`Sensing` in use, in turns of some milliseconds of processor time. Learners act at random. A ratio
is taken of neighboring turns, so that other load of the machine affects all alike.
"""

import argparse
import statistics
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

import rsoccer
from benches.markdown import table
from rsoccer import Sensing

EVERYTHING: Final = {
    **{"delay_jitter": 0.003, "frame_loss": 0.05, "misread_headings": 0.01, "missing_robots": 0.02},
    **{"camera_offset_error": 0.01, "feedback_delay": 0.01, "feedback_loss": 0.05},
    **{"beam_misses": 0.05, "beam_false_alarms": 0.02},
    **{"odometry": 1.0, "odometry_noise": 0.02, "gyroscope_noise": 0.02, "gyroscope_error": 0.02},
    **{"command_delay": 0.012, "command_jitter": 0.004, "command_loss": 0.03},
    **{"wheel_error": 0.02, "wheel_dead_zone": 0.02, "battery_sag": 0.0001},
    **{"kick_speed_noise": 0.05, "kick_direction_noise": 0.02, "kick_failures": 0.05},
    **{"dribbler_failures": 0.05},
}
"""Numbers that the presets leave at 0, or that go further than theirs."""


@dataclass(frozen=True)
class Case:
    """A task, and the preset of its league."""

    title: str
    task: str
    options: dict[str, Any]
    preset: str


CASES: Final = (
    Case("VSSS 3 v 3", "VSSMatch-v0", {}, "vsss"),
    Case("SSL 6 v 6", "SSLMatch-v0", {"n_blue": 6, "n_yellow": 6}, "rc2021"),
    Case("SSL 11 v 11", "SSLMatch-v0", {"n_blue": 11, "n_yellow": 11, "division": "A"}, "rc2021"),
)


@dataclass(frozen=True)
class Cost:
    """Time of a step of one world without senses, and what senses add, by the time without them."""

    case: Case
    microseconds: float
    preset: float
    everything: float


def measure(case: Case, worlds: int, seeds: int, rounds: int, steps: int) -> Cost:
    """Measure the cost of senses in a task.

    Args:
        case: the task.
        worlds: number of matches at once.
        seeds: number of seeds: robots that obey differently collide at other times, and some
            matches cost more than others.
        rounds: number of turns of each variant with a seed.
        steps: control steps in a turn.
    """
    variants = (None, Sensing(case.preset), Sensing(case.preset, **EVERYTHING))
    turns = []
    for seed in range(seeds):
        players = [_Player(case, worlds, seed, sensing) for sensing in variants]
        for player in players:
            player.play(steps)
        turns += [[player.play(steps) for player in players] for _ in range(rounds)]
    without = statistics.median(turn[0] for turn in turns) / worlds / steps
    added = [statistics.median(turn[nth] / turn[0] - 1.0 for turn in turns) for nth in (1, 2)]
    return Cost(case, without * 1e6, *added)


class _Player:
    """Matches with learners that act at random."""

    def __init__(self, case: Case, worlds: int, seed: int, sensing: Sensing | None) -> None:
        self._matches = rsoccer.Matches(case.task, worlds, seed, sensing=sensing, **case.options)
        self._matches.reset()
        shape = (16, worlds, len(self._matches.agents), self._matches.action_size)
        self._actions = np.random.default_rng(seed).uniform(-1.0, 1.0, shape).astype(np.float32)

    def play(self, steps: int) -> float:
        """Processor time of some steps, s."""
        start = time.thread_time()
        for step in range(steps):
            self._matches.step(self._actions[step % len(self._actions)])
        return time.thread_time() - start


def report(costs: Sequence[Cost]) -> str:
    """Return costs as a Markdown table.

    Args:
        costs: what `measure` returned.
    """
    header = ("match", "step without senses", "preset", "the preset adds", "everything adds")
    rows = [
        (
            cost.case.title,
            f"{cost.microseconds:.1f} us",
            f"`{cost.case.preset}`",
            f"{cost.preset:.0%}",
            f"{cost.everything:.0%}",
        )
        for cost in costs
    ]
    return table(header, rows)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print the costs of all cases.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--worlds", type=int, default=64, help="matches at once")
    parser.add_argument("--seeds", type=int, default=8, help="seeds of matches and actions")
    parser.add_argument("--rounds", type=int, default=40, help="turns of each variant with a seed")
    parser.add_argument("--steps", type=int, default=25, help="control steps in a turn")
    given = parser.parse_args(arguments)
    numbers = (given.worlds, given.seeds, given.rounds, given.steps)
    costs = [measure(case, *numbers) for case in CASES]
    sys.stdout.write(report(costs) + "\n")


if __name__ == "__main__":
    main()
