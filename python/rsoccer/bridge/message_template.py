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
        self._others = np.setdiff1d(np.arange(len(data)), self._numbers)
        self._bytes = np.frombuffer(data, np.uint8)[self._others]
        if not np.array_equal(
            np.frombuffer(marked.SerializeToString(), np.uint8)[self._others], self._bytes
        ):
            raise ValueError("data: expected the encoding of this package, got another one")
        rows, columns = np.array(places).T
        self._rows, self._columns = rows, columns
        self._kicks, self._angles, self._dribblers = (
            np.flatnonzero(columns == column) for column in (_KICK, _ANGLE, _DRIBBLER)
        )
        self.given: Mask = np.zeros(robots, np.bool_)
        self.given[[slots[command.id] for command in message.robot_commands]] = True
        self.moved: Mask = np.zeros(robots, np.bool_)
        self.moved[rows[columns == 0]] = True
        self._stored = np.where(columns == _ANGLE, _ANGLE - 1, columns)
        self._kept = columns != _ANGLE

    def read(self, data: bytes, previous: Floats) -> Floats | None:
        """Return commands (robots, command) of a message; None if it has to be read otherwise.

        Args:
            data: the bytes, as many as the template has.
            previous: (robots, command) commands that hold where the message has no number.
        """
        raw = np.frombuffer(data, np.uint8)
        if not np.array_equal(raw[self._others], self._bytes):
            return None
        numbers = raw[self._numbers].view("<f4").astype(np.float64)
        if not (np.abs(numbers) < MAX_MAGNITUDE).all():  # refuses NaN too
            return None
        if numbers[self._angles].any():  # a chip
            return None
        if (numbers[self._kicks] < 0.0).any() or (numbers[self._dribblers] < 0.0).any():
            return None
        shares = numbers[self._dribblers] / FULL_DRIBBLER_RPM
        numbers[self._dribblers] = np.minimum(shares, 1.0)
        commands = previous.copy()
        commands[self.given, _KICK : _KICK + 2] = 0.0  # a kick holds until the next command
        commands[self._rows[self._kept], self._stored[self._kept]] = numbers[self._kept]
        return commands


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
