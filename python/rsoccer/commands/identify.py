"""`rsoccer identify`: delay and drive of a robot from a log of commands and poses."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.identify import identify, program, read_log, report

_BY_LOG = "(default: that of the log's commands)"
_OF_FIT = ("log", "ball", "clocks", "seed")
"""Options of the fit of a log alone."""
_OF_PROGRAM = ("rate", "max_speed", "max_angular_velocity", "pause")
"""Options of the program alone."""
_BEYOND = arg(help_behavior_hint="(default: somewhat more than the model's)")


@dataclass(frozen=True)
class Identify(Imports):
    """Fit latency, drive and rolling to a log of commands and poses, with intervals of 95%."""

    log: Annotated[tuple[Path, ...], Positional, arg(metavar="LOG")] = ()
    """CSV file with the log, or several: such as that of the radio and that of the cameras"""
    robot: Annotated[str | None, arg(metavar="PRESET|FILE", help_behavior_hint=_BY_LOG)] = None
    """model with the numbers that the log does not show: vss_440rpm or ssl_generic"""
    ball: Annotated[str | None, arg(metavar="PRESET|FILE", help_behavior_hint=_BY_LOG)] = None
    """model of the ball with the same: vss_rsim or ssl_tigers"""
    clocks: int = 1
    """2 if commands and poses have clocks of their own: then the latency stays unknown"""
    seed: int = 0
    """random seed of the intervals"""
    out: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.json file to write: models for --sensing and for the task options robot and ball. With
    --program the .csv file of the program"""
    program: bool = False
    """print commands that show all numbers in place of a fit, for a robot to follow"""
    rate: float = 60.0
    """commands a second of the program"""
    max_speed: Annotated[float | None, _BEYOND] = None
    """greatest speed of the program, m/s; half of it needs a quarter of the space"""
    max_angular_velocity: Annotated[float | None, _BEYOND] = None
    """greatest angular velocity of the program, rad/s"""
    pause: float = 0.5
    """time in the program to bring the ball before each kick or roll, seconds"""

    def run(self) -> None:
        """Fit the log and print the numbers, or print the program.

        Raises:
            FileNotFoundError: no such log.
            ValueError: neither a log nor a program, an option of the other one, the folder of a
                file does not exist, or `read_log` or `identify` refuses the log.
        """
        self._check_options(_OF_FIT if self.program else _OF_PROGRAM)
        if self.program:
            self._write_program()
            return
        check_output("out", self.out, ".json")
        identified = identify(
            read_log(*self.log), self.robot, self.ball, clocks=self.clocks, seed=self.seed
        )
        write(report(identified))
        if self.out is not None:
            write(f"models: {identified.save(self.out)}")

    def _check_options(self, refused: tuple[str, ...]) -> None:
        """Refuse options that would change nothing."""
        defaults = {each.name: each.default for each in fields(self)}
        for name in refused:
            if getattr(self, name) != defaults[name]:
                condition = "with" if self.program else "without"
                raise ValueError(f"{name}: expected none {condition} --program")

    def _write_program(self) -> None:
        """Write the program to the file, or print it."""
        check_output("out", self.out, ".csv")
        made = program(
            self.robot or "ssl_generic",
            max_speed=self.max_speed,
            max_angular_velocity=self.max_angular_velocity,
            pause=self.pause,
        )
        text = made.to_csv(self.rate)
        if self.out is None:
            write(text.rstrip("\n"))
        else:
            self.out.write_text(text, encoding="utf-8")
            write(f"program: {self.out}")
