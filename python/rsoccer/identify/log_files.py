"""Logs as CSV files."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from rsoccer.identify.log import BALL, DRIVES, KEYS, KICK, NUMBERS, POSE, Log, Reader, Track


def read_log(*paths: str | Path) -> Log:
    """Read the log in one CSV file or several, such as that of the radio and that of the cameras.

    Args:
        *paths: the files, each with a first line that names its columns.

    Returns:
        The log.

    Raises:
        FileNotFoundError: no such file.
        ValueError: no file, a file that is no text, columns that are missing, unknown or repeated,
            or a row that `Log.of_rows` refuses.
    """
    if not paths:
        raise ValueError("log: expected one file or more, got none")
    rows: list[tuple[str, int, Mapping[str, object]]] = []
    for path in map(Path, paths):
        rows += _rows(path)
    return Reader().read(rows)


def write_log(log: Log, path: str | Path) -> Path:
    """Write a log to a CSV file that `read_log` reads.

    Args:
        log: the log.
        path: the file.

    Returns:
        The path.
    """
    columns = DRIVES[log.drive] if log.drive else ()
    names = [*KEYS, *POSE, "captured", *columns, *([KICK] if columns else [])]
    text = io.StringIO()
    writer = csv.DictWriter(text, names, lineterminator="\n")
    writer.writeheader()
    writer.writerows(sorted(_written(log, columns), key=lambda row: float(row["time"])))
    Path(path).write_text(text.getvalue(), encoding="utf-8")
    return Path(path)


def _rows(path: Path) -> Iterator[tuple[str, int, Mapping[str, object]]]:
    """Rows of a file, with their places."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise FileNotFoundError(f"log: the file {path} does not exist") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"log: cannot read {path}: {error}") from error
    reader = csv.DictReader(text.splitlines(), skipinitialspace=True)
    names = [name.strip() for name in reader.fieldnames or ()]
    _check_columns(str(path), names)
    reader.fieldnames = names
    for row in reader:
        if None in row:
            raise ValueError(f"{path}, line {reader.line_num}: more cells than columns")
        yield f"{path}, line", reader.line_num, row


def _check_columns(path: str, names: Sequence[str]) -> None:
    """Refuse a file without the columns of a log."""
    if missing := [name for name in KEYS if name not in names]:
        raise ValueError(f"{path}: no column {', '.join(missing)}; its columns are {list(names)}")
    if unknown := [name for name in names if name not in (*KEYS, *NUMBERS)]:
        expected = ", ".join((*KEYS, *NUMBERS))
        raise ValueError(f"{path}: unknown columns {unknown}; expected some of {expected}")
    if repeated := sorted({name for name in names if names.count(name) > 1}):
        raise ValueError(f"{path}: expected each column once, got {repeated} twice or more")
    groups = {"pose": POSE[:2], **{f"command of {kind}": group for kind, group in DRIVES.items()}}
    for kind, group in groups.items():
        absent = [name for name in group if name not in names]
        if 0 < len(absent) < len(group):
            raise ValueError(f"{path}: a {kind} needs the columns {list(group)}; no {absent}")
    if not any(set(group) <= set(names) for group in groups.values()):
        raise ValueError(f"{path}: neither poses ({POSE}) nor commands ({list(DRIVES.values())})")


def _written(log: Log, columns: Sequence[str]) -> Iterator[dict[str, str]]:
    """Rows of a log as text."""
    for name, track in {**log.poses, BALL: log.ball}.items():
        yield from _written_track(name, track)
    for name, commands in log.commands.items():
        numbers = zip(
            commands.times.tolist(), commands.wheels.tolist(), commands.kicks.tolist(), strict=True
        )
        for time, wheels, kick in numbers:
            sent = dict(zip(columns, map(repr, wheels), strict=True))
            yield {"time": repr(time), "robot": name, **sent, KICK: repr(kick)}


def _written_track(name: str, track: Track) -> Iterator[dict[str, str]]:
    """Rows of the poses of a body."""
    pose = POSE[:2] if name == BALL else POSE
    for index, time in enumerate(track.times.tolist()):
        x, y = track.positions[index].tolist()
        numbers = [x, y, float(track.headings[index])][: len(pose)]
        row = {
            "time": repr(time),
            "robot": name,
            **dict(zip(pose, (f"{number:.8g}" for number in numbers), strict=True)),
        }
        captured = float(track.captured[index])
        yield row if math.isnan(captured) else row | {"captured": repr(captured)}
