"""Comparison of an entry with its matches, played again."""

from __future__ import annotations

import os

from rsoccer._core import build_info
from rsoccer.benchmark.entry import Entry, digest
from rsoccer.benchmark.measuring import measured
from rsoccer.benchmark.validation import is_current
from rsoccer.policies import is_module_text


def replayed(
    entry: Entry,
    task: str,
    threads: int | None = None,
    policy: str | os.PathLike[str] | None = None,
) -> list[str]:
    """Play the matches of a task again and compare the scores.

    Equal physics gives equal matches, but the last bits of a network's actions may differ between
    machines. A score that lies in the interval of the row is therefore taken as the same.

    Args:
        entry: a valid entry.
        task: name of a task that it has rows of.
        threads: threads of the simulator; by default one per available processor.
        policy: the policy that is played: the entry's own, or the same file at another path. By
            default that of the entry, unless it is code: an entry must not decide what runs.

    Returns:
        The rows whose score is another one, in words.

    Raises:
        ValueError: the entry has no rows of the task, is of another version of the physics, of
            another policy or another content of the policy file, or its policy is code that
            `policy` does not name.
        FileNotFoundError: the policy is a file that is not here.
        ImportError: the policy is code that is not here.
    """
    if task not in entry.tasks:
        raise ValueError(f"replay: expected one of {list(entry.tasks)}, got {task!r}")
    physics = int(build_info()["physics"])
    if not is_current(entry):
        raise ValueError(f"replay: expected physics {physics}, got {entry.versions['physics']}")
    played = _checked_policy(entry, policy)
    differing = []
    for row in entry.tasks[task]:
        opponent = None if row.opponent == "-" else row.opponent
        again = measured(played, task, opponent, row.condition, entry.matches, threads)
        if not row.low <= again.score <= row.high:
            differing.append(
                f"{task}, opponent {row.opponent}, condition {row.condition}: expected a score of "
                f"{row.low:.3f} to {row.high:.3f}, got {again.score:.3f}"
            )
    return differing


def _checked_policy(entry: Entry, policy: str | os.PathLike[str] | None) -> str:
    """The policy to play, if it is the one that was measured."""
    if policy is None and is_module_text(entry.policy):  # a file must not decide what runs
        raise ValueError(
            f"policy: expected it beside the entry, as the entry names code, {entry.policy}, which "
            "runs only if you name it too"
        )
    played = entry.policy if policy is None else os.fspath(policy)
    if played != entry.policy and (is_module_text(played) or not entry.digest):
        raise ValueError(f"policy: expected that of the entry, {entry.policy}, got {played}")
    if entry.digest != digest(played):
        raise ValueError(f"replay: {played} is not the file that was measured")
    return played
