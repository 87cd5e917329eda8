"""Protocol of the benchmark: tasks, opponents, initial states and numbers of matches."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

from rsoccer.benchmark.conditions import CONDITIONS, TRUTH
from rsoccer.registry import make_task

MATCHES: Final = 200
"""Matches of a row, half of them on each side in two-sided tasks."""
SEED: Final = 31
"""Seed of the initial states, as in the study of learning. `rsoccer.evaluate` hashes it, so no
training meets the same matches."""
TASKS: Final = (
    *("VSS-v0", "VSSMulti-v0", "VSSSelfPlay-v0", "SSLGoToBall-v0", "SSLPassEndurance-v1"),
    *("SSLContestedPossession-v0", "SSLStaticDefenders-v0", "SSLDribbling-v0"),
    *("SSLPassEnduranceMulti-v1", "SSLSelfPlay-v0"),
)
"""Tasks of the benchmark, in the order of the tables."""
VSSS: Final = ("ou", "zero", "chase", "scripted")
"""Opponents in two-sided tasks of the VSSS league; the first one is met under all conditions."""
SSL: Final = ("ou", "zero", "strike")
"""Opponents in two-sided tasks of the SSL league; the first one is met under all conditions."""


def opponents_of(task: str) -> tuple[str | None, ...]:
    """Return the opponents of a task's policies; None is the task's own.

    Args:
        task: a registered task.
    """
    if not make_task(task).two_sided:
        return (None,)
    return VSSS if task.startswith("VSS") else SSL


def rows_of(task: str, robust: bool) -> list[tuple[str | None, str]]:
    """Return what a policy plays in a task: opponents, and names of conditions.

    Args:
        task: a registered task.
        robust: whether the first opponent is met under all conditions, too.
    """
    opponents = opponents_of(task)
    others: Iterable[str] = (name for name in CONDITIONS if name != TRUTH) if robust else ()
    plain = [(opponent, TRUTH) for opponent in opponents]
    return [*plain, *((opponents[0], condition) for condition in others)]
