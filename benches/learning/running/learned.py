"""Outcome of the learning of one run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from rsoccer.policies import PolicyLike


@dataclass(frozen=True)
class Learned:
    """A policy, and its learning."""

    policies: dict[str, PolicyLike]
    """Policy by mode, "sample" or "mean"; the first mode is the policy's own."""
    samples: int
    """Decisions of single robots that were learned from."""
    curve: dict[str, Any]
    """Learning curve: name of the metric, and lists `samples`, `seconds` and `values`."""
    extra: dict[str, Any]
    """More numbers for the result."""
