"""From bytes to messages that are safe to use: readable, complete, and finite."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any, Final, TypeVar, cast

from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.protobuf import DecodeError, Descriptor, FieldDescriptor, Message

MAX_SIZE: Final = 65507
"""Greatest length of a message in bytes: that of the content of a UDP datagram over IPv4."""
MAX_MAGNITUDE: Final = 1e9
"""Greatest magnitude of a number: single precision can still square it."""

MAX_ROBOTS: Final = 128
"""Greatest number of robots that a message commands, puts or describes: four times the 32 that the
protocols can tell apart. A datagram has room for 16,000, which take longer to read than a tick."""

MAX_EVENTS: Final = 256
"""Greatest number of events of a match in a message: referees list those since play stopped."""

LABEL_REPEATED: Final = 3
"""Label of a field with a list of values."""

_M = TypeVar("_M", bound=Message)
_FLOATS: Final = (FieldDescriptor.TYPE_FLOAT, FieldDescriptor.TYPE_DOUBLE)
_ROBOTS: Final = frozenset({"robot_commands", "teleport_robot", "robot_specs", "robots"})
"""Fields with a list of robots."""
_MOST: Final = {
    **dict.fromkeys(_ROBOTS, (MAX_ROBOTS, "robots")),
    "game_events": (MAX_EVENTS, "events"),
    "game_event_proposals": (MAX_EVENTS, "groups of events"),
}
"""Greatest number of entries of lists, and words for them."""
_TIMES: Final = frozenset(
    {
        *("t_capture", "t_sent", "t_capture_camera"),
        *("timestamp", "start_timestamp", "stop_timestamp"),
    }
)
"""Fields that may be larger: Unix time in seconds exceeds the magnitude of lengths."""


def parse(kind: type[_M], data: bytes) -> _M:
    """Return the message in the bytes of a datagram.

    Args:
        kind: class of the message.
        data: the bytes.

    Returns:
        A message with all required fields whose numbers are finite and below `MAX_MAGNITUDE`;
        time stamps only finite. Its lists of robots have at most `MAX_ROBOTS` entries, those of
        events `MAX_EVENTS`.

    Raises:
        MessageError: anything else. No other error is raised, whatever the bytes are.
    """
    if len(data) > MAX_SIZE:
        raise MessageError(
            Code.TOO_LARGE, f"message: expected at most {MAX_SIZE} bytes, got {len(data)}"
        )
    message = kind()
    try:
        message.ParseFromString(data)
    except (DecodeError, RecursionError, UnicodeDecodeError, ValueError) as error:
        raise MessageError(
            Code.UNREADABLE, f"message: expected a {kind.DESCRIPTOR.full_name}: {error}"
        ) from None
    if not message.IsInitialized():
        missing = ", ".join(cast(Any, message).FindInitializationErrors())
        raise MessageError(Code.UNREADABLE, f"message: expected the fields {missing:.200}")
    check_finite(message)
    return message


def check_finite(message: Message) -> None:
    """Refuse numbers that are not finite or too large to compute with, and endless lists.

    Args:
        message: the message.

    Raises:
        MessageError: a number is NaN, infinite, or beyond `MAX_MAGNITUDE`; or a list of robots has
            more than `MAX_ROBOTS` entries, or one of events more than `MAX_EVENTS`.
    """
    check = _checker(message.DESCRIPTOR)
    if check is not None:
        check(message)


@cache
def _has_floats(kind: Descriptor, outer: frozenset[str] = frozenset()) -> bool:
    """Whether messages of a kind contain numbers with a point, at any depth."""
    if kind.full_name in outer:
        return False
    outer |= {kind.full_name}
    return any(
        field.type in _FLOATS
        or (field.message_type is not None and _has_floats(field.message_type, outer))
        for field in kind.fields
    )


@cache
def _checker(kind: Descriptor) -> Callable[[Message], None] | None:
    """The check of messages of a kind; None if they have no such numbers."""
    return _check if _has_floats(kind) else None


def _check_length(name: str, length: int) -> None:
    most, words = _MOST[name]
    if length > most:
        text = f"{name}: expected at most {most} {words}, got {length}"
        raise MessageError(Code.TOO_LARGE, text)


def _check(message: Message) -> None:
    for field, value in message.ListFields():
        if field.name in _MOST and is_repeated(field):
            _check_length(field.name, len(value))
        if field.type in _FLOATS:
            limit = math.inf if field.name in _TIMES else MAX_MAGNITUDE
            for number in value if is_repeated(field) else (value,):
                if not abs(number) < limit:  # refuses NaN too
                    name = f"{message.DESCRIPTOR.name}.{field.name}"
                    raise MessageError(
                        Code.NOT_FINITE,
                        f"{name}: expected a finite number below {MAX_MAGNITUDE:g}, got {number}",
                    )
        elif field.message_type is not None and _checker(field.message_type) is not None:
            for part in value if is_repeated(field) else (value,):
                _check(part)


@cache
def is_repeated(field: FieldDescriptor) -> bool:
    """Return whether a field has a list of values.

    Args:
        field: the field.
    """
    repeated = getattr(field, "is_repeated", None)  # since protobuf 6.31; then `label` goes
    return bool(cast(Any, field).label == LABEL_REPEATED if repeated is None else repeated)
