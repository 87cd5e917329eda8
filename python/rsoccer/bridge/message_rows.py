"""Repeated messages of fixed length, written as rows of bytes.

A frame has a message for each robot that differs from the last frame's in numbers alone. Numbers
of single precision have four bytes on the wire, so the bytes of all robots are an array: a template
for each robot, and places at which its numbers stand. Making them so takes a tenth of the time of
setting fields one by one; tests compare both.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array
from rsoccer.protocols.protobuf import Message

_SENTINEL: Final = 1.0e30
"""First of the numbers that mark the places of fields in a template."""


class MessageRows:
    """Templates of a message for each robot, and places of its numbers."""

    def __init__(
        self, slots: int, numbers: int, make: Callable[[int, Sequence[float]], Message]
    ) -> None:
        """Find the places of the numbers.

        Args:
            slots: number of robots.
            numbers: number of numbers in a message.
            make: function (slot, numbers) that returns a message which contains that of a robot,
                and nothing else.

        Raises:
            ValueError: messages of different lengths, or numbers that are not single precision.
        """
        marks = [float(np.float32(_SENTINEL * (1 + mark / 64))) for mark in range(numbers)]
        rows = [make(slot, marks).SerializePartialToString() for slot in range(slots)]
        if len({len(row) for row in rows}) > 1:
            raise ValueError(f"make: expected messages of one length, got {set(map(len, rows))}")
        self._templates = np.array([list(row) for row in rows], np.uint8)
        length = self._templates.shape[1]
        places: list[int] = []
        for mark in marks:
            pattern = np.float32(mark).tobytes()
            found = {row.find(pattern) for row in rows}
            if len(found) != 1 or found == {-1}:
                raise ValueError(f"make: expected each number at one place, got {found}")
            first = found.pop()
            places += range(first, first + len(pattern))
        self._size = len(places)
        # Places in as many messages as there are robots, one after the other.
        starts = length * np.arange(slots)[:, None]
        self._places: NDArray[np.intp] = (starts + np.array(places, np.intp)).ravel()

    def write(self, slots: NDArray[np.intp], numbers: Array) -> bytes:
        """Return the messages of some robots, one after the other.

        Args:
            slots: (m,) robots.
            numbers: (m, numbers) their numbers.
        """
        content = self._templates.take(slots, axis=0).reshape(-1)
        values = np.ascontiguousarray(numbers, np.float32).reshape(-1)
        content[self._places[: self._size * len(slots)]] = values.view(np.uint8)
        return content.tobytes()


def field_of(number: int, content: bytes) -> bytes:
    """Return a field that holds a message.

    Args:
        number: number of the field, 1 to 15.
        content: the message.
    """
    length, head = len(content), [number << 3 | 2]
    while length > 0x7F:
        head.append(length & 0x7F | 0x80)
        length >>= 7
    head.append(length)
    return bytes(head) + content
