"""Tables of the study of robustness: scores of policies under each condition."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from benches.learning.reporting import cells
from benches.learning.reporting.collection import Collected, Result, finished
from benches.learning.reporting.statistics import Estimate, iqm
from benches.learning.robust import GROUP, SHIPPED_GROUP, VARIANTS
from benches.markdown import table
from rsoccer.benchmark.conditions import CONDITIONS

Studied = Sequence[Collected]
TRUTH = "truth"
HEADLINE = ("rc2021", "rc2021-100ms", "commands-100ms")
"""Conditions whose scores are compared with those on the true state."""


def shipped(collected: Studied) -> str:
    """Return the comparison of `best` and `best:robust`: a row for each task; empty without."""
    by_name = {part.experiment.name: part for part in finished(collected, SHIPPED_GROUP)}
    rows = []
    for task in dict.fromkeys(part.experiment.task for part in by_name.values()):
        best, robust = by_name.get(f"{task}-best"), by_name.get(f"{task}-best-robust")
        if best is None:
            continue
        base = estimate(best, TRUTH)
        pairs = [
            cell
            for name in HEADLINE
            for cell in (_cell(best, name), _with_share(robust, name, base))
        ]
        truth = (_cell(best, TRUTH), _cell(robust, TRUTH))
        measure = str(_rows(best, TRUTH)[0]["metric"]).replace("_", " ")
        rows.append((f"`{task}`", measure, *truth, *pairs))
    columns = [f"{kind}, {CONDITIONS[name].text}" for name in HEADLINE for kind in KINDS]
    header = ("task", "measure", *(f"{kind}, true state" for kind in KINDS), *columns)
    return table(header, rows) if rows else ""


KINDS = ("`best`", "`best:robust`")


def conditions(collected: Studied) -> str:
    """Return a table for each task: a row for each condition, a column for each policy."""
    parts = [*finished(collected, SHIPPED_GROUP), *finished(collected, GROUP)]
    texts = []
    for task in dict.fromkeys(part.experiment.task for part in parts):
        own = {_variant(part): part for part in parts if part.experiment.task == task}
        chosen = [own[name] for name in VARIANTS if name in own]
        header = ("condition", *(_title(part) for part in chosen))
        rows = [
            (condition.text, *(_cell(part, name) for part in chosen))
            for name, condition in CONDITIONS.items()
        ]
        first = chosen[0].results[0]["evaluations"][0]
        against = "" if first["opponent"] == "-" else f" against `{first['opponent']}`"
        measure = f"{first['metric']}{against}".replace("_", " ")
        texts.append(f"### {task}\n\nScores: {measure}.\n\n{table(header, rows)}")
    return "\n\n".join(texts)


def missing(collected: Studied) -> str:
    """Return a sentence on the runs of the study that have not been made; empty if all have."""
    parts = [part for part in collected if part.experiment.group == GROUP]
    open_runs = sum(part.missing for part in parts)
    total = sum(part.experiment.seeds for part in parts)
    if not open_runs:
        return ""
    return (
        f"Of the {total} runs of the variants (a) to (e) {total - open_runs} have been made; "
        f"{open_runs} are open."
    )


def estimate(part: Collected, condition: str) -> Estimate:
    """Return the score under a condition, with the interval over seeds, or of one seed's matches.

    Args:
        part: results of an experiment.
        condition: name of the condition.
    """
    rows = _rows(part, condition)
    if len(rows) == 1:
        (row,) = rows
        return Estimate(row["score"], row["low"], row["high"], 1)
    return iqm([float(row["score"]) for row in rows])


def _rows(part: Collected, condition: str) -> list[Mapping[str, Any]]:
    rows: list[Result] = [row for result in part.results for row in result["evaluations"]]
    return [row for row in rows if row["condition"] == condition]


def _cell(part: Collected | None, condition: str) -> str:
    """Score and interval; a dash without results."""
    if part is None or not _rows(part, condition):
        return "-"
    found = estimate(part, condition)
    bounds = f"{cells.number(found.low)} to {cells.number(found.high)}"
    return f"{cells.number(found.value)}{cells.mark(part)} ({bounds})"


def _with_share(part: Collected | None, condition: str, base: Estimate) -> str:
    """Score and interval, and the score as a part of another."""
    text = _cell(part, condition)
    if part is None or text == "-":
        return text
    return f"{text}, {estimate(part, condition).value / base.value:.0%}"


def _variant(part: Collected) -> str:
    return part.experiment.name.removeprefix(f"{part.experiment.task}-")


def _title(part: Collected) -> str:
    """Description of a variant, with its samples and seeds where it learned."""
    if part.experiment.group == SHIPPED_GROUP:
        return part.experiment.text
    count = len(part.results)
    seeds = "one seed" if count == 1 else f"{count} seeds"
    return f"{part.experiment.text}; {cells.millions(part.samples())}, {seeds}"
