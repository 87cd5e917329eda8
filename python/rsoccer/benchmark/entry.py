"""An entry of the leaderboard: what a policy scores on each task, as one JSON file."""

from __future__ import annotations

import dataclasses
import datetime
import hashlib
import json
import os
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from rsoccer import plugins
from rsoccer.benchmark.machine import machine, versions
from rsoccer.benchmark.protocol import MATCHES, SEED, rows_of
from rsoccer.files import write_atomically
from rsoccer.policies import PolicyLike, file_of, is_module_text, is_registered, name_of
from rsoccer.policies.base import Policy
from rsoccer.policies.names import source_of

FORMAT: Final = 1
"""Version of the file."""
LINK: Final = re.compile(r"(https?://[^\s<>()\[\]|`\"\\]+)?")
"""Address of code or paper, or none; without characters that end a link of a page."""


@dataclass(frozen=True)
class Row:
    """Scores of a policy in matches of one task against one opponent, under one condition."""

    opponent: str
    """policy of the other team; "-" if there is none or the task has its own"""
    condition: str
    """name of a condition of `rsoccer.benchmark.conditions`; "truth" for the true state"""
    metric: str
    """metric whose mean is the score: the task's success"""
    matches: int
    """number of matches"""
    wins: int
    """matches with a score above 0"""
    draws: int
    """matches with a score of 0"""
    losses: int
    """matches with a score below 0"""
    score: float
    """mean score"""
    low: float
    """lower bound of the score's 95% interval"""
    high: float
    """upper bound of the score's 95% interval"""
    seconds: float
    """mean duration of a match, s"""
    wall_clock: float
    """time that the matches took, s"""


@dataclass(frozen=True)
class Entry:
    """All rows of a policy, with what they depend on."""

    name: str
    """name in the table"""
    policy: str
    """name, path or "module:name" of the policy"""
    digest: str
    """SHA-256 of the policy file or of the file with the code; empty for policies of the package"""
    description: str
    """origin of the policy, in a sentence"""
    link: str
    """address of code or paper; empty for none"""
    date: str
    """day of the measurement, year-month-day"""
    matches: int
    """matches of each row"""
    seed: int
    """seed of the initial states"""
    robust: bool
    """whether the first opponent was met under all conditions"""
    versions: Mapping[str, str | int]
    """versions of the package and of its physics"""
    machine: Mapping[str, str | int]
    """processor, cores, system, versions of Python and NumPy"""
    tasks: Mapping[str, tuple[Row, ...]]
    """rows by task, for the tasks that the policy plays"""
    refused: Mapping[str, str] = field(default_factory=dict)
    """tasks that the policy cannot play, with the reasons"""

    @staticmethod
    def begun(
        policy: PolicyLike,
        name: str | None = None,
        *,
        description: str = "",
        link: str = "",
        matches: int = MATCHES,
        robust: bool = True,
    ) -> Entry:
        """Return an entry without rows, measured on this machine today.

        Args:
            policy: a policy, its name, its file, or "module:name".
            name: name in the table; by default that of the policy.
            description: how the policy was made.
            link: address of code or paper.
            matches: matches of each row.
            robust: whether it will be measured under all conditions.

        Raises:
            ValueError: a link that is no address.
        """
        if not LINK.fullmatch(link):
            raise ValueError(f"link: expected an address (https://...) or none, got {link!r}")
        return Entry(
            name=name or name_of(policy),
            policy=name_of(policy),
            digest=digest(policy),
            description=description,
            link=link,
            date=datetime.datetime.now(datetime.UTC).date().isoformat(),
            matches=matches,
            seed=SEED,
            robust=robust,
            versions=versions(),
            machine=machine(),
            tasks={},
        )

    def missing(self, task: str) -> list[tuple[str | None, str]]:
        """Return the opponents and conditions of a task that have no row yet.

        Args:
            task: name of the task.
        """
        if task in self.refused:
            return []
        done = {(row.opponent, row.condition) for row in self.tasks.get(task, ())}
        expected = rows_of(task, self.robust)
        return [row for row in expected if (row[0] or "-", row[1]) not in done]

    def with_row(self, task: str, row: Row) -> Entry:
        """Return the entry with one more row.

        Args:
            task: name of the task.
            row: the row.
        """
        tasks = {**self.tasks, task: (*self.tasks.get(task, ()), row)}
        return dataclasses.replace(self, tasks=tasks)

    def without(self, task: str, reason: str) -> Entry:
        """Return the entry with a task that the policy cannot play.

        Args:
            task: name of the task.
            reason: the reason.
        """
        return dataclasses.replace(self, refused={**self.refused, task: reason})

    def to_json(self) -> str:
        """Return the text of the file."""
        return json.dumps({"format": FORMAT, **dataclasses.asdict(self)}, indent=1) + "\n"

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the file in one step.

        Args:
            path: the file; its folder must exist.

        Returns:
            The path.
        """
        write_atomically(Path(path), self.to_json().encode())
        return Path(path)

    @staticmethod
    def from_values(values: Mapping[str, Any]) -> Entry:
        """Return an entry from the values of its file, which `problems` has checked.

        Args:
            values: the decoded JSON.
        """
        rest = {name: value for name, value in values.items() if name not in ("format", "tasks")}
        tasks = {task: tuple(Row(**row) for row in rows) for task, rows in values["tasks"].items()}
        return Entry(**rest, tasks=tasks)


def digest(policy: PolicyLike) -> str:
    """Return the SHA-256 of a policy file, or of the file of a module that has the policy.

    Other files that a module imports are not part of it. It is empty for policies of the package
    and for objects. A name that was registered stands for the file with its code.

    Args:
        policy: a policy, its name, its file, or "module:name", which is imported.

    Raises:
        FileNotFoundError: the policy file does not exist.
        ImportError: a "module:name" that does not exist.
    """
    path = None if isinstance(policy, Policy) else _file(os.fspath(policy))
    return "" if path is None else hashlib.sha256(path.read_bytes()).hexdigest()


def _file(policy: str) -> Path | None:
    """The file that has a policy; None for one of the package, and for code without a file."""
    name = policy.partition(":")[0]
    if is_module_text(policy):
        plugins.find("policy", policy)
        source = sys.modules[name].__file__
    elif is_registered(policy):
        source = source_of(name)
    else:
        return file_of(policy)
    return None if source is None or not os.path.isfile(source) else Path(source)
