"""`--simulator`, `--sensing` and `--randomization` of all commands that play matches."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from typing import Annotated, Any

from tyro.conf import arg

from rsoccer.commands.task_options import RANDOMIZATION

_SIMULATOR = arg(metavar="NAME|MODULE:NAME", help_behavior_hint="(default: the package's own)")
_SENSING = arg(
    metavar="PRESET|FILE|MODULE:NAME", help_behavior_hint="(default: they know it exactly)"
)


@dataclass(frozen=True, kw_only=True)
class Sources:
    """Options of all commands that play matches, in the words of `rsoccer train`."""

    simulator: Annotated[str | None, _SIMULATOR] = None
    """grsim, firasim or ssl-simulation on this machine, or a function (config, worlds, threads)
    that makes the simulator"""
    sensing: Annotated[str | None, _SENSING] = None
    """senses of the robots: noise, delay and loss"""
    randomization: Annotated[Mapping[str, Any], RANDOMIZATION] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as robot.mass=0.9,1.1"""


@contextmanager
def refusals_as_wrong_input() -> Iterator[None]:
    """Return a context manager that reports what is no simulator and no sensor model as a value.

    In Python an object of another type is a TypeError. On the command line it is a wrong word.

    Raises:
        ValueError: in place of a TypeError that names one of these options.
    """
    try:
        yield
    except TypeError as error:
        argument = str(error).partition(":")[0].partition("[")[0]
        if argument in {each.name for each in fields(Sources)}:
            raise ValueError(str(error)) from error
        raise
