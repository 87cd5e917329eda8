"""An entry as text."""

from __future__ import annotations

from rsoccer.benchmark.conditions import CONDITIONS, TRUTH
from rsoccer.benchmark.entry import Entry, Row
from rsoccer.evaluate.tables import align


def report(entry: Entry) -> str:
    """Return the scores of an entry as lines of text: plain rows, then those of all conditions.

    Args:
        entry: the entry.
    """
    header = ("task", "opponent", "measure", "score", "95% interval", "won", "drawn", "lost")
    plain = [
        _cells(task, row.opponent, row)
        for task, rows in entry.tasks.items()
        for row in rows
        if row.condition == TRUTH
    ]
    others = [
        _cells(task, CONDITIONS[row.condition].text.replace("`", ""), row)
        for task, rows in entry.tasks.items()
        for row in rows
        if row.condition != TRUTH
    ]
    title = (
        f"{entry.name}: {entry.matches} matches a row, seed {entry.seed}, rsoccer "
        f"{entry.versions['package']}, physics {entry.versions['physics']}, "
        f"{entry.machine['processor']}, {entry.machine['cores']} cores, {entry.date}"
    )
    parts = [title, align([header, *plain], 3)]
    if others:
        parts.append(align([("task", "condition", *header[2:]), *others], 3))
    parts += [f"{task} is left out: {reason}" for task, reason in entry.refused.items()]
    return "\n\n".join(parts)


def _cells(task: str, second: str, row: Row) -> tuple[str, ...]:
    """Cells of a row."""
    digits = 3 if abs(row.score) < 10.0 else 2
    interval = f"[{row.low:.{digits}f}, {row.high:.{digits}f}]"
    counts = map(str, (row.wins, row.draws, row.losses))
    metric = row.metric.replace("_", " ")
    return (task, second, metric, f"{row.score:.{digits}f}", interval, *counts)
