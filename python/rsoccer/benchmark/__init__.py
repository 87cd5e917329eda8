"""Benchmark: one protocol for policies of all origins, and files that others can compare with.

`run_benchmark` measures a policy on the tasks of the study of learning, against the same opponents
and from the same initial states, on the true state and under the conditions of the study of
robustness. Its result is an `Entry`: one JSON file with scores, intervals, machine and versions.
The leaderboard of the documentation consists of such files.
"""

from rsoccer.benchmark.conditions import CONDITIONS, Condition
from rsoccer.benchmark.entry import Entry, Row
from rsoccer.benchmark.measuring import run_benchmark
from rsoccer.benchmark.protocol import MATCHES, SEED, TASKS, opponents_of, rows_of
from rsoccer.benchmark.replaying import replayed
from rsoccer.benchmark.table import report
from rsoccer.benchmark.validation import EntryError, is_current, problems, read_entry

__all__ = ["CONDITIONS", "MATCHES", "SEED", "TASKS", "Condition", "Entry", "EntryError", "Row"]
__all__ += ["is_current", "opponents_of", "problems", "read_entry", "replayed", "report"]
__all__ += ["rows_of", "run_benchmark"]
