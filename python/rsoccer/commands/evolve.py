"""`rsoccer evolve`: `EvolveArgs` with the options that tyro cannot parse by itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from tyro.conf import arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import write
from rsoccer.commands.task_options import RANDOMIZATION, TASK_OPTIONS
from rsoccer.train.evolution import EvolveArgs, evolve


@dataclass(frozen=True)
class CommandEvolveArgs(EvolveArgs):
    """Settings as the command line takes them."""

    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task (`rsoccer list` prints them), such as half_seconds=60"""
    randomization: Annotated[Mapping[str, Any], RANDOMIZATION] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as robot.mass=0.9,1.1"""


@dataclass(frozen=True)
class Evolve(Imports):
    """Find better numbers of a script by playing matches."""

    args: Annotated[CommandEvolveArgs, arg(name="")]
    """settings of the run"""

    def run(self) -> None:
        """Evolve, and print the path of the policy file."""
        write(f"policy: {evolve(self.args)}")
