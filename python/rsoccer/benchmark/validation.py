"""Validation of entries: what makes a file of the leaderboard invalid."""

from __future__ import annotations

import datetime
import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final

from rsoccer._core import build_info
from rsoccer.benchmark.entry import FORMAT, LINK, Entry, Row
from rsoccer.benchmark.numbers import wrong_numbers
from rsoccer.benchmark.protocol import MATCHES, SEED, TASKS, rows_of
from rsoccer.registry import make_task

FLOATS: Final = ("score", "low", "high", "seconds", "wall_clock")
"""Numbers of a row that are no counts."""
_TYPES: Final[dict[str, type]] = {
    **dict.fromkeys(("name", "policy", "digest", "description", "link", "date"), str),
    **dict.fromkeys(("matches", "seed"), int),
    **dict.fromkeys(("versions", "machine", "tasks", "refused"), dict),
    "robust": bool,
}
_ROW_TYPES: Final[dict[str, type]] = {
    **dict.fromkeys(("opponent", "condition", "metric"), str),
    **dict.fromkeys(("matches", "wins", "draws", "losses"), int),
    **dict.fromkeys(FLOATS, float),
}
_MACHINE: Final[dict[str, type]] = {
    **dict.fromkeys(("processor", "system", "python", "numpy"), str),
    "cores": int,
}


class EntryError(ValueError):
    """A file that is no valid entry of the leaderboard; its text lists all problems."""


def read_entry(path: str | os.PathLike[str], *, partial: bool = False) -> Entry:
    """Read an entry and check it.

    Args:
        path: the file.
        partial: whether rows may be missing, as in a measurement that goes on.

    Returns:
        The entry.

    Raises:
        EntryError: a file that is no JSON, or an entry with problems.
        FileNotFoundError: there is no such file.
    """
    try:
        values = json.loads(Path(path).read_text())
    except ValueError as error:
        raise EntryError(f"{path}: expected JSON: {error}") from error
    if found := problems(values, partial=partial):
        raise EntryError(f"{path}: {'; '.join(found)}")
    return Entry.from_values(values)


def problems(values: object, *, partial: bool = False) -> list[str]:
    """Return all reasons for which an entry is invalid, in words; empty for a valid one.

    Args:
        values: the decoded JSON of the file.
        partial: whether rows may be missing, and matches fewer than the leaderboard asks for.
    """
    if not isinstance(values, Mapping):
        return [f"expected an object, got {type(values).__name__}"]
    if values.get("format") != FORMAT:
        return [f"format: expected {FORMAT}, got {values.get('format')!r}"]
    others = {name: value for name, value in values.items() if name != "format"}
    if wrong := list(_wrong_types("", others, _TYPES)):
        return wrong
    found = list(_protocol(values, partial))
    for task, rows in values["tasks"].items():
        found += (f"{task}: {text}" for text in _task(values, task, rows, partial))
    if not partial:
        found += _completeness(values)
    return found


def is_current(entry: Entry) -> bool:
    """Return whether an entry was measured with the present version of the physics.

    Args:
        entry: the entry.
    """
    return entry.versions["physics"] == int(build_info()["physics"])


def _wrong_types(where: str, values: Mapping[str, Any], types: Mapping[str, type]) -> Iterator[str]:
    for name in sorted(types.keys() - values.keys()):
        yield f"{where}{name}: missing"
    for name in sorted(values.keys() - types.keys()):
        yield f"{where}{name}: unknown"
    for name, expected in types.items():
        value = values.get(name)
        if name not in values or (expected is float and type(value) is int):
            continue
        if type(value) is not expected:
            yield f"{where}{name}: expected {expected.__name__}, got {value!r}"


