"""Markers in the header of a replay file: different sets of them, and the frames of each.

A marker is a list of its kind, such as "Target", and its fields in order.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any, Final

from rsoccer.markers import Area, Gate, Marker, Point, Segment, Target
from rsoccer.replay.container import ReplayError
from rsoccer.replay.header_values import get, is_number, lists

KINDS: Final[dict[str, type[Marker]]] = {
    kind.__name__: kind for kind in (Target, Gate, Area, Segment)
}
"""Kinds of markers by name."""
DIGITS: Final = 4
"""Decimals of coordinates, meters: tenths of a millimeter."""


def written(markers: tuple[tuple[Marker, ...], ...]) -> dict[str, Any]:
    """Return the keys of the header.

    Args:
        markers: (f,) markers of each frame.

    Returns:
        `marker_sets`, and `markers`: pairs of a frame and the set from there on.
    """
    sets: dict[tuple[Any, ...], int] = {}  # rounded, so that equal ones become one
    changes: list[list[int]] = []
    for frame, shown in enumerate(markers):
        index = sets.setdefault(tuple(map(_written, shown)), len(sets))
        if not changes or changes[-1][1] != index:
            changes.append([frame, index])
    return {"marker_sets": list(sets), "markers": changes}


def _written(marker: Marker) -> tuple[Any, ...]:
    """Kind and fields of a marker, rounded."""

    def rounded(value: Any) -> Any:  # noqa: ANN401  (a number, a flag or a point)
        if isinstance(value, tuple):
            return tuple(rounded(part) for part in value)
        return value if isinstance(value, bool) else round(float(value), DIGITS)

    return (type(marker).__name__, *(rounded(getattr(marker, f.name)) for f in fields(marker)))


def read(header: Mapping[str, Any], frames: int) -> tuple[tuple[Marker, ...], ...]:
    """Return the markers of each frame.

    Args:
        header: the header.
        frames: number of frames.

    Raises:
        ReplayError: other values, or frames that are missing.
    """
    entries = lists("marker_sets", get(header, "marker_sets", list))
    sets = [tuple(_marker(m) for m in shown) for shown in entries]
    changes = [_change(entry) for entry in lists("markers", get(header, "markers", list))]
    stops = [*(start for start, _ in changes[1:]), frames]
    shown: list[tuple[Marker, ...]] = []
    for (start, index), stop in zip(changes, stops, strict=False):
        if not (start == len(shown) < stop <= frames and 0 <= index < len(sets)):
            raise ReplayError(f"markers: expected frames and sets in order, got {start}, {index}")
        shown += [sets[index]] * (stop - start)
    if len(shown) != frames:
        raise ReplayError(f"markers: expected {frames} frames, got {len(shown)}")
    return tuple(shown)


def _change(entry: list[Any]) -> tuple[int, int]:
    """A frame, and the index of the set from there on."""
    if [type(part) for part in entry] != [int, int]:
        raise ReplayError(f"markers: expected a frame and a set, got {entry!s:.80}")
    return entry[0], entry[1]


def _marker(entry: object) -> Marker:
    """A marker from its kind and fields."""
    if not isinstance(entry, list) or not entry or str(entry[0]) not in KINDS:
        raise ReplayError(f"markers: expected one of {sorted(KINDS)}, got {entry!s:.80}")
    values = entry[1:]
    match str(entry[0]):
        case "Target" if len(values) == 2 and is_number(values[1]):
            return Target(_point(values[0]), float(values[1]))
        case "Gate" if len(values) == 3 and isinstance(values[2], bool):
            return Gate(_point(values[0]), _point(values[1]), values[2])
        case "Area" if len(values) == 2:
            return Area(_point(values[0]), _point(values[1]))
        case "Segment" if len(values) == 2:
            return Segment(_point(values[0]), _point(values[1]))
    raise ReplayError(f"markers: expected the fields of {entry[0]}, got {entry!s:.80}")


def _point(value: object) -> Point:
    if not isinstance(value, list) or len(value) != 2 or not all(map(is_number, value)):
        raise ReplayError(f"markers: expected x and y, got {value!s:.80}")
    return (float(value[0]), float(value[1]))
