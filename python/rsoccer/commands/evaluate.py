"""`rsoccer evaluate`: the scores of a policy against each opponent."""

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
    team_name,
)
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.evaluate import evaluate, table
from rsoccer.files import write_atomically
from rsoccer.lineup import opponents_of
from rsoccer.replay.evaluation import record_last_match
from rsoccer.replay.replay import SUFFIX
from rsoccer.sources import plays_one_match
from rsoccer.task import Task


@dataclass(frozen=True)
class Evaluate(Sources, Imports):
    """Play matches with a policy and print its scores, half for each team in two-sided tasks."""

    subject: Annotated[str | None, Positional, SUBJECT] = None
    """policy in the place of the learners, or the task"""
    policy: Annotated[str | None, POLICY] = None
    """policy in the place of the learners, after a task"""
    opponents: Annotated[tuple[str, ...], arg(help_behavior_hint=DEFAULT_OPPONENT_HINT)] = ()
    """policies of the other team, names or paths; one row of the table for each"""
    matches: int = 200
    """matches against each opponent; in two-sided tasks half of them as blue, half as yellow.
    Intervals need 10 or more for each side"""
    seed: int = 0
    """random seed; equal seeds give equal tables"""
    task: Annotated[str | None, arg(metavar="TASK", help_behavior_hint=DEFAULT_TASK_HINT)] = None
    """task to play"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """options of the task that is named (`rsoccer list` prints them), such as n_opponents=2"""
    worlds: int = 50
    """matches played at once; one with a simulator on the network"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    json: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """file to write the results to as JSON, in addition to the table"""
    html: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.html file to write: a page that plays the last match in a browser"""
    save: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.rsr file to write: the last match as a replay, which `rsoccer watch` plays"""

    def run(self) -> None:
        """Play the matches, then print the table.

        Raises:
            ValueError: neither a policy nor a task, the folder of a file does not exist, or
                `evaluate` refuses an option.
        """
        check_output("json", self.json)
        check_output("html", self.html, ".html")
        check_output("save", self.save, SUFFIX)
        if (self.subject, self.policy, self.task) == (None, None, None):
            raise ValueError("policy: expected a policy or a task, got none")
        check_policy_names(self.opponents)
        policy, task = policy_and_task(self.subject, self.policy, self.task, self.task_options)
        evaluations = [
            evaluate(
                policy,
                opponent,
                self.matches,
                self.seed,
                task=task,
                worlds=1 if plays_one_match(self.simulator) else self.worlds,
                threads=self.threads,
                simulator=self.simulator,
                sensing=self.sensing,
                randomization=self.randomization,
            )
            for opponent in self.opponents or (None,)
        ]
        write(f"{evaluations[0].task}\n\n{table(evaluations)}")
        if self.json is not None:
            results = [evaluation.as_dict() for evaluation in evaluations]
            write_atomically(self.json, (json.dumps(results, indent=2) + "\n").encode())
        if self.html is not None or self.save is not None:
            self._write_last_match(policy, task)

    def _write_last_match(self, policy: str, task: Task) -> None:
        """Record the last match against the last opponent."""
        opponent = self.opponents[-1] if self.opponents else None
        opponents = opponents_of(task) if opponent is None else [opponent]
        replay = record_last_match(
            policy,
            opponent,
            self.matches,
            self.seed,
            task=task,
            names=(team_name(policy), " ".join(map(team_name, opponents))),
            simulator=self.simulator,
            sensing=self.sensing,
            randomization=self.randomization,
        )
        if self.html is not None:
            write(f"page: {replay.save_html(self.html)}")
        if self.save is not None:
            write(f"replay: {replay.save(self.save)}")
