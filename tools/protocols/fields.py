"""Fields of all messages, and whether the package honors them: measured, field by field.

A field is read if a change of its value changes what the package makes of the message, or leads to
an error with a code. It is sent if messages that the package writes have it.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import fields, is_dataclass
from functools import cache
from typing import Any, Final, NamedTuple

import numpy as np
from google.protobuf.descriptor import Descriptor, FieldDescriptor
from google.protobuf.message import Message

from benches.markdown import table
from rsoccer import Field, RobotModel
from rsoccer.frame import Frame
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.parsing import is_repeated
from rsoccer.protocols.placing import Placement
from tools.protocols.readers import READERS, UNREAD, Reader, bases, written
from tools.protocols.reasons import reason
from tools.protocols.samples import FLOATS, WHOLE, value

READ, SENT, CONSTANT, NO = "yes", "yes", "constant", "no"
_TRIES: Final = 6
"""Values that are tried for a field of a message."""
_FACTOR: Final = 1.015625
"""Factor of a number that is changed a little, exact in single precision."""
_MAX_TRIED: Final = 24
"""Messages in which a field is tried."""

Key = tuple[str, str]
"""Full name of a message, name of a field."""


class Row(NamedTuple):
    """Use of a field."""

    protocol: str
    """Name of the protocol."""
    message: str
    """Name of the message."""
    field: FieldDescriptor
    """The field."""
    read: str
    """"yes", "no", or the codes of errors."""
    sent: str
    """"yes", "constant" or "no"."""
    reason: str
    """Reason why it is not read; empty if it is."""


@cache
def rows() -> tuple[Row, ...]:
    """Return all fields of all messages."""
    read, sent = _read(), _sent()
    kinds: dict[str, tuple[str, Descriptor]] = {}
    described: list[tuple[str, Any]] = [(each.protocol, each.kind.DESCRIPTOR) for each in READERS]
    described += [(protocol, kind.DESCRIPTOR) for protocol, kind in UNREAD]
    for protocol, packet in described:
        for inner in _inner(packet):
            kinds.setdefault(inner.full_name, (protocol, inner))
    found = []
    for full_name, (protocol, kind) in kinds.items():
        for field in sorted(kind.fields, key=lambda each: each.number):
            key = (full_name, field.name)
            how = (read.get(key, NO), sent.get(key, NO))
            found.append(Row(protocol, kind.name, field, *how, reason(_name(key))))
    return tuple(found)


def _name(key: Key) -> str:
    return f"{key[0].removeprefix('rsoccer.')}.{key[1]}"


def name(row: Row) -> str:
    """Return the name of a field in the list of reasons.

    Args:
        row: the field.
    """
    return _name(_key(row.field))


def _key(field: FieldDescriptor) -> Key:
    kind: Any = field.containing_type
    return kind.full_name, field.name


def _inner(kind: Descriptor, found: dict[str, Descriptor] | None = None) -> list[Descriptor]:
    """A kind of message and all kinds in it, without those of protobuf itself."""
    found = {} if found is None else found
    if kind.full_name not in found and not kind.full_name.startswith("google."):
        found[kind.full_name] = kind
        for field in kind.fields:
            if field.message_type is not None:
                _inner(field.message_type, found)
    return list(found.values())


# -- Reading -----------------------------------------------------------------------------------


def _read() -> dict[Key, str]:
    """Use of each field in messages that are read."""
    used: set[Key] = set()
    codes: dict[Key, set[str]] = {}
    tried: Counter[Key] = Counter()
    for reader in READERS:
        rng = random.Random(1)
        for base in bases(reader.kind):
            before = _result(reader, base)
            for path in _paths(base):
                key = _key(path[-1][0])
                tried[key] += 1
                if key in used or tried[key] > _MAX_TRIED:
                    continue
                for _ in range(_TRIES):
                    changed = type(base)()
                    changed.CopyFrom(base)
                    _change(changed, path, rng)
                    after = _result(reader, changed)
                    reported = _reported(path[-1][0], before, after)
                    if reported:
                        codes.setdefault(key, set()).update(reported)
                    elif after[0] != before[0]:
                        used.add(key)
                        break
    errors = {key: ", ".join(sorted(f"`{code}`" for code in codes[key])) for key in codes}
    return errors | dict.fromkeys(used, READ)


_Result = tuple[object, Counter[str]]


def _reported(field: FieldDescriptor, before: _Result, after: _Result) -> set[str]:
    """Errors that tell of a field: they come or go with its value, or go with the whole field."""
    if field.message_type is None and not is_repeated(field):
        return {*(after[1] - before[1]), *(before[1] - after[1])}
    return {*(before[1] - after[1])} if before[0] == after[0] else set()


def _result(reader: Reader, message: Message) -> _Result:
    """Meaning of a message, and codes of errors."""
    try:
        result, problems = reader.read(message)
    except MessageError as error:
        return None, Counter([str(error.code)])
    return _plain(result), Counter(str(problem[0]) for problem in problems)


def _plain(result: Any) -> object:  # noqa: ANN401  (any result)
    """A result in values that can be compared; without problems."""
    for kind, make in _PLAIN.items():
        if isinstance(result, kind):
            return make(result)
    names = [field.name for field in fields(result)] if is_dataclass(result) else []
    names = names or list(getattr(result, "_fields", ()))
    if names:
        return tuple(_plain(getattr(result, each)) for each in names if each != "problems")
    if isinstance(result, tuple | list):
        return tuple(map(_plain, result))
    if isinstance(result, dict):
        return _plain(list(result.items()))
    return result


_PLAIN: Final[dict[type, Callable[[Any], object]]] = {
    np.ndarray: lambda array: (array.shape, array.tobytes()),
    Frame: lambda frame: frame.rows.tobytes(),
    Field: Field.to_json,
    RobotModel: RobotModel.to_json,
    Placement: lambda made: _plain((made.row, made.ball, made.robots, made.safely)),
}
"""From results of these types to values that can be compared."""


Path = tuple[tuple[FieldDescriptor, int], ...]


def _paths(message: Message, outer: Path = ()) -> Iterator[Path]:
    """Yield the way to each field that is set: fields, and places in their lists."""
    for field, content in message.ListFields():
        yield (*outer, (field, 0))
        if field.message_type is None or field.message_type.full_name.startswith("google."):
            continue
        parts = content if is_repeated(field) else [content]
        for place, part in enumerate(parts):
            if len(outer) < 5:
                yield from _paths(part, (*outer, (field, place)))


def _change(message: Message, path: Path, rng: random.Random) -> None:
    """Change the last field of a path."""
    target: Any = message
    for field, place in path[:-1]:
        target = getattr(target, field.name)
        target = target[place] if is_repeated(field) else target
    field = path[-1][0]
    if field.message_type is not None:
        if is_repeated(field):
            getattr(target, field.name).pop()
        else:
            target.ClearField(field.name)
    elif is_repeated(field):
        getattr(target, field.name).append(value(field, rng))
    elif field.type in WHOLE and rng.random() < 0.5:
        setattr(target, field.name, getattr(target, field.name) + 1)
    elif field.type in FLOATS and rng.random() < 0.5:
        setattr(target, field.name, getattr(target, field.name) * _FACTOR)
    else:
        setattr(target, field.name, value(field, rng))


# -- Sending -----------------------------------------------------------------------------------


def _sent() -> dict[Key, str]:
    """Use of each field in messages that are sent."""
    values: dict[Key, set[object]] = {}
    counts: dict[Key, int] = {}
    for message in written():
        for part in _parts(message):
            for field, content in part.ListFields():
                key = (part.DESCRIPTOR.full_name, field.name)
                counts[key] = counts.get(key, 0) + 1
                plain = repr(content) if field.message_type is None else str(content)
                values.setdefault(key, set()).add(plain)
    return {
        key: CONSTANT if len(found) == 1 and counts[key] > 1 else SENT
        for key, found in values.items()
    }


def _parts(message: Message) -> Iterator[Message]:
    """Yield a message and all messages in it."""
    yield message
    for field, content in message.ListFields():
        if field.message_type is not None and not field.message_type.full_name.startswith("google"):
            for part in content if is_repeated(field) else [content]:
                yield from _parts(part)


# -- The page ----------------------------------------------------------------------------------


def field_tables() -> str:
    """Return the tables of all fields, one for each protocol."""
    protocols = dict.fromkeys(row.protocol for row in rows())
    return "\n\n".join(f"### Fields: {each}\n\n{_table(each)}" for each in protocols)


def _table(protocol: str) -> str:
    lines = [
        (
            f"`{row.message}.{row.field.name}`",
            str(row.field.number),
            row.read,
            row.sent,
            row.reason,
        )
        for row in rows()
        if row.protocol == protocol
    ]
    return table(("field", "number", "read", "sent", "reason"), lines)


def counts() -> str:
    """Return the table of the numbers of fields."""
    protocols = dict.fromkeys(row.protocol for row in rows())
    lines = [_counts(each, [row for row in rows() if row.protocol == each]) for each in protocols]
    lines.append(_counts("all", rows()))
    return table(("protocol", "fields", "read", "answered by an error", "sent", "neither"), lines)


def _counts(protocol: str, group: Iterable[Row]) -> tuple[str, ...]:
    group = list(group)
    read = sum(row.read == READ for row in group)
    refused = sum(row.read not in (READ, NO) for row in group)
    sent = sum(row.sent != NO for row in group)
    neither = sum(row.read == NO and row.sent == NO for row in group)
    return (protocol, *map(str, (len(group), read, refused, sent, neither)))
