"""Numbers of a row that cannot be those of matches: counts, score, interval and times."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rsoccer.benchmark.entry import Row
from rsoccer.evaluate.results import N_RESAMPLES
from rsoccer.task import Task

_ROUNDING = 1e-9
Bounds = tuple[float, float]


def wrong_numbers(task: Task, row: Row) -> Iterator[str]:
    """Yield what is wrong with the numbers of a row, in words.

    Args:
        task: the task of the row, whose success is the row's metric.
        row: the row; its numbers are finite.
    """
    counts = (row.wins, row.draws, row.losses)
    if min(counts) < 0 or sum(counts) != row.matches or row.matches < 1:
        yield f"wins, draws, losses: expected {row.matches} in all, got {counts}"
        return
    if not row.low <= row.score <= row.high:
        yield f"score: expected low <= score <= high, got {row.low}, {row.score}, {row.high}"
    if task.success != "goal_score" and row.losses:
        yield f"losses: expected 0 as {task.success} is not negative, got {row.losses}"
    elif task.full_success == 1.0:
        yield from _of_results(task, row)
    else:
        yield from _of_sums(task, row)
    longest = task.max_steps * task.config.time_step
    if not 0.0 < row.seconds <= longest + _ROUNDING:
        yield f"seconds: expected a positive time up to {longest:g}, got {row.seconds}"
    if row.wall_clock < 0.0:
        yield f"wall_clock: expected a time of 0 or more, got {row.wall_clock}"


def _of_results(task: Task, row: Row) -> Iterator[str]:
    """Problems of a metric of 1, 0 or -1: the counts give the score, and bounds of its interval."""
    counts = (row.wins, row.draws, row.losses)
    score = (row.wins - row.losses) / row.matches
    if abs(row.score - score) > _ROUNDING:
        yield f"score: expected (wins - losses) / matches of {counts}, {score:g}, got {row.score}"
        return
    lows, highs = zip(*_intervals(task.two_sided, counts), strict=True)
    # Means of n matches are multiples of 1 / n, and the bounds of resamples vary by some of them.
    margin = 0.005 + 2.0 / row.matches
    for name, value, bounds in (("low", row.low, lows), ("high", row.high, highs)):
        low, high = min(bounds), max(bounds)
        if not low - margin <= value <= high + margin:
            near = f"{low:.3f}" if high - low < _ROUNDING else f"{low:.3f} to {high:.3f}"
            yield f"{name}: expected about {near}, as of {counts}, got {value}"


def _intervals(two_sided: bool, counts: tuple[int, int, int]) -> list[Bounds]:
    """The widest and the narrowest interval that matches of these results can have.

    An entry does not tell the results of each side. The bootstrap resamples both sides apart: its
    interval is widest if they are alike, and narrowest if one side has the better half of all.
    """
    found = [_interval([counts])]
    if two_sided:
        half = sum(counts) // 2
        wins = min(counts[0], half)
        draws = min(counts[1], half - wins)
        better = (wins, draws, half - wins - draws)
        worse = tuple(all_ - part for all_, part in zip(counts, better, strict=True))
        found.append(_interval([better, (worse[0], worse[1], worse[2])]))
    return found


def _interval(strata: list[tuple[int, int, int]]) -> Bounds:
    """The 95% bootstrap interval of the mean score of wins, draws and losses of each stratum."""
    rng = np.random.default_rng(0)
    sums = np.zeros(N_RESAMPLES)
    for counts in strata:
        n = sum(counts)
        drawn = rng.multinomial(n, np.array(counts) / n, size=N_RESAMPLES)
        sums += drawn[:, 0] - drawn[:, 2]
    low, high = np.quantile(sums / sum(map(sum, strata)), (0.025, 0.975)).tolist()
    return low, high


def _of_sums(task: Task, row: Row) -> Iterator[str]:
    """Problems of a metric that counts: each match that is won adds 1 up to the task's most."""
    full = float(task.max_steps) if task.full_success is None else task.full_success
    low, high = row.wins / row.matches, full * row.wins / row.matches
    if not low - _ROUNDING <= row.score <= high + _ROUNDING:
        yield f"score: expected {low:g} to {high:g} of {row.wins} matches won, got {row.score}"
    total = row.score * row.matches
    if abs(total - round(total)) > 1e-6:
        yield f"score: expected a whole number over {row.matches} matches, got {row.score}"
    if row.low < 0.0 or row.high > full:
        yield f"low, high: expected 0 to {full:g}, got {row.low}, {row.high}"
