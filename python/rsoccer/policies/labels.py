"""Short names of policies for tables, logs and plots."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

from rsoccer.policies import PolicyLike, name_of
from rsoccer.policies.policy_file import SUFFIX

GENERIC = "policy"
"""Name of the policy file in every run's folder, which the folder's name replaces."""


def labels(policies: Iterable[PolicyLike]) -> list[str]:
    """Return a short name for each policy, different from all others.

    Example:
        >>> labels(["ou", "out/mine/policy.safetensors", "best/vss.safetensors:mean"])
        ['ou', 'mine', 'vss:mean']

    Args:
        policies: policies, names or paths of files. A script keeps its name. A file has its own
            name, or that of its folder if it is `policy.safetensors`; files whose names are then
            equal keep their whole path. Equal names that remain get numbers.
    """
    names = [name_of(policy) for policy in policies]
    short = _where_unique([_short(name) for name in names], names)
    return [
        name if short.count(name) == 1 else f"{name} {short[: index + 1].count(name)}"
        for index, name in enumerate(short)
    ]


def _where_unique(short: list[str], names: list[str]) -> list[str]:
    """The short name where no other policy has it, else the whole one."""
    counts = Counter(short)
    return [a if counts[a] == 1 else b for a, b in zip(short, names, strict=True)]


def _short(name: str) -> str:
    """Short name of one policy."""
    path, ending, mode = name.partition(SUFFIX)
    if not ending:
        return name
    stem = os.path.basename(path)
    if stem == GENERIC:
        stem = Path(path).parent.name or stem
    return stem + mode
