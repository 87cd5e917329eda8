"""Result of an evaluation, and several of them as text tables."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import groupby

from rsoccer.evaluate.html import html_table, paragraph
from rsoccer.evaluate.results import Interval, Results
from rsoccer.evaluate.tables import Cells, align

_INTERVAL = "95% interval"


@dataclass(frozen=True)
class Evaluation(Results):
    """Result of `evaluate`; `print` shows it, and `table` compares several."""

    policy: str
    """name or file of the policy, or its class"""
    opponent: str
    """policies of the other team, as `policy`; "-" if there is none"""
    task: str
    """name of the task"""
    seed: int
    """seed of the evaluation"""
    metric: str
    """metric whose mean is the score: the task's success, or "return" if it names none"""
    sides: dict[str, Results]
    """results by the team that the policy played for, "blue" and "yellow"; empty if one-sided"""
    returns: Interval
    """undiscounted return of an episode, a mean over the policy's robots"""
    seconds: Interval
    """duration of an episode"""
    seconds_to_decision: float | None
    """mean time to the first goal of either team (two-sided tasks) or to full success, s; None if
    there was none"""
    decided: int
    """number of episodes with such a goal or success"""
    own_goals: int
    """goals against the policy's team after a last touch by one of its own robots"""
    metrics: dict[str, float]
    """mean per episode of each other metric of the task, by name; in two-sided tasks metrics of
    blue and yellow, such as `blue_passes`, are `own_passes` and `opponent_passes`"""
    goal_rates: dict[str, Interval]
    """goals in 10 minutes with the ball in play, of the policy's team ("own") and against it
    ("opponent"); empty for tasks without the metrics `blue_goals`, `yellow_goals` and `in_play`"""

    def as_dict(self) -> dict[str, object]:
        """Return the fields as numbers, texts and dictionaries, ready for JSON."""
        return dataclasses.asdict(self)

    def __str__(self) -> str:
        return table([self])

    def _repr_html_(self) -> str:
        """The tables of `print`, for notebooks."""
        return paragraph(self.task) + "".join(html_table(rows, 2) for rows in _tables([self]))


def table(evaluations: Iterable[Evaluation]) -> str:
    """Return evaluations as lines of text: a header, one line each, aligned columns.

    Metrics of both teams follow in a table of their own, those of the policy's team first.
    Intervals of fewer than 10 matches a side are left out.

    Args:
        evaluations: the rows, in order. Consecutive ones of the same metrics share a table.

    Returns:
        The tables, separated by an empty line.
    """
    return "\n\n".join(align(rows, 2) for rows in _tables(evaluations))


def _tables(evaluations: Iterable[Evaluation]) -> list[list[Cells]]:
    """Cells of all tables, a header first."""
    tables = []
    for header, group in groupby(evaluations, _header):
        rows = list(group)
        tables.append([header, *map(_row, rows)])
        if _of_teams(rows[0]):
            tables.append([_team_header(rows[0]), *map(_team_row, rows)])
    return tables


def _header(evaluation: Evaluation) -> Cells:
    """Column titles: of a two-sided task if the evaluation has sides."""
    metric = evaluation.metric.replace("_", " ")
    first = ("policy", "opponent", "matches")
    others = [name.replace("_", " ") for name in _of_matches(evaluation)]
    if evaluation.sides:
        counts = ("won", "drawn", "lost")
        named = (metric, _INTERVAL, "as blue", "as yellow", "goal after")
        return (*first, *counts, *named, *others)
    means = (title for name in (metric, "return", "seconds") for title in (name, _INTERVAL))
    return (*first, *means, "done after", *others)


def _row(evaluation: Evaluation) -> Cells:
    """Cells of an evaluation below its header."""
    after = evaluation.seconds_to_decision
    last = "-" if after is None else f"{after:.1f} s"
    first = (evaluation.policy, evaluation.opponent, str(evaluation.matches))
    others = [f"{evaluation.metrics[name]:.2f}" for name in _of_matches(evaluation)]
    score = Interval(evaluation.score, evaluation.low, evaluation.high)
    if not evaluation.sides:
        means = (score, evaluation.returns, evaluation.seconds)
        signs = ("", "+", "")
        cells = (_mean(mean, sign) for mean, sign in zip(means, signs, strict=True))
        return (*first, *(cell for pair in cells for cell in pair), last, *others)
    counts = (evaluation.wins, evaluation.draws, evaluation.losses)
    sides = (_score(evaluation.sides[side]) for side in ("blue", "yellow"))
    return (*first, *map(str, counts), *_mean(score, "+"), *sides, last, *others)


def _of_teams(evaluation: Evaluation) -> list[str]:
    """Names of the metrics that each team has, without the team."""
    names = [name.removeprefix("own_") for name in evaluation.metrics if name.startswith("own_")]
    return [name for name in names if f"opponent_{name}" in evaluation.metrics]


def _of_matches(evaluation: Evaluation) -> list[str]:
    """Names of the other metrics."""
    pairs = {f"{team}_{name}" for name in _of_teams(evaluation) for team in ("own", "opponent")}
    return [name for name in evaluation.metrics if name not in pairs]


def _team_header(evaluation: Evaluation) -> Cells:
    """Column titles of the table of both teams."""
    rates = ("goals in 10 min", _INTERVAL, "against", _INTERVAL) if evaluation.goal_rates else ()
    names = (name.replace("_", " ") for name in _of_teams(evaluation))
    return ("policy", "opponent", *rates, *names)


def _team_row(evaluation: Evaluation) -> Cells:
    """Cells of an evaluation in the table of both teams."""
    metrics = evaluation.metrics
    rates = (cell for rate in evaluation.goal_rates.values() for cell in _mean(rate, ""))
    pairs = (
        f"{metrics[f'own_{name}']:.2f} : {metrics[f'opponent_{name}']:.2f}"
        for name in _of_teams(evaluation)
    )
    return (evaluation.policy, evaluation.opponent, *rates, *pairs)


def _mean(interval: Interval, sign: str) -> Cells:
    """Cells of a mean and its interval, "-" without one: three decimals below 10, else two."""
    style = f"{sign}.{3 if abs(interval.mean) < 10.0 else 2}f"
    mean = f"{interval.mean:{style}}"
    if interval.low is None or interval.high is None:
        return mean, "-"
    return mean, f"[{interval.low:{style}}, {interval.high:{style}}]"


def _score(results: Results) -> str:
    """Cell of the mean score of one side."""
    return f"{results.score:+.3f}"
