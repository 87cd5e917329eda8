"""`rsoccer benchmark`: a policy by the protocol of the leaderboard, or the check of its file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from tyro.conf import Positional, arg

from rsoccer.benchmark import Entry, Row, read_entry, replayed, report, run_benchmark
from rsoccer.benchmark.protocol import MATCHES
from rsoccer.commands.imports import Imports
from rsoccer.commands.output import check_output, write
from rsoccer.commands.subject import check_policy_names

_POLICY = arg(
    metavar="POLICY",
    help="policy to measure: a name, a policy file, or module:name of code of your own",
    help_behavior_hint="",
)


@dataclass(frozen=True)
class Benchmark(Imports):
    """Measure a policy on all tasks by the protocol of the leaderboard, or check an entry of it."""

    policy: Annotated[str | None, Positional, _POLICY] = None
    """policy to measure"""
    task: Annotated[tuple[str, ...], arg(metavar="TASK", help_behavior_hint="(default: all)")] = ()
    """tasks to play"""
    out: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.json file to write after each row; an interrupted measurement goes on from it"""
    name: Annotated[str | None, arg(metavar="TEXT", help_behavior_hint="(default: POLICY)")] = None
    """name in the table"""
    description: str = ""
    """origin of the policy, in a sentence"""
    link: str = ""
    """address of its code or paper"""
    matches: int = MATCHES
    """matches of each row, half of them on each side in two-sided tasks"""
    robust: bool = True
    """play under all conditions of senses and variation, too"""
    threads: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(default: all)")] = None
    """threads of the simulator"""
    check: Annotated[Path | None, arg(metavar="PATH", help_behavior_hint="")] = None
    """.json file to check in place of a measurement"""
    replay: Annotated[str | None, arg(metavar="TASK", help_behavior_hint="")] = None
    """with --check, a task whose matches are played again to compare the scores; code runs only if
    POLICY names it, too"""

    def run(self) -> None:
        """Measure and print the table, or check a file.

        Raises:
            ValueError: neither a policy nor a file to check, or both without a task to replay; an
                invalid entry, one whose scores are others, or an option that is refused.
        """
        if self.policy is None and self.check is None:
            raise ValueError("policy: expected a policy, or --check with a file in its place")
        if self.policy is not None and self.check is not None and self.replay is None:
            raise ValueError(
                "replay: expected a task to play again, as --check with a policy does, got none; "
                "without the policy --check reads the file alone"
            )
        if self.check is not None:
            self._check(self.check)
            return
        if self.replay is not None:
            raise ValueError(f"replay: expected --check with it, got {self.replay} alone")
        check_output("out", self.out, ".json")
        check_policy_names([self.policy])
        begun = None
        if self.out is not None and self.out.exists():
            begun = read_entry(self.out, partial=True)
        entry = run_benchmark(
            str(self.policy),
            self.task or None,
            name=self.name,
            description=self.description,
            link=self.link,
            matches=self.matches,
            robust=self.robust,
            threads=self.threads,
            begun=begun,
            on_row=self._keep,
        )
        if self.out is not None:
            entry.save(self.out)
        write(report(entry))

    def _keep(self, entry: Entry, task: str, row: Row) -> None:
        """Write the file after a row, so that it is not played again."""
        if self.out is not None:
            entry.save(self.out)

    def _check(self, path: Path) -> None:
        """Check a file, and play a task of it again."""
        entry = read_entry(path)
        if self.replay is not None:
            check_policy_names([self.policy])
            if found := replayed(entry, self.replay, self.threads, self.policy):
                raise ValueError("; ".join(found))
        rows = sum(map(len, entry.tasks.values()))
        write(f"{path}: valid, {rows} rows of {len(entry.tasks)} tasks")