def _protocol(values: Mapping[str, Any], partial: bool) -> Iterator[str]:
    """Problems of the head of an entry."""
    if not values["name"].strip():
        yield "name: expected a text, got an empty one"
    if values["seed"] != SEED:
        yield f"seed: expected {SEED}, got {values['seed']}"
    if not partial and values["matches"] < MATCHES:
        yield f"matches: expected at least {MATCHES}, got {values['matches']}"
    physics, newest = values["versions"].get("physics"), int(build_info()["physics"])
    if type(physics) is not int or not 1 <= physics <= newest:
        yield f"versions.physics: expected 1 to {newest}, got {physics!r}"
    if unknown := sorted({*values["tasks"], *values["refused"]} - {*TASKS}):
        yield f"tasks: expected some of {list(TASKS)}, got {unknown}"
    yield from _texts(values)
    yield from _machine(values["machine"])


def _texts(values: Mapping[str, Any]) -> Iterator[str]:
    """Texts of the head that are not of their form."""
    package = values["versions"].get("package")
    if not isinstance(package, str) or not package:
        yield f"versions.package: expected a text, got {package!r}"
    if not re.fullmatch("([0-9a-f]{64})?", values["digest"]):
        yield f"digest: expected 64 hexadecimal digits or none, got {values['digest']!r}"
    if not _is_date(values["date"]):
        yield f"date: expected year-month-day, not in the future, got {values['date']!r}"
    if not LINK.fullmatch(values["link"]):
        yield f"link: expected an address (https://...) or none, got {values['link']!r}"
    for task, reason in values["refused"].items():
        if not isinstance(reason, str):
            yield f"refused.{task}: expected a text, got {reason!r}"


def _machine(values: Mapping[str, Any]) -> Iterator[str]:
    """Problems of the description of the machine."""
    for name, expected in _MACHINE.items():
        value = values.get(name)
        if name not in values:
            yield f"machine.{name}: missing"
        elif type(value) is not expected:
            yield f"machine.{name}: expected {expected.__name__}, got {value!r}"


def _is_date(text: str) -> bool:
    """Whether a text is a date as entries have it, of a day that has begun somewhere."""
    newest = datetime.datetime.now(datetime.UTC).date() + datetime.timedelta(days=1)
    try:
        day = datetime.date.fromisoformat(text)
    except ValueError:
        return False
    return day.isoformat() == text and day <= newest


def _task(values: Mapping[str, Any], task: str, rows: object, partial: bool) -> Iterator[str]:
    """Problems of the rows of a task."""
    if task not in TASKS:
        return
    if not isinstance(rows, list) or not all(isinstance(row, Mapping) for row in rows):
        yield f"expected a list of rows, got {type(rows).__name__}"
        return
    for index, row in enumerate(rows):
        if wrong := list(_wrong_types(f"row {index}: ", row, _ROW_TYPES)):
            yield from wrong
            return
        yield from (f"row {index}: {text}" for text in _row(task, values["matches"], Row(**row)))
    expected = [(opponent or "-", name) for opponent, name in rows_of(task, values["robust"])]
    got = [(row["opponent"], row["condition"]) for row in rows]
    if partial and set(got) <= set(expected) and len(set(got)) == len(got):
        return
    if sorted(got) != sorted(expected):
        missing = [row for row in expected if row not in got]
        others = [row for row in got if row not in expected or got.count(row) > 1]
        yield f"rows: expected each opponent and condition once, missing {missing}, got {others}"


def _row(task: str, matches: int, row: Row) -> Iterator[str]:
    """Problems of the numbers of a row."""
    made = make_task(task)
    if row.metric != made.success:
        yield f"metric: expected {made.success!r}, got {row.metric!r}"
    if row.matches != matches:
        yield f"matches: expected {matches}, got {row.matches}"
    if wrong := [name for name in FLOATS if not math.isfinite(getattr(row, name))]:
        yield f"{', '.join(wrong)}: expected finite numbers"
        return
    yield from wrong_numbers(made, row)


def _completeness(values: Mapping[str, Any]) -> Iterator[str]:
    """Tasks without rows, or refused although the policy plays them."""
    if not values["tasks"]:
        yield "tasks: expected rows of at least one task, got none"
    for task in sorted({*values["tasks"]} & {*values["refused"]}):
        yield f"{task}: expected rows or a reason, got both"
