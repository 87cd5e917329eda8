"""Excitation: commands that show latency, gains and limits of a robot, and balls that roll."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles
from rsoccer.checks import number_in_range, positive_number
from rsoccer.identify.log import DRIVES, KICK

MAX_RATE: Final = 1000.0
"""Greatest rate of commands, Hz: no link to a robot is as fast."""
MAX_SECONDS: Final = 3600.0
"""Longest program, s: steps last as long as the robot needs for them, and memory is limited."""
LEVELS: Final = (0.3, 0.6, 1.0)
"""Parts of the greatest speeds that are commanded."""
KICKS: Final = (1.5, 3.0, 6.0)
"""Commanded speeds of kicks, m/s."""
ROLLS: Final = (0.5, 1.0, 1.6)
"""Speeds with which a person rolls the ball to a robot without a kicker, m/s."""
_BEYOND: Final = 1.15  # of top speeds, which show if they are exceeded
_CRUISE: Final = 0.35  # s at a commanded speed
_COAST: Final = 0.25  # s at rest
_MAX_ANGULAR_VELOCITY: Final = 20.0  # rad/s: faster turns are hard to film
_KICK: Final = 0.15  # s that a kick is commanded


@dataclass(frozen=True)
class Program:
    """Commands of a robot that hold from a time to the next one."""

    drive: str
    """Kind of the commands, a key of `rsoccer.identify.log.DRIVES`."""
    times: Doubles
    """(n,) s."""
    wheels: Doubles
    """(n, columns) commands for the wheels."""
    kicks: Doubles
    """(n,) commanded speeds of kicks, m/s; 0 for none."""
    seconds: float
    """Length of the program."""
    balls: tuple[tuple[float, float], ...]
    """Times (s) at which a person brings the ball, and the speed with which it rolls (m/s): 0
    where the ball lies in front of the robot, which then kicks it."""

    def at(self, times: Doubles) -> tuple[Doubles, Doubles]:
        """Return the commands that hold at some times.

        Args:
            times: (m,) s.

        Returns:
            Commands for the wheels (m, columns) and speeds of kicks (m,).
        """
        # A step that begins at a control step begins with it, whatever the rounding.
        index = np.searchsorted(self.times, times + 1e-9, side="right") - 1
        return self.wheels[np.maximum(index, 0)], self.kicks[np.maximum(index, 0)]

    def to_csv(self, rate: float = 60.0) -> str:
        """Return the commands as CSV, with the columns of a log and without the robot's name.

        Args:
            rate: commands a second: robots stop that hear nothing for some time.

        Raises:
            TypeError: `rate` is no number.
            ValueError: `rate` is not 1 to `MAX_RATE`.
        """
        period = 1.0 / number_in_range("rate", rate, 1.0, MAX_RATE)
        times = np.arange(int(self.seconds / period)) * period
        wheels, kicks = self.at(times.astype(np.float64))
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        has_kicks = bool(self.kicks.any())
        writer.writerow(["time", *DRIVES[self.drive], *([KICK] if has_kicks else [])])
        for time, row, kick in zip(times.tolist(), wheels.tolist(), kicks.tolist(), strict=True):
            numbers = [*row, *([kick] if has_kicks else [])]
            writer.writerow([f"{time:.4f}", *(f"{number:g}" for number in numbers)])
        return text.getvalue()


def program(
    robot: str | RobotModel = "ssl_generic",
    *,
    max_speed: float | None = None,
    max_angular_velocity: float | None = None,
    pause: float = 0.5,
) -> Program:
    """Return a program of steps forward, sideways, turning and combined, and of kicks or rolls.

    Every step is driven back, so the robot stays near its start: within 4 m for an SSL robot at its
    top speed, and within a quarter of that at half of it. It begins in the middle of the field; for
    kicks at an end.

    Args:
        robot: the robot's model or the name of its preset; its limits set the lengths of steps.
        max_speed: greatest commanded speed, m/s; None for 1.15 of the model's top speed, which
            shows only if more is commanded.
        max_angular_velocity: greatest commanded angular velocity, rad/s; None for 1.15 of the
            model's, at most 20.
        pause: time to bring the ball before each kick or roll, s.

    Raises:
        TypeError: `robot` is no model, or a number is none.
        ValueError: no such preset, wheels that cannot be commanded by a log, a number that is not
            positive, or a program longer than `MAX_SECONDS`.
    """
    model = RobotModel(robot) if isinstance(robot, str) else robot
    if not isinstance(model, RobotModel):
        raise TypeError(f"robot: expected a RobotModel or the name of a preset, got {robot!r}")
    check_drive(model)
    fastest = positive_number(
        "max_speed", _BEYOND * model.top_speed if max_speed is None else max_speed
    )
    turn = min(_BEYOND * model.top_angular_velocity, _MAX_ANGULAR_VELOCITY)
    turn = positive_number(
        "max_angular_velocity", turn if max_angular_velocity is None else max_angular_velocity
    )
    pieces = _Pieces(len(DRIVES[model.drive]))
    steps = _omni_steps if model.drive == "omni" else _wheel_steps
    pieces.add(_COAST)
    for command, seconds in steps(model, fastest, turn):
        pieces.add(seconds + _CRUISE, command)
        pieces.add(seconds + _COAST)
    balls = []
    for ball in KICKS if model.has_mouth else ROLLS:
        pieces.add(positive_number("pause", pause))
        balls.append((pieces.seconds, 0.0 if model.has_mouth else ball))
        pieces.add(_COAST)
        if model.has_mouth:
            pieces.add(_KICK, kick=ball)
        pieces.add(2.0)
    if pieces.seconds > MAX_SECONDS:
        raise ValueError(
            f"program: expected at most {MAX_SECONDS:g} s, got {pieces.seconds:g} s; lower "
            "max_speed, max_angular_velocity or pause"
        )
    return pieces.program(model.drive, tuple(balls))


def check_drive(model: RobotModel) -> None:
    """Refuse a robot that a log cannot command.

    Args:
        model: the robot.

    Raises:
        ValueError: another drive than those of `DRIVES`.
    """
    if model.drive not in DRIVES:
        raise ValueError(
            f"robot: expected a drive of {', '.join(DRIVES)}, got {model.drive} of {model.name}"
        )


Step = tuple[Sequence[float], float]
"""A command and the time that the robot takes to obey it (s)."""


def _omni_steps(model: RobotModel, speed: float, turn: float) -> Iterator[Step]:
    """Steps of velocity, there and back."""

    def there_and_back(x: float, y: float, angular: float) -> Iterator[Step]:
        linear = (x * x + y * y) ** 0.5 / min(model.max_acceleration, model.max_deceleration)
        seconds = max(linear, abs(angular) / model.max_angular_acceleration)
        for sign in (1.0, -1.0):
            yield (sign * x, sign * y, sign * angular), seconds

    for level in LEVELS:
        yield from there_and_back(level * speed, 0.0, 0.0)
        yield from there_and_back(0.0, level * speed, 0.0)
        yield from there_and_back(0.0, 0.0, level * turn)
    yield from there_and_back(0.3 * speed, 0.3 * speed, 0.2 * turn)


def _wheel_steps(model: RobotModel, speed: float, turn: float) -> Iterator[Step]:
    """Steps of wheel speeds, there and back: straight, on the spot, and along arcs."""
    forward = speed / model.wheel_radius
    turning = 0.5 * turn * model.track_width / model.wheel_radius
    acceleration = model.longitudinal_grip * max(1.0 - model.tipping_friction, 0.1)
    seconds = 1.5 * speed / acceleration
    for level in LEVELS:
        straight, spot = level * forward, level * turning
        for left, right in (
            (straight, straight),
            (-spot, spot),
            (straight, 0.5 * straight),
            (0.5 * straight, straight),
        ):
            yield (left, right), seconds
            yield (-left, -right), seconds


class _Pieces:
    """A program that grows."""

    def __init__(self, columns: int) -> None:
        self.rest = [0.0] * columns
        self.rows: list[tuple[float, Sequence[float], float]] = []
        self.seconds = 0.0

    def add(
        self, seconds: float, command: Sequence[float] | None = None, kick: float = 0.0
    ) -> None:
        """Command something for some time."""
        self.rows.append((self.seconds, self.rest if command is None else command, kick))
        self.seconds += seconds

    def program(self, drive: str, balls: tuple[tuple[float, float], ...]) -> Program:
        """Return the program."""
        times = np.array([row[0] for row in self.rows])
        wheels = np.array([row[1] for row in self.rows], np.float64)
        kicks = np.array([row[2] for row in self.rows])
        return Program(drive, times, wheels, kicks, self.seconds, balls)
