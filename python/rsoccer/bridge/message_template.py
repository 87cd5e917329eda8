"""Messages of a client that differ from an earlier one in numbers alone.

A client sends the same robots and fields again and again. Numbers of single precision have four
bytes on the wire, so a message with the same other bytes is an array of numbers at known places.
A test compares what both ways of reading give.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats, Mask
from rsoccer.protocols.commands import FULL_DRIBBLER_RPM
from rsoccer.protocols.parsing import MAX_MAGNITUDE
from rsoccer.protocols.schemas import simulation_pb2

_MARK: Final = 1.0e30
"""First of the numbers that mark places."""
_VELOCITY: Final = ("forward", "left", "angular")
_FIELDS: Final = ("kick_speed", "kick_angle", "dribbler_speed")
_KICK, _ANGLE, _DRIBBLER = range(3, 6)  # columns beside the velocity, in the order of both
_COLUMNS: Final = len(_VELOCITY) + len(_FIELDS)
_SINGLE: Final = np.dtype("<f4")
_GREATEST: Final = np.nextafter(np.float32(MAX_MAGNITUDE), np.float32(0.0))


class MessageTemplate:
    """Bytes of a message, and the places of its numbers.

    Attributes:
        given: (robots,) robots that the message has.
        moved: (robots,) robots whose velocity it has.
    """

    def __init__(
        self,
        message: simulation_pb2.RobotControl,
        data: bytes,
        slots: Mapping[int, int],
        robots: int,
    ) -> None:
        """Find the places of the numbers.

        Args:
            message: a message that commands known robots with local velocities.
            data: its bytes.
            slots: indices in a state row by number of the robot.
            robots: number of robots in a state row.

        Raises:
            ValueError: bytes in which the places cannot be found, as of another encoder.
        """
        marked = simulation_pb2.RobotControl()
        marked.CopyFrom(message)
        places: list[tuple[int, int]] = []  # slot and column of each number
        for command in marked.robot_commands:
            slot = slots[command.id]
            if command.HasField("move_command"):
                local = command.move_command.local_velocity
                for column, name in enumerate(_VELOCITY):
                    setattr(local, name, _mark(len(places)))
                    places.append((slot, column))
            for column, name in enumerate(_FIELDS, len(_VELOCITY)):
                if command.HasField(name):
                    setattr(command, name, _mark(len(places)))
                    places.append((slot, column))
        if not places:
            raise ValueError("message: expected numbers, got none")
        first = _starts(marked.SerializeToString(), len(data), len(places))
        self._numbers: NDArray[np.intp] = (np.array(first)[:, None] + np.arange(4)).ravel()
        self._others = np.full(len(data), 0xFF, np.uint8)
        self._others[self._numbers] = 0
        self._bytes = self._without_numbers(data)
        if self._without_numbers(marked.SerializeToString()) != self._bytes:
            raise ValueError("data: expected the encoding of this package, got another one")
        self.given: Mask = np.zeros(robots, np.bool_)
        self.given[[slots[command.id] for command in message.robot_commands]] = True
        self.moved: Mask = np.zeros(robots, np.bool_)
        rows, columns = np.array(places).T
        self.moved[rows[columns == 0]] = True
        self._prepare_conversion(rows, columns)

    def _prepare_conversion(self, rows: NDArray[np.intp], columns: NDArray[np.intp]) -> None:
        """Prepare what turns the numbers of a message into commands.

        Args:
            rows: (numbers,) robot of each number.
            columns: (numbers,) column of each number, with one for the angle.
        """
        angles, dribblers = columns == _ANGLE, columns == _DRIBBLER
        self._greatest: Floats = np.full(len(columns), _GREATEST, np.float32)
        self._least = -self._greatest
        self._least[(columns == _KICK) | dribblers] = 0.0
        self._least[angles] = self._greatest[angles] = 0.0  # a chip is read otherwise
        self._units = np.where(dribblers, FULL_DRIBBLER_RPM, 1.0)
        self._caps = np.where(dribblers, 1.0, np.inf)
        self._kept = np.flatnonzero(~angles)
        self._stored = (rows * _COLUMNS + columns)[self._kept]
        kicks = np.flatnonzero(self.given)[:, None] * _COLUMNS + [_KICK, _KICK + 1]
        self._ended = kicks.ravel()  # a kick holds until the next command

    def read(self, data: bytes, previous: Floats) -> Floats | None:
        """Return commands (robots, command) of a message; None if it has to be read otherwise.

        Args:
            data: the bytes, as many as the template has.
            previous: (robots, command) commands that hold where the message has no number.
        """
        if self._without_numbers(data) != self._bytes:
            return None
        numbers = np.frombuffer(data, np.uint8).take(self._numbers).view(_SINGLE)
        within = (numbers >= self._least) & (numbers <= self._greatest)  # refuses NaN too
        if np.count_nonzero(within) < len(within):
            return None
        values = np.minimum(numbers / self._units, self._caps)
        commands = previous.copy()
        cells = commands.reshape(-1)
        cells[self._ended] = 0.0
        cells[self._stored] = values.take(self._kept)
        return commands

    def _without_numbers(self, data: bytes) -> bytes:
        """The bytes of a message, with zeros at the places of numbers."""
        return (np.frombuffer(data, np.uint8) & self._others).tobytes()


def _mark(nth: int) -> float:
    """The number that marks a place."""
    return float(np.float32(_MARK * (1 + nth / 256)))


def _starts(marked: bytes, length: int, count: int) -> Sequence[int]:
    """Places of all marks in bytes of the given length."""
    patterns = [np.float32(_mark(nth)).tobytes() for nth in range(count)]
    found = [marked.find(pattern) for pattern in patterns]
    if len(marked) != length or min(found) < 0 or len(set(found)) < count:
        raise ValueError("data: expected the encoding of this package, got another one")
    return found
