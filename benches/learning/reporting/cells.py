"""Cells of the report's tables."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from benches.learning.opponents import OFFICIAL
from benches.learning.reporting.collection import Collected
from benches.learning.reporting.curves import seconds_to, value_at
from benches.learning.reporting.statistics import Estimate, probability_of_improvement
from benches.learning.reporting.targets import FULL_SUCCESS, PASSES, TARGETS

STALE_MARK: Final = "\\*"


def mark(part: Collected) -> str:
    """Return the mark of stale results; empty for current ones."""
    return STALE_MARK if part.stale else ""


def against_first(part: Collected) -> str:
    """Return words for the first opponent, with a space before; empty for the task's own."""
    opponent = against(part.opponents[0])
    return opponent and f" against {opponent}"


def against(opponent: str) -> str:
    """Return the opponent of a row; empty for the task's own."""
    if opponent == "-":
        return ""
    if opponent.startswith("@"):
        return f"policy of {opponent.removeprefix('@ppo/')}"
    return "the official scenarios" if opponent == OFFICIAL else f"`{opponent}`"


def with_interval(part: Collected | None) -> str:
    """Return the score with its interval and the mark of stale results; a dash without results."""
    if part is None:
        return "-"
    estimate = part.estimate()
    return f"{number(estimate.value)}{mark(part)} ({interval(estimate)})"


def lowest_other(part: Collected) -> str:
    """Return the lowest score against other opponents than the first; empty without any."""
    others = part.opponents[1:]
    if not others:
        return ""
    value, opponent = min((part.estimate(name).value, name) for name in others)
    return f"{number(value)} {'in' if opponent == OFFICIAL else 'against'} {against(opponent)}"


def better(part: Collected, reference: Collected, opponent: str | None = None) -> str:
    """Return the probability that a run of the first is better; empty for a single seed."""
    opponent = opponent or part.opponents[0]
    return probability(
        probability_of_improvement(part.scores(opponent), reference.scores(opponent))
    )


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
    """Return the targets, and whether the interval reaches them."""
    task = part.experiment.task
    if task in FULL_SUCCESS:
        share = FULL_SUCCESS[task]
        return f"full success in {number(share)} {_met(part, part.full_success(), share)}"
    found = []
    if (task, opponent) in TARGETS:
        score = TARGETS[task, opponent]
        found.append(f"{number(score)} {_met(part, part.estimate(opponent), score)}")
    if (task, opponent) in PASSES:
        passes = PASSES[task, opponent]
        made = part.metric("own_passes", opponent)
        found.append(f"{number(passes)} passes {_met(part, made, passes)}")
    return ", ".join(found)


def time_to_target(part: Collected, opponent: str) -> str:
    """Return when the mean learning curve reaches the target; empty without either."""
    goal = TARGETS.get((part.experiment.task, opponent))
    if goal is None:
        return ""
    ladders = [result.get("ladder", {}) for result in part.results]
    own = [result["curve"] for result in part.results] if opponent == "-" else []
    curves = own or [ladder[opponent] for ladder in ladders if opponent in ladder]
    if not curves:
        return ""
    seconds = seconds_to(curves, goal)
    return "not reached" if seconds is None else minutes(seconds)


def _met(part: Collected, estimate: Estimate, target: float) -> str:
    """Verdict on a target, which is provisional as long as seeds are missing."""
    if estimate.low >= target:
        verdict = "met"
    else:
        verdict = "not shown" if estimate.high >= target else "missed"
    return f"{verdict} so far" if part.missing or part.stale else verdict


def measure(part: Collected) -> str:
    """Return what the scores of a task measure."""
    return str(part.rows()[0]["metric"]).replace("_", " ")


def outcomes(part: Collected, opponent: str) -> str:
    """Return the shares of matches won, drawn and lost, of all seeds; empty for one-sided tasks."""
    rows = part.rows(opponent)
    if not rows[0]["sides"]:
        return ""
    total = sum(row["matches"] for row in rows)
    names = ("wins", "draws", "losses", "own_goals")
    *counts, own = (sum(row[name] for row in rows) / total for name in names)
    return f"{', '.join(f'{share:.1%}' for share in counts)} ({own:.1%})"


def second_measure(part: Collected, opponent: str) -> str:
    """Return the share of full success or the passes per match of tasks that have them."""
    if part.experiment.task in FULL_SUCCESS:
        estimate = part.full_success()
        return f"full success {number(estimate.value)}, {interval(estimate)}"
    if "own_passes" in part.rows(opponent)[0]["metrics"]:
        return f"{number(part.metric('own_passes', opponent).value)} passes per match"
    return ""


def time_to_decision(part: Collected, opponent: str) -> str:
    """Return the mean time of the matches that a goal or the task's success ended."""
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
