"""Cycles among policies: A beats B, B beats C, and C beats A, so no rating can order them."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Sequence
from itertools import combinations

from rsoccer.arrays import Mask

Cycle = tuple[int, ...]
"""Indices of policies, of which each beats the next and the last beats the first."""


def in_words(found: Iterable[Sequence[str]]) -> str:
    """Return cycles as text: "a beats b beats c beats a; ...", or "none".

    Args:
        found: labels of the policies of each cycle.
    """
    return "; ".join(" beats ".join((*cycle, cycle[0])) for cycle in found) or "none"


def cycles(beats: Mask) -> list[Cycle]:
    """Return the cycles of three, and a shortest longer one for policies that are in none of them.

    Args:
        beats: (k, k) whether the row beats the column.

    Returns:
        Each cycle once, from its smallest index on; shorter ones first.
    """
    found: list[Cycle] = []
    for a, b, c in combinations(range(len(beats)), 3):
        found += [(a, *rest) for rest in ((b, c), (c, b)) if _is_cycle(beats, (a, *rest))]
    for start in range(len(beats)):
        if not any(start in cycle for cycle in found):
            cycle = _shortest(beats, start)
            found += [] if cycle is None else [cycle]
    return found


def _is_cycle(beats: Mask, policies: Cycle) -> bool:
    """Whether each policy beats the next."""
    following = (*policies[1:], policies[0])
    return all(beats[a, b] for a, b in zip(policies, following, strict=True))


def _shortest(beats: Mask, start: int) -> Cycle | None:
    """A shortest cycle through a policy, by breadth-first search."""
    paths: deque[Cycle] = deque([(start,)])
    reached: set[int] = set()
    while paths:
        path = paths.popleft()
        if beats[path[-1], start]:
            first = path.index(min(path))
            return path[first:] + path[:first]
        for index in range(len(beats)):
            if beats[path[-1], index] and index not in reached:
                reached.add(index)
                paths.append((*path, index))
    return None
