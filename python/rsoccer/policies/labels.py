"""Identity of policies, and their short names for tables, logs and plots."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Iterable
from itertools import count
from pathlib import Path

from rsoccer.policies import Policy, PolicyLike, is_registered, name_of
from rsoccer.policies.policy_file import ONNX_SUFFIX, SUFFIX, SUFFIXES

GENERIC = "policy"
"""Name of the policy file in every run's folder, which the folder's name replaces."""


def labels(policies: Iterable[PolicyLike], reserved: Collection[str] = ()) -> list[str]:
    """Return a short name for each policy, different from all others.

    Example:
        >>> labels(["ou", "out/mine/policy.safetensors", "best/vss.safetensors:mean"])
        ['ou', 'mine', 'vss:mean']

    Args:
        policies: policies, names or paths of files. A script keeps its name. A file has its own
            name, or that of its folder if it is `policy.safetensors`. It keeps its whole path if
            another policy has the same name, or if the name is reserved or that of a policy of the
            package, whether that one is there or not. Equal names that remain get numbers.
        reserved: further names that no file gets.
    """
    policies = list(policies)
    names = [name_of(policy) for policy in policies]
    given = Counter(name_of(policy) for policy in policies if is_registered(policy))
    short = [_short(name) for name in names]
    used = Counter(short)
    short = [
        text if _is_free(text, used, reserved) else name
        for text, name in zip(short, names, strict=True)
    ]
    used = Counter(short)
    for index, (policy, text) in enumerate(zip(policies, short, strict=True)):
        unique = given[text] == 1 if is_registered(policy) else _is_free(text, used, reserved)
        if not unique:
            numbered = (f"{text} {number}" for number in count(1))
            short[index] = next(name for name in numbered if name not in short)
    return short


def identity(policy: PolicyLike) -> object:
    """Return a key that is equal for the same object, the same name, and paths of the same file.

    Args:
        policy: a policy, its name or its file.
    """
    if isinstance(policy, Policy):
        return id(policy)
    text = os.fspath(policy)
    return os.path.realpath(text) if any(end in text for end in SUFFIXES) else text


def _is_free(label: str, used: Counter[str], reserved: Collection[str]) -> bool:
    """Whether one policy alone has the label, which is no name of a policy."""
    return used[label] == 1 and label not in reserved and not is_registered(label)


def _short(name: str) -> str:
    """Short name of one policy."""
    path, ending, mode = name.partition(SUFFIX if SUFFIX in name else ONNX_SUFFIX)
    if not ending:
        return name
    stem = os.path.basename(path)
    if stem == GENERIC:
        stem = Path(path).parent.name or stem
    return stem + mode
