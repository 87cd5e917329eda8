"""`rsoccer distill`: `DistillArgs` with the options that tyro cannot parse by itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from tyro.conf import arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import write
from rsoccer.commands.task_options import RANDOMIZATION
from rsoccer.train.distillation import DistillArgs, distill


@dataclass(frozen=True)
class CommandDistillArgs(DistillArgs):
    """Settings as the command line takes them."""

    randomization: Annotated[Mapping[str, Any], RANDOMIZATION] = field(default_factory=dict)
    """numbers that each episode draws, by name, such as robot.mass=0.9,1.1"""


@dataclass(frozen=True)
class Distill(Imports):
    """Teach a policy with late and noisy senses what a policy on the true state does."""

    args: Annotated[CommandDistillArgs, arg(name="")]
    """settings of the run"""

    def run(self) -> None:
        """Distill, and print the path of the policy file."""
        write(f"policy: {distill(self.args)}")
