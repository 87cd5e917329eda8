"""Random, cut and changed bytes through all readers of messages.

python -m tools.protocols.fuzz [--packets 1000000] [--seed 0]

A third of the packets are random bytes, a third are messages cut off or with changed bytes, and a
third are messages with wild values. Nothing but `MessageError` may be raised, and no number that
is not finite may come out.
"""

from __future__ import annotations

import argparse
import math
import random
import time
from collections import Counter
from typing import Any, Final

import numpy as np
from google.protobuf.descriptor import FieldDescriptor
from google.protobuf.message import Message

from rsoccer.frame import Frame
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.parsing import is_repeated, parse
from rsoccer.protocols.placing import Placement
from tools.protocols.readers import READERS, Reader
from tools.protocols.samples import FLOATS, sample

_WILD: Final = (math.nan, math.inf, -math.inf, 0.0, -1e38, 1e38, 1e9, -1e9, 1e8, 0.5)
_EDGES: Final = {
    FieldDescriptor.TYPE_INT32: (-(2**31), 2**31 - 1, -1, 0),
    FieldDescriptor.TYPE_INT64: (-(2**63), 2**63 - 1, -1, 0),
    FieldDescriptor.TYPE_SINT64: (-(2**63), 2**63 - 1, -1, 0),
    FieldDescriptor.TYPE_UINT32: (2**32 - 1, 2**31, 0, 7),
    FieldDescriptor.TYPE_UINT64: (2**64 - 1, 2**63, 0, 7),
}


def packet(reader: Reader, rng: random.Random) -> bytes:
    """Return bytes for a reader.

    Args:
        reader: the reader.
        rng: random numbers.
    """
    kind = rng.randrange(3)
    if kind == 0:
        return rng.randbytes(rng.randrange(200))
    message = sample(reader.kind, rng, share=rng.random())
    if kind == 1:
        return _damaged(message.SerializeToString(), rng)
    _make_wild(message, rng, rng.choice((0.02, 0.3)))
    return message.SerializeToString()


def _damaged(data: bytes, rng: random.Random) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.randrange(4)):
        if changed:
            changed[rng.randrange(len(changed))] = rng.randrange(256)
    return bytes(changed[: rng.randrange(len(changed) + 1)] if rng.random() < 0.5 else changed)


def _make_wild(message: Message, rng: random.Random, share: float) -> None:
    """Replace numbers by extreme ones."""
    for field, content in message.ListFields():
        if field.message_type is not None:
            for part in content if is_repeated(field) else [content]:
                _make_wild(part, rng, share)
        elif not is_repeated(field) and rng.random() < share:
            if field.type in FLOATS:
                setattr(message, field.name, rng.choice(_WILD))
            elif field.type in _EDGES:
                setattr(message, field.name, rng.choice(_EDGES[field.type]))


def check(reader: Reader, data: bytes) -> str:
    """Read bytes and check what comes out.

    Args:
        reader: the reader.
        data: the bytes.

    Returns:
        "read", or the code of the error.

    Raises:
        AssertionError: a number that is not finite came out.
    """
    try:
        result, _ = reader.read(parse(reader.kind, data))
    except MessageError as error:
        return str(error.code)
    assert finite(result), f"{reader.kind.DESCRIPTOR.full_name}: {data!r}"
    return "read"


def finite(result: Any) -> bool:  # noqa: ANN401  (any result)
    """Return whether all numbers in a result are finite.

    Args:
        result: what a reader made of a message.
    """
    if isinstance(result, Frame):
        return bool(np.isfinite(result.rows).all())
    if isinstance(result, np.ndarray):
        return bool(np.isfinite(result).all())
    if isinstance(result, float):
        return math.isfinite(result)
    if isinstance(result, Placement):
        return finite(result.row)
    if isinstance(result, dict):
        return all(map(finite, result.values()))
    if isinstance(result, tuple | list):
        return all(map(finite, result))
    if hasattr(result, "__dataclass_fields__"):
        return all(finite(getattr(result, name)) for name in result.__dataclass_fields__)
    return True


def fuzz(packets: int, seed: int) -> Counter[str]:
    """Send packets through all readers in turn.

    Args:
        packets: number of packets.
        seed: seed of the random numbers.

    Returns:
        Numbers of packets by outcome: "read", or the code of the error.

    Raises:
        AssertionError: a number that is not finite came out.
    """
    rng, outcomes = random.Random(seed), Counter[str]()
    for number in range(packets):
        reader = READERS[number % len(READERS)]
        outcomes[check(reader, packet(reader, rng))] += 1
    return outcomes


def main() -> None:
    """Send packets, and print how many had which outcome."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--packets", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    args = parser.parse_args()
    start = time.perf_counter()
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        outcomes = fuzz(args.packets, args.seed)
    print(f"{args.packets} packets in {time.perf_counter() - start:.0f} s")
    for outcome, count in outcomes.most_common():
        print(f"{count:9} {outcome}")


if __name__ == "__main__":
    main()
