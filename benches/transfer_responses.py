"""The same commands in other simulators and in their likenesses.

`python -m benches.transfer_responses grsim`: one robot kicks, chips, drives and turns, without the
ball and with it in its mouth, and a ball rolls. Distances count from the place where the body lay,
and times from the first motion, so that delays do not matter. The simulator runs already, as for
`benches.transfer`. The numbers are kept for `docs/transfer.md`.
"""

import argparse
import json
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.markdown import table
from benches.transfer_places import PLACES, Place, port_numbers
from rsoccer import SimConfig, Simulator, files
from rsoccer._core import Threads
from rsoccer.arrays import Doubles
from rsoccer.drive import Network
from rsoccer.frame import Frame
from rsoccer.simulator_interface import Placer, Stepper

STORED: Final = Path(__file__).parent / "results" / "transfer_responses"
"""Folder of the numbers that the documentation shows, with a file for each place."""
MOVED: Final = {"ball": 0.004, "robot": 0.002, "heading": 0.01}
"""Way after which a body has begun to move, m and rad."""
HELD: Final = 0.3
"""Time for which the dribbler holds a ball before it is kicked, s."""


@dataclass(frozen=True)
class Response:
    """Commands of a robot, and what is measured."""

    name: str
    """Name of the row."""
    body: str
    """Moving body: "ball", "robot", "heading", or "mouth" for the ball as the robot sees it."""
    command: Mapping[str, float]
    """Numbers by column of the commands."""
    seconds: float
    """Time for which they are commanded, s."""
    times: tuple[float, ...]
    """Times of the measurement since the first motion, s."""
    ball_speed: float = 0.0
    """Speed of the ball at the start, m/s; one that is kicked lies in the mouth."""
    then: Mapping[str, float] = field(default_factory=dict)
    """Numbers by column of the commands that follow; those that the command lacks are 0."""

    @property
    def has_ball(self) -> bool:
        """True if the robot begins with the ball in its mouth."""
        return self.body in ("ball", "mouth") and self.ball_speed == 0.0

    @property
    def first(self) -> str:
        """Body that moves first, at time 0."""
        if self.body != "mouth":
            return self.body
        return "heading" if "v_theta" in self.command else "robot"


def _ssl() -> tuple[Response, ...]:
    ball, robot = (0.1, 0.5, 1.0, 2.0), (0.1, 0.3, 0.6, 1.5)
    kicks = [Response(f"kick {v:g} m/s", "ball", {"kick_v_x": v}, 0.2, ball) for v in (2, 4, 6)]
    chips = [Response(f"chip {v:g} m/s at 45 degrees", "ball", _chip(v), 0.2, ball) for v in (3, 5)]
    return (
        *kicks,
        *chips,
        Response("roll 2 m/s", "ball", {}, 0.0, ball, ball_speed=2.0),
        Response("forward 1.5 m/s for .6 s", "robot", {"v_x": 1.5}, 0.6, robot),
        Response("sideways 1.5 m/s for .6 s", "robot", {"v_y": 1.5}, 0.6, robot),
        Response("turn 6 rad/s for .4 s", "heading", {"v_theta": 6.0}, 0.4, (0.1, 0.2, 0.4, 1.0)),
        *_with_ball("back {:g} m/s", "v_x", (-0.25, -1.0)),
        *_with_ball("sideways {:g} m/s", "v_y", (0.5,)),
        *_with_ball("turn {:g} rad/s", "v_theta", (1.0, 4.0)),
    )


def _with_ball(name: str, column: str, values: Sequence[float]) -> list[Response]:
    """Ways of the ball out of the mouth of a robot that moves and dribbles."""
    return [
        Response(
            f"{name.format(abs(value))} with the ball",
            "mouth",
            {column: value, "dribbler": 1.0},
            1.2,
            (0.2, 0.5, 1.0),
        )
        for value in values
    ]


def _chip(speed: float) -> dict[str, float]:
    """The command of a chip at 45 degrees, m/s."""
    return dict.fromkeys(("kick_v_x", "kick_v_z"), speed / math.sqrt(2.0))


def _vsss() -> tuple[Response, ...]:
    both = {"left": 30.0, "right": 30.0}
    return (
        Response("roll 1 m/s", "ball", {}, 0.0, (0.1, 0.3, 0.6), ball_speed=1.0),
        Response("both wheels 30 rad/s for 1 s", "robot", both, 1.0, (0.2, 0.5, 1.0, 2.0)),
        Response(
            "both wheels 30 rad/s for 1 s, then 22",
            "robot",
            both,
            1.0,
            (0.5, 1.0, 1.2, 1.6),
            then=dict.fromkeys(both, 22.0),
        ),
        Response(
            "wheels 20 and 40 rad/s for 1.5 s",
            "heading",
            {"left": 20.0, "right": 40.0},
            1.5,
            (0.1, 0.3, 0.7, 1.0),
        ),
        Response(
            "wheels -20 and 20 rad/s for .5 s",
            "heading",
            {"left": -20.0, "right": 20.0},
            0.5,
            (0.1, 0.3, 0.5, 1.5),
        ),
    )


RESPONSES: Final = {"ssl": _ssl(), "vsss": _vsss()}
"""Responses by league."""


