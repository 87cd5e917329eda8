"""What an evaluation found: means of matches, and how sure they are."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rsoccer.evaluate.episodes import Doubles

RESAMPLES = 10_000  # of the bootstrap; an interval's ends then repeat to about 0.005
DRAWN_AT_ONCE = 2**20  # numbers, so that many matches need no more memory than few


@dataclass(frozen=True)
class Interval:
    """A mean, and where the true one is 19 times in 20."""

    mean: float
    low: float  # lower end of the 95% bootstrap interval
    high: float  # its upper end; both equal the mean where all matches ended alike


@dataclass(frozen=True)
class Results:
    """How some matches ended, by the task's success: above 0 is won, below 0 lost."""

    matches: int
    wins: int
    draws: int
    losses: int
    score: float  # mean success: of goal scores (wins - losses) / matches, from -1 to 1
    low: float  # ends of its 95% interval, as in `Interval`
    high: float


@dataclass(frozen=True)
class Evaluation(Results):
    """What `evaluate` found; `print` it, or put several into one `table`."""

    policy: str
    opponent: str  # who drives the other team; "-" where there is none
    task: str
    seed: int
    metric: str  # what the score is the mean of: the task's success, or "return" if it names none
    sides: dict[str, Results]  # by the colour it played, where it played both; else empty
    returns: Interval  # rewards of an episode, a mean over the robots that the policy drives
    seconds: Interval  # how long an episode lasted
    # Mean seconds of matches with a goal of either team, or else with full success; None if none.
    decided_after: float | None

    def as_dict(self) -> dict[str, object]:
        """Numbers, texts and dictionaries, ready for JSON."""
        return dataclasses.asdict(self)

    def __str__(self) -> str:
        from rsoccer.evaluate.tables import table

        return table([self])


def results(strata: Sequence[Doubles], chance: np.random.Generator) -> Results:
    """Count scores, each side's in an array of its own."""
    scores = np.concatenate(strata)
    counts = (int((np.sign(scores) == sign).sum()) for sign in (1, 0, -1))
    return Results(len(scores), *counts, *vars(estimated(strata, chance)).values())


def estimated(strata: Sequence[Doubles], chance: np.random.Generator) -> Interval:
    """Mean of all values, resampled with replacement, each side among its own matches."""
    total = sum(map(len, strata))
    sums = np.zeros(RESAMPLES)
    for part in strata:
        rows = max(1, DRAWN_AT_ONCE // len(part))
        for first in range(0, RESAMPLES, rows):
            size = (min(rows, RESAMPLES - first), len(part))
            sums[first : first + rows] += part[chance.integers(len(part), size=size)].sum(axis=1)
    low, high = np.quantile(sums / total, (0.025, 0.975)).tolist()
    return Interval(float(np.concatenate(strata).sum()) / total, low, high)
