"""Result of `cooperation`, and its tables."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

from rsoccer.evaluate.html import html_table, paragraph
from rsoccer.evaluate.results import Interval
from rsoccer.evaluate.tables import Cells, align

_INTERVAL = "95% interval"


@dataclass(frozen=True)
class LineUp:
    """Results of a team, with one robot replaced or none."""

    replacement: str
    """policy in the place of one robot; "-" for none"""
    score: Interval
    """mean score of the team, by the task's success metric"""
    difference: Interval | None
    """mean difference of the score to that of the whole team from the same starts; None for it"""
    measures: dict[str, Interval]
    """play of the team: mean of each measure in a match, see
    `rsoccer.evaluate.team_play.TeamPlayRecorder`"""


@dataclass(frozen=True)
class CrossPlay:
    """Scores of teams, half of one policy and half of another."""

    policies: tuple[str, ...]
    """names or files of the policies, that of the evaluation first"""
    scores: tuple[tuple[Interval, ...], ...]
    """score of the team of the row's and the column's policy; on the diagonal of one policy"""
    gap: Interval
    """mean score of the mixed teams less that of the others, from the same starts"""


@dataclass(frozen=True)
class Cooperation:
    """Result of `rsoccer.cooperation`; `print` shows it."""

    policy: str
    """name or file of the policy, or its class"""
    opponent: str
    """policies of the other team, as `policy`; "-" if there is none"""
    task: str
    """name of the task"""
    seed: int
    """seed of the matches"""
    matches: int
    """matches of each line-up"""
    metric: str
    """metric whose mean is the score: the task's success, or "return" if it names none"""
    line_ups: tuple[LineUp, ...]
    """the whole team, and the team with each replacement"""
    cross_play: CrossPlay | None
    """scores of teams of two policies; None without partners"""

    def as_dict(self) -> dict[str, object]:
        """Return the fields as numbers, texts, lists and dictionaries, ready for JSON."""
        return dataclasses.asdict(self)

    def __str__(self) -> str:
        parts = [self._title(), *(align(rows, 1) for rows in self._tables())]
        return "\n\n".join([*parts, *self._gap()])

    def _repr_html_(self) -> str:
        """The tables of `print`, for notebooks."""
        tables = [html_table(rows, 1) for rows in self._tables()]
        return "".join(
            [paragraph(self._title()), *tables, *(paragraph(line) for line in self._gap())]
        )

    def _title(self) -> str:
        """Task, teams and number of matches."""
        return f"{self.task}: {self.policy} against {self.opponent}, {self.matches} matches each"

    def _tables(self) -> list[list[Cells]]:
        """Cells of all tables, a header first."""
        metric = self.metric.replace("_", " ")
        scores: list[Cells] = [("replaced by", metric, _INTERVAL, "difference", _INTERVAL)]
        measures: list[Cells] = [("replaced by", *_with_intervals(self.line_ups[0].measures))]
        for each in self.line_ups:
            difference = ("-", "-") if each.difference is None else _mean(each.difference, "+")
            scores.append((each.replacement, *_mean(each.score), *difference))
            cells = (cell for value in each.measures.values() for cell in _mean(value))
            measures.append((each.replacement, *cells))
        tables = [scores, measures]
        if self.cross_play is not None:
            tables.append(_cross_table(self.cross_play))
        return tables

    def _gap(self) -> list[str]:
        """Line of the difference between mixed teams and others."""
        if self.cross_play is None:
            return []
        mean, interval = _mean(self.cross_play.gap, "+")
        return [f"mixed teams less others: {mean}, {_INTERVAL} {interval}"]


def _cross_table(cross_play: CrossPlay) -> list[Cells]:
    """Cells of the scores of mixed teams."""
    numbers = [f"({number})" for number in range(1, len(cross_play.policies) + 1)]
    rows: list[Cells] = [("team of", *numbers)]
    named = zip(numbers, cross_play.policies, cross_play.scores, strict=True)
    for number, name, scores in named:
        rows.append((f"{number} {name}", *(" ".join(_mean(score)) for score in scores)))
    return rows


def _with_intervals(measures: dict[str, Interval]) -> list[str]:
    """Titles of the measures, each with that of its interval."""
    return [title for name in measures for title in (name, _INTERVAL)]


def _mean(interval: Interval, sign: str = "") -> Cells:
    """Cells of a mean and its interval, "-" without one."""
    mean = f"{interval.mean:{sign}.3f}"
    if interval.low is None or interval.high is None:
        return mean, "-"
    return mean, f"[{interval.low:{sign}.3f}, {interval.high:{sign}.3f}]"
