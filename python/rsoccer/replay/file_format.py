"""Replay files: what `rsoccer.replay.container` holds for a replay.

Keys of the header:

| key | content |
| --- | --- |
| `package`, `physics` | versions of the package (text) and of its physics (number) |
| `task`, `options`, `controllers`, `names` | as the fields of `Replay` |
| `config` | the configuration, JSON of `SimConfig.to_json` |
| `columns` | names of the stored columns: `ball`, `robot`, `command` |
| `steps` | steps of the columns of the sections `rows` and `commands`, and of each reward term |
| `frames`, `observers` | number of frames, names of the robots that are paid |
| `episodes` | for each start, stop, end and metrics |
| `events` | for each frame, kind, robot and detail |
| `marker_sets`, `markers` | different sets of markers; pairs of a frame and the set from there on |
| `snapshots` | for each its frame, and name, type and shape of its arrays |

Sections: `rows`, `commands` and `term:<name>` hold columns as `rsoccer.replay.quantized` writes
them; `snapshot:<frame>` holds the arrays of a snapshot one after the other, exact to the last bit.
The state row of such a frame is taken from there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, fields
from typing import Any, Final, TypeVar

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.markers import Area, Gate, Marker, Segment, Target
from rsoccer.replay import container, quantized
from rsoccer.replay.container import ReplayError
from rsoccer.replay.events import KINDS, Event
from rsoccer.replay.quantized import MAX_STEP
from rsoccer.replay.replay import Episode, Replay

MARKERS: Final = {kind.__name__: kind for kind in (Target, Gate, Area, Segment)}
"""Kinds of markers by name."""
ENDS: Final = ("terminated", "truncated", "")
_DTYPES: Final = "?bBhHiIlLqQefd"  # booleans, integers and floats
_MARKER_DIGITS: Final = 4  # tenths of a millimetre

T = TypeVar("T")


# -- Writing -----------------------------------------------------------------------------------


def to_bytes(replay: Replay, snapshots: bool = True) -> bytes:
    """Return the content of a replay's file.

    Args:
        replay: the replay.
        snapshots: whether to include its snapshots.

    Returns:
        The bytes; equal replays give equal bytes.

    Raises:
        ReplayError: numbers that are not finite, or a snapshot with objects.
    """
    config, kept = replay.config, replay.snapshots if snapshots else {}
    row_steps = quantized.row_steps(config.n_robots)
    command_steps = [quantized.STEPS[name] for name in config.command_columns] * config.n_robots
    term_steps = {name: quantized.term_step(term) for name, term in replay.terms.items()}
    commands = replay.commands.reshape(len(replay), -1)
    sections = {
        "rows": quantized.encode("rows", quantized.stored_rows(replay.rows), row_steps),
        "commands": quantized.encode("commands", commands, command_steps),
    }
    for name, term in replay.terms.items():
        sections[f"term:{name}"] = quantized.encode(f"term {name!r}", term, term_steps[name])
    for frame, arrays in kept.items():
        sections[f"snapshot:{frame}"] = b"".join(_raw(*item) for item in arrays.items())
    header = {
        "package": replay.package,
        "physics": replay.physics,
        "task": replay.task,
        "options": replay.options,
        "controllers": dict(replay.controllers),
        "names": list(replay.names),
        "config": config.to_json(),
        "columns": _columns(config),
        "steps": {"rows": row_steps, "commands": command_steps, "terms": term_steps},
        "frames": len(replay),
        "observers": list(replay.observers),
        "episodes": [asdict(episode) for episode in replay.episodes],
        "events": [list(event) for event in replay.events],
        **_written_markers(replay.markers),
        "snapshots": [
            [frame, [[name, a.dtype.str, list(a.shape)] for name, a in arrays.items()]]
            for frame, arrays in kept.items()
        ],
    }
    return container.pack(header, sections)


def _raw(name: str, array: Array) -> bytes:
    """Bytes of an array of a snapshot."""
    if array.dtype.char not in _DTYPES:
        raise ReplayError(f"snapshot: expected numbers in {name!r}, got {array.dtype}")
    return array.tobytes()


def _columns(config: SimConfig) -> dict[str, list[str]]:
    """Names of the stored columns."""
    return {
        "ball": list(quantized.BALL_STORED),
        "robot": list(quantized.ROBOT_STORED),
        "command": list(config.command_columns),
    }


def _written_markers(markers: tuple[tuple[Marker, ...], ...]) -> dict[str, Any]:
    """Different sets of markers, and the frames from which each is shown."""
    sets: dict[tuple[Marker, ...], int] = {}
    changes: list[list[int]] = []
    for frame, shown in enumerate(markers):
        index = sets.setdefault(shown, len(sets))
        if not changes or changes[-1][1] != index:
            changes.append([frame, index])
    written = [[[type(m).__name__, *_rounded(m)] for m in shown] for shown in sets]
    return {"marker_sets": written, "markers": changes}


def _rounded(marker: Marker) -> list[Any]:
    """Fields of a marker, rounded."""

    def rounded(value: Any) -> Any:  # noqa: ANN401  (a number, a flag or a point)
        if isinstance(value, tuple):
            return [rounded(part) for part in value]
        return value if isinstance(value, bool) else round(float(value), _MARKER_DIGITS)

    return [rounded(getattr(marker, f.name)) for f in fields(marker)]


# -- Reading -----------------------------------------------------------------------------------


def from_bytes(content: bytes) -> Replay:
    """Return the replay with this content.

    Args:
        content: bytes from `to_bytes`.

    Returns:
        The replay.

    Raises:
        ReplayError: no replay, another version, an incomplete file or wrong bytes.
    """
    header, sections = container.unpack(content)
    config = _config(_get(header, "config", str))
    if header.get("columns") != _columns(config):
        raise ReplayError("columns: expected those of this package, got others")
    frames = _get(header, "frames", int)
    episodes = _episodes(_get(header, "episodes", list), frames)
    steps = _get(header, "steps", dict)
    observers = _texts("observers", header.get("observers"))
    stored = _section(sections, "rows", frames, _steps("rows", steps.get("rows")))
    n_stored = len(quantized.row_steps(config.n_robots))
    commands = _section(sections, "commands", frames, _steps("commands", steps.get("commands")))
    shape = (config.n_robots, len(config.command_columns))
    for name, values, columns in (
        ("rows", stored, n_stored),
        ("commands", commands, math.prod(shape)),
    ):
        if values.shape[1] != columns:
            raise ReplayError(f"{name}: expected {columns} columns, got {values.shape[1]}")
    rows = quantized.rows_of(stored, config.n_blue, config.n_yellow)
    snapshots = _snapshots(_get(header, "snapshots", list), sections, frames)
    for frame, arrays in snapshots.items():
        _restore_row(rows, frame, arrays)
    return Replay(
        task=_get(header, "task", str),
        options=_optional_dict("options", header.get("options")),
        controllers=_controllers(_get(header, "controllers", dict)),
        names=_names(header.get("names")),
        config=config,
        rows=rows,
        commands=commands.reshape(frames, *shape).astype(np.float32),
        observers=observers,
        terms=_terms(steps.get("terms"), sections, frames, len(observers)),
        markers=_markers(header, frames),
        episodes=episodes,
        events=tuple(_event(entry, frames) for entry in _get(header, "events", list)),
        snapshots=snapshots,
        package=_get(header, "package", str),
        physics=_get(header, "physics", int),
    )


def _get(header: Mapping[str, Any], key: str, kind: type[T]) -> T:
    """Value of a key of the header, of this type."""
    value = header.get(key)
    if type(value) is not kind:
        raise ReplayError(f"{key}: expected {kind.__name__}, got {type(value).__name__}")
    return value


def _config(text: str) -> SimConfig:
    try:
        return SimConfig.from_json(text)
    except ValueError as error:
        raise ReplayError(f"config: {error}") from None


def _steps(name: str, value: object) -> list[float]:
    """Steps of columns: positive finite numbers."""
    numbers = value if isinstance(value, list) else [None]
    if not all(isinstance(v, int | float) and 0 < v <= MAX_STEP for v in numbers):
        raise ReplayError(f"steps of {name}: expected positive numbers, got {str(value)[:80]}")
    return [float(v) for v in numbers]


def _section(
    sections: Mapping[str, bytes], name: str, frames: int, steps: list[float]
) -> Doubles:
    """Columns (frames, columns) of a section."""
    if name not in sections:
        raise ReplayError(f"sections: expected {name!r}, got {sorted(sections)}"[:200])
    return quantized.decode(name, sections[name], frames, steps)


def _terms(
    steps: object, sections: Mapping[str, bytes], frames: int, observers: int
) -> dict[str, Floats]:
    """Reward terms (frames, observers) by name."""
    if not isinstance(steps, dict):
        raise ReplayError(f"steps of terms: expected an object, got {type(steps).__name__}")
    terms = {}
    for name, step in steps.items():
        (checked,) = _steps(name, [step])
        values = _section(sections, f"term:{name}", frames, [checked] * observers)
        terms[name] = values.astype(np.float32)
    return terms


def _episodes(entries: list[Any], frames: int) -> tuple[Episode, ...]:
    """Episodes that cover all frames, in order."""
    episodes, start = [], 0
    for entry in entries:
        if not isinstance(entry, dict) or set(entry) != {f.name for f in fields(Episode)}:
            raise ReplayError(f"episodes: expected objects with start, stop, end, got {entry!s:.80}")
        stop, end, metrics = entry["stop"], entry["end"], entry["metrics"]
        valid = type(stop) is int and entry["start"] == start and start < stop <= frames
        if not valid or end not in ENDS:
            raise ReplayError(f"episodes: expected frames in order, got {entry!s:.80}")
        episodes.append(Episode(start, stop, end, _metrics(metrics)))
        start = stop
    if start != frames or not frames:
        raise ReplayError(f"episodes: expected all {frames} frames, at least 1, got {start}")
    return tuple(episodes)


def _metrics(value: object) -> dict[str, float]:
    """Metrics by name; null stands for a number that is not finite."""
    if not isinstance(value, dict) or not all(_is_number(v) for v in value.values()):
        raise ReplayError(f"metrics: expected numbers by name, got {value!s:.80}")
    return {name: float(v) for name, v in value.items()}


def _is_number(value: object) -> bool:
    return type(value) in (int, float) and abs(value) < 1e300  # type: ignore[arg-type]


def _event(entry: object, frames: int) -> Event:
    if not isinstance(entry, list) or [type(part) for part in entry] != [int, str, str, str]:
        raise ReplayError(f"events: expected a frame and three texts, got {entry!s:.80}")
    event = Event(*entry)
    if not 0 <= event.frame < frames or event.kind not in KINDS:
        raise ReplayError(f"events: expected a frame and one of {KINDS}, got {entry!s:.80}")
    return event


def _texts(name: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(part, str) for part in value):
        raise ReplayError(f"{name}: expected texts, got {value!s:.80}")
    return tuple(value)


def _names(value: object) -> tuple[str, str]:
    names = _texts("names", value)
    if len(names) != 2:
        raise ReplayError(f"names: expected two, got {len(names)}")
    return (names[0], names[1])


def _controllers(value: dict[str, Any]) -> dict[str, str | None]:
    if not all(part is None or isinstance(part, str) for part in value.values()):
        raise ReplayError("controllers: expected names by robot, got other values")
    return value


def _optional_dict(name: str, value: object) -> dict[str, Any] | None:
    if value is not None and not isinstance(value, dict):
        raise ReplayError(f"{name}: expected an object or null, got {type(value).__name__}")
    return value


def _markers(header: Mapping[str, Any], frames: int) -> tuple[tuple[Marker, ...], ...]:
    """Markers of each frame."""
    entries = _get(header, "marker_sets", list)
    sets = [tuple(_marker(m) for m in shown) for shown in _lists("marker_sets", entries)]
    changes = _lists("markers", _get(header, "markers", list))
    starts = [change[0] if len(change) == 2 else None for change in changes]
    chosen: list[tuple[Marker, ...]] = []
    for change, stop in zip(changes, [*starts[1:], frames], strict=True):
        valid = all(type(part) is int for part in (*change, stop)) and len(change) == 2
        if not (valid and change[0] == len(chosen) < stop <= frames and 0 <= change[1] < len(sets)):
            raise ReplayError(f"markers: expected frames and sets in order, got {change!s:.80}")
        chosen += [sets[change[1]]] * (stop - change[0])
    if len(chosen) != frames:
        raise ReplayError(f"markers: expected {frames} frames, got {len(chosen)}")
    return tuple(chosen)


def _lists(name: str, entries: list[Any]) -> list[list[Any]]:
    if not all(isinstance(entry, list) for entry in entries):
        raise ReplayError(f"{name}: expected lists, got other values")
    return entries


def _marker(entry: object) -> Marker:
    """A marker from its kind and fields."""
    if not isinstance(entry, list) or not entry or str(entry[0]) not in MARKERS:
        raise ReplayError(f"markers: expected one of {sorted(MARKERS)}, got {entry!s:.80}")
    kind = MARKERS[str(entry[0])]
    valid = len(entry) - 1 == len(fields(kind))
    values = [_MARKER_VALUES.get(str(f.type), _point)(v) for f, v in zip(fields(kind), entry[1:])]
    if not valid or any(value is None for value in values):
        raise ReplayError(f"markers: expected the fields of {entry[0]}, got {entry!s:.80}")
    marker: Marker = kind(*values)
    return marker


def _point(value: object) -> tuple[float, float] | None:
    valid = isinstance(value, list) and len(value) == 2 and all(map(_is_number, value))
    return (float(value[0]), float(value[1])) if valid else None  # type: ignore[index]


_MARKER_VALUES: Final[dict[str, Callable[[object], object]]] = {
    str(bool): lambda value: value if isinstance(value, bool) else None,
    str(float): lambda value: value if _is_number(value) else None,
}
"""Readers of a marker's fields by their type; of points by default."""