@dataclass
class Recorder:
    """A robot and a ball of a stepper, whose states are noted."""

    stepper: Any
    """A `Stepper` that is a `Placer`."""
    config: SimConfig
    """Its match."""
    rows: list[tuple[float, Frame]] = field(default_factory=list)
    """Times (s) and states."""

    def begin(self, response: Response) -> None:
        """Put robot and ball where the response begins."""
        start = Frame.empty(1, 1, 0)
        model, half = self.config.robots[0], self.config.field.length / 2.0
        position, heading = start.robots.position[0, 0], start.robots.heading[0, 0]
        position[:], heading[:] = (-0.8 * half, 0.0), (1.0, 0.0)
        ball = start.ball
        if response.has_ball:
            ball.position[0] = (-0.8 * half + model.front_distance + self.config.ball.radius, 0.0)
        else:
            ball.position[0] = (-0.8 * half, 0.4 * self.config.field.width)
            ball.velocity[0] = (response.ball_speed, 0.0)
        placer: Placer = self.stepper
        self.rows.clear()
        self._note(placer.place(np.ones(1, np.bool_), start.rows, start.rows), start)

    def play(self, command: Mapping[str, float], seconds: float) -> None:
        """Command the robot for some time."""
        stepper: Stepper = self.stepper
        columns = self.config.command_columns
        commands = np.zeros((1, 1, len(columns)), np.float32)
        for name, value in command.items():
            commands[0, 0, columns.index(name)] = value
        for _ in range(round(seconds / self.config.time_step)):
            state = Frame.empty(1, 1, 0)
            self._note(stepper.step(commands, state.rows), state)

    def _note(self, times: Doubles | None, state: Frame) -> None:
        step = self.config.time_step
        last = self.rows[-1][0] if self.rows else -step
        self.rows.append((last + step if times is None else float(times[0]), state))

    def ways(self, body: str) -> tuple[Doubles, Doubles]:
        """Return times (n,) s and the ways (n,) of what moves since its first state, m or rad."""
        times = np.array([time for time, _ in self.rows])
        headings = np.array([state.robots.heading[0, 0] for _, state in self.rows])
        if body == "heading":
            angles = np.unwrap(np.arctan2(headings[:, 1], headings[:, 0]).astype(np.float64))
            return times, np.abs(angles - angles[0])
        robots = np.array([state.robots.position[0, 0] for _, state in self.rows], np.float64)
        balls = np.array([state.ball.position[0] for _, state in self.rows], np.float64)
        if body == "mouth":
            away, side = balls - robots, np.stack([-headings[:, 1], headings[:, 0]], axis=1)
            places = np.stack([(away * headings).sum(axis=1), (away * side).sum(axis=1)], axis=1)
        else:
            places = balls if body == "ball" else robots
        return times, np.linalg.norm(places - places[0], axis=1)


def measure(stepper: object, config: SimConfig, response: Response) -> list[float]:
    """Return the ways at the times of a response; NaN if nothing moved.

    Args:
        stepper: a `Stepper` that is a `Placer`, with one robot.
        config: its match.
        response: what is commanded and measured.
    """
    recorder = Recorder(stepper, config)
    recorder.begin(response)
    if response.has_ball:
        recorder.play({"dribbler": 1.0}, HELD)
        del recorder.rows[:-1]
    recorder.play(response.command, response.seconds)
    recorder.play(response.then, max(response.times) + 0.3 - response.seconds)
    times, ways = recorder.ways(response.first)
    threshold = MOVED[response.first]
    first = int(np.argmax(ways > threshold))
    if ways[first] <= threshold:
        return [float("nan")] * len(response.times)
    # The motion began within the step before.
    share = threshold / (ways[first] - ways[first - 1])
    began = times[first - 1] + min(share, 1.0) * (times[first] - times[first - 1])
    ways = recorder.ways(response.body)[1]
    found: list[float] = np.interp([began + time for time in response.times], times, ways).tolist()
    return found


def responses(place: Place, ports: Mapping[str, int] | None = None) -> dict[str, list[float]]:
    """Return the ways by name of the response.

    Args:
        place: another simulator.
        ports: its ports that differ; None for its likeness in this package's own simulator.
    """
    config, known = place.config(), RESPONSES[place.league]
    if ports is None:
        return {
            each.name: measure(Simulator(config, 1, Threads(1)), config, each) for each in known
        }
    network = Network(place.settings(ports))
    try:
        stepper = network(config, 1, Threads(1))
        return {each.name: measure(stepper, config, each) for each in known}
    finally:
        network.close()


def report(folder: Path = STORED) -> str:
    """Return the table of the places in a folder.

    Args:
        folder: the folder.
    """
    rows = []
    for name, place in PLACES.items():
        path = folder / f"{name}.json"
        if not path.is_file():
            continue
        there, like = json.loads(path.read_text()), responses(place)
        for each in RESPONSES[place.league]:
            unit = "rad" if each.body == "heading" else "m"
            cells = [
                " / ".join("-" if np.isnan(way) else f"{way:.2f}" for way in ways[each.name])
                for ways in (there, like)
            ]
            times = " / ".join(f"{time:g}" for time in each.times)
            rows.append((place.title, each.name, f"{unit} after {times} s", *cells))
    return table(("simulator", "command", "way", "there", "its likeness here"), rows)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure and store the numbers, and print the table.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("place", choices=list(PLACES), help="the simulator")
    parser.add_argument("--ports", nargs="*", default=[], metavar="NAME=PORT", help="other ports")
    parser.add_argument("--results", type=Path, default=STORED, help="folder of the numbers")
    given = parser.parse_args(arguments)
    found = responses(PLACES[given.place], port_numbers(given.ports))
    rounded = {name: np.round(ways, 4).tolist() for name, ways in found.items()}
    given.results.mkdir(parents=True, exist_ok=True)
    content = json.dumps(rounded, indent=1) + "\n"
    files.write_atomically(given.results / f"{given.place}.json", content.encode())
    sys.stdout.write(report(given.results) + "\n")


if __name__ == "__main__":
    main()
