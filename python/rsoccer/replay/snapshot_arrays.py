"""Snapshots in a replay file: arrays one after the other, exact to the last bit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.replay.container import ReplayError
from rsoccer.replay.header_values import lists

_KINDS: Final = "biuf"  # booleans, integers, floats
_MAX_DIMENSIONS: Final = 16
_MAX_LENGTH: Final = 2**31

Snapshots = Mapping[int, Mapping[str, Array]]


def described(snapshots: Snapshots) -> list[Any]:
    """Return name, type and shape of each array, by frame.

    Args:
        snapshots: arrays by name, by frame.
    """
    return [
        [frame, [[name, array.dtype.str, list(array.shape)] for name, array in arrays.items()]]
        for frame, arrays in snapshots.items()
    ]


def written(snapshots: Snapshots) -> dict[str, bytes]:
    """Return the sections of snapshots by name.

    Args:
        snapshots: arrays by name, by frame.

    Raises:
        ReplayError: an array of objects.
    """
    for arrays in snapshots.values():
        for name, array in arrays.items():
            if array.dtype.kind not in _KINDS:
                raise ReplayError(f"snapshots: expected numbers in {name!r}, got {array.dtype}")
    return {
        section(frame): b"".join(array.tobytes() for array in arrays.values())
        for frame, arrays in snapshots.items()
    }


def section(frame: int) -> str:
    """Return the name of the section of a snapshot.

    Args:
        frame: index of its frame.
    """
    return f"snapshot:{frame}"


def read(
    entries: list[Any], sections: Mapping[str, bytes], frames: int
) -> dict[int, dict[str, Array]]:
    """Return snapshots by frame.

    Args:
        entries: result of `described`.
        sections: bytes of the sections by name.
        frames: number of frames.

    Raises:
        ReplayError: other values, or bytes that do not fit them.
    """
    snapshots = {}
    for entry in lists("snapshots", entries):
        valid = len(entry) == 2 and type(entry[0]) is int and isinstance(entry[1], list)
        if not valid or not 0 <= entry[0] < frames:
            raise ReplayError(f"snapshots: expected a frame and arrays, got {entry!s:.80}")
        content = sections.get(section(entry[0]), b"")
        snapshots[entry[0]] = _arrays(lists("snapshots", entry[1]), content)
    return snapshots


def _arrays(entries: list[list[Any]], content: bytes) -> dict[str, Array]:
    """Arrays that follow each other in `content`, copied."""
    arrays, start = {}, 0
    for entry in entries:
        name, dtype, shape = _description(entry)
        size = math.prod(shape) * dtype.itemsize
        if size > len(content) - start:
            raise ReplayError(f"snapshots: expected {size} bytes for {name:.80}, got fewer")
        array = np.frombuffer(content, dtype, math.prod(shape), start)
        arrays[name] = array.reshape(shape).copy()
        start += size
    if start != len(content):
        raise ReplayError(f"snapshots: expected {start} bytes, got {len(content)}")
    return arrays


def _description(entry: list[Any]) -> tuple[str, np.dtype[Any], list[int]]:
    """Name, type and shape of an array."""
    if [type(part) for part in entry] != [str, str, list] or len(entry[2]) > _MAX_DIMENSIONS:
        raise ReplayError(f"snapshots: expected name, type and shape, got {entry!s:.80}")
    name, kind, shape = entry
    if not all(type(length) is int and 0 <= length < _MAX_LENGTH for length in shape):
        raise ReplayError(f"snapshots: expected a shape, got {shape!s:.80}")
    try:
        dtype = np.dtype(kind)
    except (TypeError, ValueError, SyntaxError):
        raise ReplayError(f"snapshots: expected a type of numbers, got {kind!r:.80}") from None
    if dtype.kind not in _KINDS or dtype.str != kind:
        raise ReplayError(f"snapshots: expected a type of numbers, got {kind!r:.80}")
    return name, dtype, shape


def restore_row(rows: Floats, frame: int, arrays: Mapping[str, Array]) -> None:
    """Overwrite a row by the exact one of its snapshot.

    Args:
        rows: (f, row) rows; changed in place.
        frame: index of the frame.
        arrays: arrays of the snapshot.

    Raises:
        ReplayError: the snapshot has no such row, or it is not finite.
    """
    exact = arrays.get("frame")
    if exact is None or exact.shape != (1, rows.shape[1]) or exact.dtype != np.float32:
        raise ReplayError(f"snapshots: expected a row of {rows.shape[1]} numbers in 'frame'")
    if not np.isfinite(exact).all():
        raise ReplayError("snapshots: expected finite numbers in 'frame'")
    rows[frame] = exact[0]
