"""Accuracy of `rsoccer identify`: `python -m benches.identify --logs 20`.

Robots with random latency, gains and limits follow the program of `rsoccer.identify`, seen by
cameras with the noise of rc2021, which also lose commands. Prints for each number its errors, half
the width of its intervals, and how many intervals hold the truth.
"""

import argparse
import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from benches.markdown import table
from rsoccer import BallModel, RobotModel, Sensing
from rsoccer.identify import Estimate, identify, program, record

LIMITS: Final = (
    *("max_acceleration", "max_deceleration"),
    *("max_angular_acceleration", "max_angular_deceleration"),
)
ABSOLUTE: Final = ("latency", "kick_latency", "wheel_difference")
"""Numbers whose errors are not divided by them."""
LINK: Final = 0.02  # s of the latency, on the way to the robot


@dataclass
class Count:
    """Errors of one number, and its intervals."""

    errors: list[float] = field(default_factory=list)
    halves: list[float] = field(default_factory=list)
    held: int = 0
    missing: int = 0

    def add(self, estimate: Estimate, truth: float) -> None:
        """Take in an estimate.

        Args:
            estimate: the estimate.
            truth: the true number.
        """
        if not estimate.is_identified:
            self.missing += 1
            return
        unit = 1.0 if estimate.name in ABSOLUTE else truth
        self.errors.append((estimate.value - truth) / unit)
        self.halves.append((estimate.high - estimate.low) / 2.0 / unit)
        self.held += estimate.low <= truth <= estimate.high


def measure(league: str, logs: int, first: int = 0) -> dict[str, Count]:
    """Identify robots with random numbers.

    Args:
        league: "ssl" or "vss".
        logs: number of robots, with a log each.
        first: seed of the first one.
    """
    counts: dict[str, Count] = defaultdict(Count)
    for seed in range(first, first + logs):
        rng = np.random.default_rng(seed)
        latency, rolling = rng.uniform(0.03, 0.12), rng.uniform(0.15, 0.4)
        robot, gains, truth = (_ssl if league == "ssl" else _vss)(rng)
        base = RobotModel("ssl_generic" if league == "ssl" else "vss_440rpm")
        floor = BallModel("ssl_tigers" if league == "ssl" else "vss_rsim")
        ball = BallModel(floor.name, rolling_deceleration=rolling)
        senses = Sensing("rc2021", delay=latency - LINK, command_delay=LINK)
        log = record(robot, ball, senses, excitation=program(base), gains=gains, seed=seed)
        found = identify(log, base)
        truth |= {"latency": latency, "rolling_deceleration": rolling}
        for name, number in truth.items():
            counts[name].add(found.estimate(name), number)
    return counts


def _ssl(rng: np.random.Generator) -> tuple[RobotModel, list[float], dict[str, float]]:
    """A robot of the SSL, its gains, and its numbers."""
    base = RobotModel("ssl_generic")
    numbers = {name: float(rng.uniform(0.5, 1.0)) * getattr(base, name) for name in LIMITS}
    numbers["max_speed"] = float(rng.uniform(2.4, 2.9))
    gains = rng.uniform(0.85, 1.05, 3).tolist()
    axes = ("forward", "sideways", "turning")
    truth = {f"gain_{axis}": gain for axis, gain in zip(axes, gains, strict=True)}
    kicks = {"sliding_deceleration": 3.0, "slide_to_roll_ratio": 2.0 / 3.0, "kick_gain": 1.0}
    return RobotModel("ssl_generic", **numbers), gains, truth | numbers | kicks


def _vss(rng: np.random.Generator) -> tuple[RobotModel, list[float], dict[str, float]]:
    """A robot of VSSS, its gains, and its numbers."""
    base = RobotModel("vss_440rpm")
    grip = float(rng.uniform(0.5, 1.0)) * base.longitudinal_grip
    mean, difference = float(rng.uniform(0.85, 1.05)), float(rng.uniform(-0.04, 0.04))
    left, right = mean * (1.0 - difference / 2.0), mean * (1.0 + difference / 2.0)
    truth = {
        "wheel_radius": base.wheel_radius * mean,
        "wheel_difference": difference,
        "track_width": base.track_width,
        "longitudinal_grip": grip,
    }
    return RobotModel("vss_440rpm", longitudinal_grip=grip), [left, right], truth


def rows(counts: dict[str, Count]) -> list[list[str]]:
    """Return the rows of a table.

    Args:
        counts: counts by the name of their number.
    """
    found = []
    for name, count in counts.items():
        share = "" if name in ABSOLUTE else "%"
        unit = 1.0 if name in ABSOLUTE else 100.0
        most = max(map(abs, count.errors), default=0.0) * unit
        typical = float(np.sqrt(np.mean(np.square(count.errors or [0.0])))) * unit
        half = float(np.mean(count.halves or [0.0])) * unit
        numbers = [f"{number:.2g}{share}" for number in (typical, most, half)]
        identified = len(count.errors)
        found.append([name, f"{identified} of {identified + count.missing}", *numbers])
        found[-1].append(f"{count.held} of {identified}")
    return found


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and print.

    Args:
        arguments: words of the command line; those of `sys.argv` by default.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--logs", type=int, default=20, help="robots of each league")
    parser.add_argument("--leagues", nargs="+", default=["ssl", "vss"], choices=["ssl", "vss"])
    options = parser.parse_args(arguments)
    header = ("number", "identified", "error (rms)", "greatest error", "half interval", "held")
    for league in options.leagues:
        counts = measure(league, options.logs)
        sys.stdout.write(f"{league}\n\n{table(header, map(tuple, rows(counts)))}\n\n")


if __name__ == "__main__":
    main()
