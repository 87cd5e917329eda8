"""The order of the algorithms in the paper's figure, beside that of this study."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from benches.learning.reporting import cells
from benches.learning.reporting.collection import Collected, find
from benches.learning.reporting.curves import mean_between
from benches.learning.reporting.statistics import Estimate, probability_of_improvement
from benches.markdown import table

Scores = Callable[[Collected, Collected], tuple[list[float], list[float]]]
"""Scores of the seeds of two experiments that a claim compares."""


def _while_learning(first: Collected, second: Collected) -> tuple[list[float], list[float]]:
    """Means of the learning curves over the samples for which all runs of both have points."""
    curves = [[result["curve"] for result in part.results] for part in (first, second)]
    start = max(curve["samples"][0] for part in curves for curve in part)
    end = min(curve["samples"][-1] for part in curves for curve in part)
    means = [[mean_between(curve, start, end) for curve in part] for part in curves]
    return means[0], means[1]


def _in_the_end(first: Collected, second: Collected) -> tuple[list[float], list[float]]:
    """Scores of the final evaluation."""
    return first.scores(), second.scores()


@dataclass(frozen=True)
class Claim:
    """Statement of the paper about two algorithms on some tasks."""

    text: str
    better: str
    """Name of an algorithm, in keys of experiments."""
    worse: str
    tasks: tuple[str, ...]
    scores: Scores


_VSSS: Final = ("VSS-v0", "VSSMulti-v0")
_CURVES: Final = ("SSLGoToBall-v0", "SSLDribbling-v0", "SSLContestedPossession-v0")

CLAIMS: Final = (
    Claim(
        "DDPG is ahead of SAC at equal samples", "ddpg", "sac", (*_VSSS, *_CURVES), _while_learning
    ),
    Claim(
        "SAC is ahead of DDPG in the end",
        *("sac", "ddpg"),
        ("SSLGoToBall-v0", "SSLStaticDefenders-v0"),
        _in_the_end,
    ),
    Claim("DDPG is ahead of PPO in the end", "ddpg", "ppo", _VSSS, _in_the_end),
)
"""Section "Results" of the rSoccer paper (2021), whose runs had 10 to 20 M samples."""
MIN_SEEDS: Final = 3
"""Least seeds of each side for a verdict. Of two against two, one order in three separates them
completely by chance; of three against three, one in ten."""


def order(collected: Sequence[Collected]) -> str:
    """Return the table of the claims, with a row for each task that has results; else ""."""
    header = (
        *("task", "the paper", "mean of the first", "of the second"),
        *("P(first better)", "here"),
    )
    rows = [
        row
        for claim in CLAIMS
        for task in claim.tasks
        if (row := _row(claim, task, collected)) is not None
    ]
    return table(header, rows) if rows else ""


def _row(claim: Claim, task: str, collected: Sequence[Collected]) -> tuple[str, ...] | None:
    """Cells of a claim about a task; None without results of both algorithms."""
    first, second = (find(collected, task, name) for name in (claim.better, claim.worse))
    if first is None or second is None:
        return None
    scores = claim.scores(first, second)
    means = (cells.number(sum(part) / len(part)) for part in scores)
    estimate = probability_of_improvement(*scores)
    enough = min(map(len, scores)) >= MIN_SEEDS and not (first.stale or second.stale)
    name = f"`{task}`{cells.mark(first) or cells.mark(second)}"
    verdict = _verdict(estimate) if estimate is not None and enough else "too few seeds"
    return name, claim.text, *means, cells.probability(estimate), verdict


def _verdict(estimate: Estimate) -> str:
    """Agreement of the seeds with the claim; open where the interval contains even odds."""
    if estimate.low > 0.5:
        return "agrees"
    return "the reverse" if estimate.high < 0.5 else "open"