def _snapshots(
    entries: list[Any], sections: Mapping[str, bytes], frames: int
) -> dict[int, dict[str, Array]]:
    """Snapshots by frame."""
    snapshots = {}
    for entry in _lists("snapshots", entries):
        valid = len(entry) == 2 and type(entry[0]) is int and isinstance(entry[1], list)
        if not valid or not 0 <= entry[0] < frames:
            raise ReplayError(f"snapshots: expected a frame and arrays, got {entry!s:.80}")
        content = sections.get(f"snapshot:{entry[0]}", b"")
        snapshots[entry[0]] = _arrays(_lists("snapshots", entry[1]), content)
    return snapshots


def _arrays(entries: list[list[Any]], content: bytes) -> dict[str, Array]:
    """Arrays that follow each other in `content`, copied."""
    arrays, start = {}, 0
    for entry in entries:
        types = [type(part) for part in entry]
        if types != [str, str, list] or not all(type(n) is int and n >= 0 for n in entry[2]):
            raise ReplayError(f"snapshots: expected name, type and shape, got {entry!s:.80}")
        name, kind, shape = entry
        dtype = _dtype(kind)
        size = math.prod(shape) * dtype.itemsize
        if size > len(content) - start or len(shape) > 16 or any(n > 2**31 for n in shape):
            raise ReplayError(f"snapshots: expected {size} bytes for {name!r:.80}, got less")
        array = np.frombuffer(content, dtype, math.prod(shape), start)
        arrays[name] = array.reshape(shape).copy()
        start += size
    if start != len(content):
        raise ReplayError(f"snapshots: expected {start} bytes, got {len(content)}")
    return arrays


def _dtype(text: str) -> np.dtype[Any]:
    """A type of numbers."""
    try:
        dtype = np.dtype(text)
    except (TypeError, ValueError, SyntaxError):
        raise ReplayError(f"snapshots: expected a type of numbers, got {text!r:.80}") from None
    if dtype.char not in _DTYPES or dtype.str != text:
        raise ReplayError(f"snapshots: expected a type of numbers, got {text!r:.80}")
    return dtype


def _restore_row(rows: Floats, frame: int, arrays: Mapping[str, Array]) -> None:
    """Overwrite a row by the exact one of its snapshot."""
    exact = arrays.get("frame")
    if exact is None or exact.shape != (1, rows.shape[1]) or exact.dtype != np.float32:
        raise ReplayError(f"snapshots: expected a row of {rows.shape[1]} numbers in 'frame'")
    if not np.isfinite(exact).all():
        raise ReplayError("snapshots: expected finite numbers in 'frame'")
    rows[frame] = exact[0]
