"""Tables of the leaderboard, from the files in `benchmarks/`.

`python -m tools.leaderboard` checks all files and prints what is wrong with them.
"""

import json
import sys
from pathlib import Path
from typing import Final

from benches.markdown import code, escaped, table
from benches.result_files import RESULTS
from rsoccer.benchmark import (
    CONDITIONS,
    TASKS,
    Entry,
    EntryError,
    Row,
    is_current,
    opponents_of,
    read_entry,
)
from rsoccer.benchmark.conditions import TRUTH
from rsoccer.benchmark.entry import LINK
from tools.paths import ROOT

FOLDER: Final = ROOT / "benchmarks"
QUOTED: Final = "quoted.json"
"""File with results of others, which were not measured here."""
CALIBRATION: Final = {"DDPG": "VSS-v0-ddpg", "SAC": "VSS-v0-sac"}
"""Runs of the study of learning in the setting of the paper, by algorithm."""
SHOWN: Final = ("rc2021", "realistic", "commands-100ms")
"""Conditions that have columns of their own."""
STALE: Final = "\\*"


def main() -> int:
    """Check every file.

    Returns:
        1 if a file is invalid.
    """
    failed = False
    read = []
    for path in files():
        try:
            read.append((path, read_entry(path)))
        except EntryError as error:
            failed = True
            print(error)
    twice = _of_one_name(read)
    for text in twice:
        print(text)
    return int(failed or bool(twice))


def files(folder: Path = FOLDER) -> list[Path]:
    """Return the files of entries."""
    return [path for path in sorted(folder.glob("*.json")) if path.name != QUOTED]


def entries(folder: Path = FOLDER) -> list[Entry]:
    """Return all entries.

    Raises:
        EntryError: A file is invalid, or has the name of another one.
    """
    read = [(path, read_entry(path)) for path in files(folder)]
    if twice := _of_one_name(read):
        raise EntryError("; ".join(twice))
    return [entry for _, entry in read]


def _of_one_name(read: list[tuple[Path, Entry]]) -> list[str]:
    """Entries whose name in the tables is that of an earlier file, in words."""
    first: dict[str, Path] = {}
    found = []
    for path, entry in read:
        shown = code(entry.name)
        if shown in first:
            other = first[shown].name
            found.append(f"{path}: name: expected another one than in {other}, got {entry.name!r}")
        first.setdefault(shown, path)
    return found


def plain(found: list[Entry] | None = None) -> str:
    """Return a table for each task: the scores of all entries on the true state, best first."""
    found = entries() if found is None else found
    return "\n\n".join(
        text for task in TASKS if (text := _plain(task, [e for e in found if task in e.tasks]))
    )


def _plain(task: str, found: list[Entry]) -> str:
    """Table of a task; empty without entries."""
    if not found:
        return ""
    opponents = [name or "-" for name in opponents_of(task)]
    scored = [(entry, [_row(entry, task, name, TRUTH) for name in opponents]) for entry in found]
    scored.sort(key=lambda pair: -sum(row.score for row in pair[1]))
    metric = scored[0][1][0].metric.replace("_", " ")
    against = [f"against `{name}`" if name != "-" else metric for name in opponents]
    rows = [(_name(entry), *map(_score, shown), str(entry.matches)) for entry, shown in scored]
    title = f"### {task}\n\nMeasure: {metric}.\n\n"
    return title + table(("policy", *against, "matches a row"), rows)


def robust(found: list[Entry] | None = None) -> str:
    """Return the table of the entries that were measured under all conditions."""
    found = entries() if found is None else found
    header = ("task", "policy", "true state", "mean of nine conditions", "worst condition")
    rows = []
    for task in TASKS:
        measured = [entry for entry in found if entry.robust and task in entry.tasks]
        rows += [_robust(task, entry) for entry in sorted(measured, key=lambda e: -_mean(e, task))]
    return table((*header, *(CONDITIONS[name].text for name in SHOWN)), rows)


