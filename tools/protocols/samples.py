"""Random messages with all fields, of any kind."""

from __future__ import annotations

import random
from typing import Any, Final, cast

from google.protobuf.descriptor import FieldDescriptor
from google.protobuf.message import Message

from rsoccer.protocols.parsing import is_repeated

MAX_DEPTH: Final = 5
"""Greatest depth of messages in messages: an event may be the cause of another one."""
ROBOTS: Final = 6
"""Uniform numbers are below this."""
_LABEL_REQUIRED: Final = 2
WHOLE: Final = {
    FieldDescriptor.TYPE_INT32,
    FieldDescriptor.TYPE_INT64,
    FieldDescriptor.TYPE_SINT64,
    FieldDescriptor.TYPE_UINT32,
    FieldDescriptor.TYPE_UINT64,
}
"""Types of whole numbers."""
FLOATS: Final = {FieldDescriptor.TYPE_FLOAT, FieldDescriptor.TYPE_DOUBLE}
"""Types of numbers with a point."""


def sample(kind: type[Message], rng: random.Random, share: float = 1.0) -> Message:
    """Return a message of a kind.

    Args:
        kind: class of the message.
        rng: random numbers.
        share: probability that an optional field is set.

    Returns:
        A message with all required fields. Numbers are from 0.1 to 1, uniform numbers below
        `ROBOTS`, lists have one or two entries.
    """
    message = kind()
    fill(message, rng, share)
    return message


def fill(message: Message, rng: random.Random, share: float = 1.0, depth: int = 0) -> None:
    """Set the fields of a message.

    Args:
        message: the message.
        rng: random numbers.
        share: probability that an optional field is set.
        depth: number of messages around it.
    """
    kind: Any = message.DESCRIPTOR
    chosen = {group.name: rng.choice(group.fields).name for group in kind.oneofs}
    for field in kind.fields:
        group = field.containing_oneof
        if group is not None and group.name in chosen and chosen[group.name] != field.name:
            continue
        inner = field.message_type
        if inner is not None and depth >= MAX_DEPTH and not required(field):
            continue
        if required(field) or rng.random() < share:
            _set(message, field, rng, share, depth)


def required(field: FieldDescriptor) -> bool:
    """Return whether a message without the field is refused.

    Args:
        field: the field.
    """
    needed = getattr(field, "is_required", None)  # since protobuf 6.31; then `label` goes
    return bool(cast(Any, field).label == _LABEL_REQUIRED if needed is None else needed)


def _set(
    message: Message, field: FieldDescriptor, rng: random.Random, share: float, depth: int
) -> None:
    target: Any = getattr(message, field.name)
    if is_repeated(field):
        for _ in range(rng.randint(1, 2)):
            if field.message_type is not None:
                fill(target.add(), rng, share, depth + 1)
            else:
                target.append(value(field, rng))
    elif field.message_type is not None:
        target.SetInParent()
        fill(target, rng, share, depth + 1)
    else:
        setattr(message, field.name, value(field, rng))


def value(field: FieldDescriptor, rng: random.Random) -> Any:  # noqa: ANN401  (any type)
    """Return a value of a field that has no message.

    Args:
        field: the field.
        rng: random numbers.
    """
    if field.type in FLOATS:
        return rng.randint(1, 16) / 16  # exact in single precision
    if field.type in WHOLE:
        return rng.randrange(ROBOTS)
    if field.type == FieldDescriptor.TYPE_BOOL:
        return rng.random() < 0.5
    if field.type == FieldDescriptor.TYPE_ENUM:
        return rng.choice(cast(Any, field).enum_type.values).number
    if field.type == FieldDescriptor.TYPE_BYTES:
        return rng.randbytes(3)
    return "".join(rng.choice("abcxyz") for _ in range(4))
