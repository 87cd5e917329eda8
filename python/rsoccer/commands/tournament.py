"""`rsoccer tournament`: ratings of policies that all play against each other."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.sources import Sources
from rsoccer.commands.subject import DEFAULT_TASK_HINT, check_policy_names
from rsoccer.commands.task_options import TASK_OPTIONS, named_task
from rsoccer.evaluate import tournament
from rsoccer.files import write_atomically

_POLICIES = arg(
    metavar="POLICY [POLICY ...]",
    help="names that `rsoccer list` prints, or paths of policy files; at least two",
    help_behavior_hint="",
)


@dataclass(frozen=True)
class Tournament(Sources, Imports):
    """Play every policy against every other one, from both sides, and print their ratings."""

    policies: Annotated[tuple[str, ...], Positional, _POLICIES]
    """policies that play, at least two"""
    matches: int = 100
    """matches between each two policies, half of them on either side; intervals need 20 or more"""
    seed: int = 0
    """random seed; equal seeds give equal tables"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task to play, one that two teams play; each policy controls all robots of its team"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """file to write the results to as JSON, in addition to the tables"""
    picture: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.png file to write: the goal scores as a heat map, and the ratings"""

    def run(self) -> None:
        """Play the matches, then print the tables.

        Raises:
            ValueError: the folder of a file does not exist, or `tournament` refuses an option.
        """
        check_output("json", self.json)
        check_output("picture", self.picture, ".png")
        if self.picture is not None:
            import matplotlib  # noqa: F401  (a missing package is reported before the matches)
        check_policy_names(self.policies)
        result = tournament(
            self.policies,
            self.matches,
            self.seed,
            task=named_task(self.task, self.task_options),
            worlds=self.worlds,
            threads=self.threads,
            on_pair=_show_pairs,
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        )
        write(str(result))
        if self.json is not None:
            write_atomically(self.json, (json.dumps(result.as_dict(), indent=2) + "\n").encode())
        if self.picture is not None:
            write(f"picture: {result.save_picture(self.picture)}")


def _show_pairs(done: int, total: int) -> None:
    """Show on a terminal how many pairs have played."""
    if sys.stderr.isatty():
        sys.stderr.write(f"\r{done} of {total} pairs" + ("\n" if done == total else ""))