def _robust(task: str, entry: Entry) -> tuple[str, ...]:
    opponent = opponents_of(task)[0] or "-"
    others = _under_conditions(entry, task)
    worst = min(others, key=lambda row: row.score)
    shown = [_score(_row(entry, task, opponent, name)) for name in SHOWN]
    truth = _score(_row(entry, task, opponent, TRUTH))
    text = f"{_score(worst)}: {CONDITIONS[worst.condition].text}"
    return f"`{task}`", _name(entry), truth, _number(_mean(entry, task)), text, *shown


def _under_conditions(entry: Entry, task: str) -> list[Row]:
    return [row for row in entry.tasks[task] if row.condition != TRUTH]


def _mean(entry: Entry, task: str) -> float:
    """Mean of the scores under all conditions but the true state."""
    rows = _under_conditions(entry, task)
    return sum(row.score for row in rows) / len(rows)


def provenance(found: list[Entry] | None = None) -> str:
    """Return the table of what the entries are, and where and when they were measured."""
    found = entries() if found is None else found
    header = ("policy", "description", "tasks measured", "date", "rsoccer, physics", "machine")
    rows = [
        (
            f"[{_name(entry)}]({entry.link})" if _is_link(entry.link) else _name(entry),
            escaped(entry.description),
            f"{len(entry.tasks)} of {len(TASKS)}",
            escaped(entry.date),
            escaped(f"{entry.versions['package']}, {entry.versions['physics']}"),
            escaped(f"{entry.machine['processor']}, {entry.machine['cores']} cores"),
            f"{sum(row.wall_clock for rows in entry.tasks.values() for row in rows) / 60:.0f} min",
        )
        for entry in sorted(found, key=lambda entry: entry.name)
    ]
    return table((*header, "wall clock"), rows)


def _is_link(text: str) -> bool:
    """Whether an address is one that a page may lead to."""
    return bool(text and LINK.fullmatch(text))


def quoted() -> str:
    """Return the table of results that were not measured by this protocol, with their sources."""
    values = json.loads((FOLDER / QUOTED).read_text())
    keys = ("task", "learner", "samples", "result", "simulator", "source")
    rows = [tuple(_quoted_cell(value, key) for key in keys) for value in values]
    return table(("task", "learner", "samples", "result", "simulator", "source"), rows)


def _quoted_cell(value: dict[str, str], key: str) -> str:
    return f"`{value[key]}`" if key == "task" and value[key] in TASKS else value[key]


def papers_algorithms() -> str:
    """Return the table of the paper's algorithms in its setting, from the study of learning."""
    rows = []
    for algorithm, run in CALIBRATION.items():
        path = RESULTS / "learning" / "runs" / "calibration" / run / "seed-0.json"
        result = json.loads(path.read_text())
        row = result["evaluations"][0]
        interval = f"{_number(row['score'])} ({_number(row['low'])} to {_number(row['high'])})"
        cells = (f"`{row['opponent']}`", interval, str(row["matches"]), str(result["physics"]))
        rows.append((algorithm, f"`{result['task']}`", f"{result['samples'] / 1e6:.0f} M", *cells))
    header = ("algorithm", "task", "samples", "against", "goal score", "matches", "physics")
    return table(header, rows)


def _row(entry: Entry, task: str, opponent: str, condition: str) -> Row:
    """The row of an opponent under a condition."""
    return next(
        row for row in entry.tasks[task] if (row.opponent, row.condition) == (opponent, condition)
    )


def _name(entry: Entry) -> str:
    """Name of an entry, marked if the physics is another one now."""
    return f"{code(entry.name)}{'' if is_current(entry) else STALE}"


def _score(row: Row) -> str:
    return f"{_number(row.score)} ({_number(row.low)} to {_number(row.high)})"


def _number(value: float) -> str:
    """Three digits, without the zero before the point."""
    if abs(value) >= 1.0:
        return f"{value:.2f}"
    return f"{value:.3f}".replace("0.", ".", 1)


if __name__ == "__main__":
    sys.exit(main())
