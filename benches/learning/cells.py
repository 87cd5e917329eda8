"""Cells of the report's tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from benches.learning.collection import Collected
from benches.learning.curves import value_at
from benches.learning.evaluation import OFFICIAL
from benches.learning.statistics import Estimate, comparison
from benches.learning.targets import FULL_SUCCESS, TARGETS

STALE_MARK: Final = "\\*"


def name_of(part: Collected, text: str) -> str:
    """Return the name of a task in a cell, with a mark for stale results."""
    task = part.experiment.task
    return text.replace(task, f"`{task}`", 1) + (STALE_MARK if part.stale else "")


def against(opponent: str) -> str:
    """Return the opponent of a row; empty for the task's own."""
    if opponent == "-":
        return ""
    if opponent.startswith("@"):
        return f"policy of {opponent.removeprefix('@ppo/')}"
    return "the official scenarios" if opponent == OFFICIAL else f"`{opponent}`"


def with_interval(part: Collected | None) -> str:
    """Return the score with its interval, or a dash without results."""
    if part is None:
        return "-"
    estimate = part.estimate()
    return f"{number(estimate.value)} ({interval(estimate)})"


def better(part: Collected, reference: Collected, opponent: str | None = None) -> str:
    """Return the probability that a run of the first is better; empty for a single seed."""
    opponent = opponent or part.opponents[0]
    return probability(comparison(part.scores(opponent), reference.scores(opponent)))


def probability(estimate: Estimate | None) -> str:
    """Return a probability with its interval; empty without one."""
    if estimate is None:
        return ""
    return f"{estimate.value:.2f} ({estimate.low:.2f} to {estimate.high:.2f})"


def on_curve(part: Collected, samples: float) -> str:
    """Return the mean of the learning curves after some samples."""
    values = [value_at(result["curve"], samples) for result in part.results]
    known = [value for value in values if value is not None]
    return number(sum(known) / len(known)) if known else ""


def target(part: Collected, opponent: str) -> str:
    """Return the target, and whether the lower end of the interval reaches it."""
    task = part.experiment.task
    if task in FULL_SUCCESS:
        estimate, share = part.full_success(), FULL_SUCCESS[task]
        return f"full success {number(share)} {_met(estimate, share)}"
    if (task, opponent) not in TARGETS:
        return ""
    score = TARGETS[task, opponent]
    return f"{number(score)} {_met(part.estimate(opponent), score)}"


def _met(estimate: Estimate, target: float) -> str:
    return "met" if estimate.low >= target else "missed"


def outcomes(part: Collected, opponent: str) -> str:
    """Return the shares of matches won, drawn and lost, of all seeds; or that of full success."""
    if part.experiment.task in FULL_SUCCESS:
        estimate = part.full_success()
        return f"full success {number(estimate.value)}, {interval(estimate)}"
    rows = part.rows(opponent)
    if not rows[0]["sides"]:
        return ""
    total = sum(row["matches"] for row in rows)
    names = ("wins", "draws", "losses", "own_goals")
    *counts, own = (sum(row[name] for row in rows) / total for name in names)
    return f"{', '.join(f'{share:.1%}' for share in counts)} ({own:.1%}){_passes(rows)}"


def _passes(rows: Sequence[Mapping[str, Any]]) -> str:
    """Passes per match of all seeds, with a comma before; empty where none are counted."""
    passes = [row["metrics"]["own_passes"] for row in rows if "own_passes" in row["metrics"]]
    return f", {number(sum(passes) / len(passes))} passes" if passes else ""


def time_to_success(part: Collected, opponent: str) -> str:
    """Return the mean time of decided matches; empty without any."""
    times = [row["seconds_to_decision"] for row in part.rows(opponent)]
    known = [float(seconds) for seconds in times if seconds is not None]
    return f"{sum(known) / len(known):.1f} s" if known else ""


def seeds_of(part: Collected | None) -> str:
    """Return the score of every seed; empty without results."""
    return "" if part is None else seeds(part.scores())


def seeds(scores: Sequence[float]) -> str:
    """Return scores, one after the other."""
    return " ".join(number(score) for score in scores)


def interval(estimate: Estimate) -> str:
    """Return the bounds of an interval."""
    if estimate.runs == 1:
        return "one seed"
    return f"{number(estimate.low)} to {number(estimate.high)}"


def number(value: float) -> str:
    """Return a score with three digits, without the zero before the point."""
    if abs(value) >= 1.5:
        return f"{value:.2f}"
    text = f"{value:.3f}"
    return text.replace("0.", ".", 1) if abs(value) < 1.0 and float(text) != 1.0 else text


def millions(value: float) -> str:
    """Return a number in millions."""
    return f"{value / 1e6:.3g} M"


def minutes(seconds: float) -> str:
    """Return a time in minutes, or in seconds if it is short."""
    return f"{seconds / 60.0:.0f} min" if seconds >= 60.0 else f"{seconds:.0f} s"
