"""Comparison of an entry with its matches, played again."""

from __future__ import annotations

import os
from typing import Final

from rsoccer._core import build_info
from rsoccer.benchmark.entry import Entry, Row, digest
from rsoccer.benchmark.machine import machine
from rsoccer.benchmark.measuring import measured
from rsoccer.benchmark.validation import is_current
from rsoccer.policies import file_of, is_module_text, is_registered
from rsoccer.policies.trained import BEST

_EXACT: Final = ("wins", "draws", "losses", "score", "low", "high")
_ROUNDING: Final = 1e-9
_Z2: Final = 1.96**2


def replayed(
    entry: Entry,
    task: str,
    threads: int | None = None,
    policy: str | os.PathLike[str] | None = None,
) -> list[str]:
    """Play the matches of a task again and compare the scores.

    Equal physics gives equal matches. A script of the package has to have the same counts, score
    and interval again on a machine of the same kind. The last bits of a network's actions, and of
    NumPy's functions, may differ between machines; else the score of the entry therefore has to lie
    in the interval of the matches that are played now. The interval in the file is not asked.

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
    exact = _is_exact(entry, played)
    differing = []
    for row in entry.tasks[task]:
        opponent = None if row.opponent == "-" else row.opponent
        again = measured(played, task, opponent, row.condition, entry.matches, threads)
        if (expected := _difference(row, again, exact)) is not None:
            place = f"{task}, opponent {row.opponent}, condition {row.condition}"
            differing.append(f"{place}: {expected}")
    return differing


def _is_exact(entry: Entry, policy: str) -> bool:
    """Whether each number has to be the same: a script, measured on a machine like this one."""
    if not is_registered(policy) or policy.partition(":")[0] == BEST:
        return False
    kinds = ({**found, "cores": 0} for found in (entry.machine, machine()))
    return next(kinds) == next(kinds)


def _difference(row: Row, again: Row, exact: bool) -> str | None:
    """Difference of a row from its new matches, in words; None if it may be of the same ones."""
    if exact:
        for name in _EXACT:
            expected, got = getattr(again, name), getattr(row, name)
            if abs(expected - got) > _ROUNDING:
                return f"expected {name} {expected:g} as played again, got {got:g}"
        return None
    low, high = again.low, again.high
    if high - low < _ROUNDING:
        # The bootstrap of equal values has no width; Wilson's interval of a share has this one.
        width = _Z2 / (again.matches + _Z2)
        low, high = low - width, high + width
    if low <= row.score <= high:
        return None
    return f"expected a score of {low:.3f} to {high:.3f} as played again, got {row.score:.3f}"


def _checked_policy(entry: Entry, policy: str | os.PathLike[str] | None) -> str:
    """The policy to play, if it is the one that was measured."""
    if policy is None and is_module_text(entry.policy):  # a file must not decide what runs
        raise ValueError(
            f"policy: expected it beside the entry, as the entry names code, {entry.policy}, which "
            "runs only if you name it too"
        )
    played = entry.policy if policy is None else os.fspath(policy)
    code = is_module_text(played) or is_module_text(entry.policy)
    if played != entry.policy and (code or not entry.digest):
        raise ValueError(f"policy: expected that of the entry, {entry.policy}, got {played}")
    path = None if code else file_of(played)
    if path is not None and not path.exists():
        raise FileNotFoundError(
            f"policy: expected the file that was measured, {played}, here, or its path, or the "
            "import of the module that registers this name"
        )
    if entry.digest != digest(played):
        raise ValueError(f"replay: {played} is not the file that was measured")
    return played
