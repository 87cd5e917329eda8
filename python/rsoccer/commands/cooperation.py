"""`rsoccer cooperation`: how much the robots of a team do for each other."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import Positional, arg

from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.sources import Sources
from rsoccer.commands.subject import (
    DEFAULT_OPPONENT_HINT,
    DEFAULT_TASK_HINT,
    POLICY,
    SUBJECT,
    check_policy_names,
    policy_and_task,
)
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.evaluate import cooperation
from rsoccer.files import write_atomically

_REPLACEMENTS = arg(
    metavar="[POLICY [POLICY ...]]",
    help_behavior_hint="(default: zero and the script of the task)",
)
_PARTNERS = arg(metavar="[POLICY [POLICY ...]]", help_behavior_hint="(default: none)")


@dataclass(frozen=True)
class Cooperation(Sources, Imports):
    """Play matches of a team with one robot replaced, and print its scores, passes and places."""

    subject: Annotated[str | None, Positional, SUBJECT] = None
    """policy in the place of the learners, or the task"""
    policy: Annotated[str | None, POLICY] = None
    """policy in the place of the learners, after a task"""
    opponents: Annotated[
        str | None, arg(metavar="POLICY", help_behavior_hint=DEFAULT_OPPONENT_HINT)
    ] = None
    """policy of the other team, name or path"""
    replacements: Annotated[tuple[str, ...], _REPLACEMENTS] = ()
    """policies that replace one robot of the team, every robot in turn, such as one that has
    learned alone"""
    partners: Annotated[tuple[str, ...], _PARTNERS] = ()
    """policies for cross-play, such as other seeds: teams that are half of each two"""
    matches: int = 200
    """matches of each line-up; in two-sided tasks half of them as blue, half as yellow. Intervals
    need 10 or more for each side"""
    seed: int = 0
    """random seed; equal seeds give equal tables"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task to play, one with at least two robots a team"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""
    worlds: int = 50
    """matches played at once"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """file to write the results to as JSON, in addition to the tables"""

    def run(self) -> None:
        """Play the matches, then print the tables.

        Raises:
            ValueError: neither a policy nor a task, the folder of a file does not exist, or
                `cooperation` refuses an option.
        """
        check_output("json", self.json)
        if (self.subject, self.policy, self.task) == (None, None, None):
            raise ValueError("policy: expected a policy or a task, got none")
        check_policy_names((self.opponents, *self.replacements, *self.partners))
        policy, task = policy_and_task(self.subject, self.policy, self.task, self.task_options)
        result = cooperation(
            policy,
            self.opponents,
            self.matches,
            self.seed,
            task=task,
            replacements=self.replacements or None,
            partners=self.partners,
            worlds=self.worlds,
            threads=self.threads,
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        )
        write(str(result))
        if self.json is not None:
            write_atomically(self.json, (json.dumps(result.as_dict(), indent=2) + "\n").encode())
