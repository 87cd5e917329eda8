"""Errors of messages: one exception for what cannot be used, and codes that never change."""

from enum import StrEnum
from typing import Final, NamedTuple

MAX_PROBLEMS: Final = 32
"""Problems of a message that are listed, so that the answer fits into a datagram."""


class Code(StrEnum):
    """Stable code of an error, for programs. Answers on the network carry it too."""

    UNREADABLE = "UNREADABLE"
    """The bytes are no message of the kind, are cut off, or lack a required field."""
    TOO_LARGE = "TOO_LARGE"
    """The message is longer than its port takes, or has more robots or events than any match."""
    NOT_FINITE = "NOT_FINITE"
    """A number is NaN or infinite, or too large for the simulator."""
    OUT_OF_RANGE = "OUT_OF_RANGE"
    """A number or a choice has a value that the field does not allow."""
    UNKNOWN_TEAM = "UNKNOWN_TEAM"
    """The message names no team, or one that does not play."""
    UNKNOWN_ROBOT = "UNKNOWN_ROBOT"
    """The team has no robot of this number."""
    DUPLICATE_ROBOT = "DUPLICATE_ROBOT"
    """The message names a robot twice; the first entry counts."""
    INCOMPLETE = "INCOMPLETE"
    """A field is missing without which another one has no meaning."""
    INVALID_SPEC = "INVALID_SPEC"
    """The numbers of a robot are not those of a robot that can exist."""
    UNSUPPORTED_MOVE = "UNSUPPORTED_MOVE"
    """The drive of the robot cannot follow this kind of command."""
    UNSUPPORTED_KICK = "UNSUPPORTED_KICK"
    """The robot has no kicker."""
    UNSUPPORTED_DRIBBLER = "UNSUPPORTED_DRIBBLER"
    """The robot has no dribbler."""
    UNSUPPORTED_BY_FORCE = "UNSUPPORTED_BY_FORCE"
    """Bodies cannot be pulled to a place; teleport them."""
    UNSUPPORTED_GEOMETRY = "UNSUPPORTED_GEOMETRY"
    """The field of a running simulation cannot be changed."""
    UNSUPPORTED_REALISM = "UNSUPPORTED_REALISM"
    """Senses have no such configuration; presets are chosen when the simulator starts."""
    UNSUPPORTED_CUSTOM = "UNSUPPORTED_CUSTOM"
    """Custom messages of other simulators are not known."""
    UNSUPPORTED_COMMAND = "UNSUPPORTED_COMMAND"
    """The protocol has no such command of the referee, or rSoccer has none."""
    UNSUPPORTED_EVENT = "UNSUPPORTED_EVENT"
    """The protocol has no such event, or rSoccer has none."""
    BAD_LOG = "BAD_LOG"
    """The file is no log, is of another version, or damaged."""
    CUT_OFF = "CUT_OFF"
    """The file of a log ends within a message, as after a writer that was killed."""
    MORE_PROBLEMS = "MORE_PROBLEMS"
    """The message has more problems than are listed; the text has the number of the others."""


class MessageError(ValueError):
    """A message cannot be used; nothing of it was.

    Attributes:
        code: stable code.
    """

    def __init__(self, code: Code, message: str) -> None:
        """Describe the error.

        Args:
            code: stable code.
            message: the field, what was expected and what came.
        """
        super().__init__(message)
        self.code = code

    def __reduce__(self) -> tuple[type["MessageError"], tuple[Code, str]]:
        return MessageError, (self.code, str(self))


class Problem(NamedTuple):
    """A part of a message that was not honored; the rest was."""

    code: Code
    """Stable code."""
    message: str
    """The field, what was expected and what came."""


class Problems:
    """Problems of a message while it is read: the first ones, and the number of the others."""

    def __init__(self) -> None:
        """Begin without problems."""
        self._first: list[Problem] = []
        self._others = 0

    def add(self, error: MessageError) -> None:
        """List a part of the message that is not honored.

        Args:
            error: the reason.
        """
        if len(self._first) < MAX_PROBLEMS:
            self._first.append(Problem(error.code, str(error)))
        else:
            self._others += 1

    def listed(self) -> list[Problem]:
        """Return the first `MAX_PROBLEMS` problems, and one with the number of the others."""
        if not self._others:
            return list(self._first)
        text = f"message: expected at most {MAX_PROBLEMS} problems, got {self._others} more"
        return [*self._first, Problem(Code.MORE_PROBLEMS, text)]
