"""Container of replay files: a header in JSON and compressed sections of bytes, with a checksum.

    offset  bytes  content
    0       8      magic: 89 52 53 52 0D 0A 1A 0A (".RSR", then line ends that a text mode changes)
    8       4      version of the format, unsigned, little-endian like all numbers
    12      4      h, length of the header
    16      8      length of the file
    24      32     SHA-256 of the bytes before it and of all bytes after it
    56      h      header: JSON in UTF-8, compressed by zlib
    56 + h  ...    sections, each compressed by zlib, without gaps

The key "sections" of the header lists the sections in order: name, compressed and plain length.
"""

from __future__ import annotations

import hashlib
import json
import struct
import zlib
from collections.abc import Mapping
from typing import Any, Final

MAGIC: Final = b"\x89RSR\r\n\x1a\n"
VERSION: Final = 4
"""Version of the format that this module writes, and the only one that it reads."""

_FIXED: Final = struct.Struct("<8sIIQ")
_DIGEST: Final = hashlib.sha256().digest_size
_START: Final = _FIXED.size + _DIGEST
_MAX_RATIO: Final = 1100
"""Largest plain by compressed length: deflate reaches 1032. A larger claim is not allocated."""
_MAX_HEADER: Final = 2**26  # bytes


class ReplayError(ValueError):
    """A replay that cannot be read, written or resumed; the message names the reason."""


def pack(header: Mapping[str, Any], sections: Mapping[str, bytes]) -> bytes:
    """Return the bytes of a file.

    Args:
        header: values for JSON; the key "sections" is added.
        sections: plain bytes by name.

    Returns:
        The file; equal input gives equal bytes.

    Raises:
        ReplayError: a header that is longer than those that are read.
    """
    packed = {name: zlib.compress(content, 9) for name, content in sections.items()}
    listed = [[name, len(part), len(sections[name])] for name, part in packed.items()]
    text = json.dumps({**header, "sections": listed}, separators=(",", ":"), allow_nan=False)
    plain = text.encode()
    if len(plain) > _MAX_HEADER:
        raise ReplayError(
            f"header: expected at most {_MAX_HEADER} bytes, got {len(plain)}; record less time"
        )
    head = zlib.compress(plain, 9)
    body = b"".join([head, *packed.values()])
    fixed = _FIXED.pack(MAGIC, VERSION, len(head), _START + len(body))
    return fixed + hashlib.sha256(fixed + body).digest() + body


def unpack(content: bytes) -> tuple[dict[str, Any], dict[str, bytes]]:
    """Return the header and the plain sections of a file.

    No more memory is allocated than some 1,100 times the length of the file.

    Args:
        content: the file.

    Returns:
        The header, without its list of sections; and the plain bytes of each section by name.

    Raises:
        ReplayError: no replay, another version, an incomplete file or wrong bytes.
    """
    head_size = _checked_head(content)
    text = _inflate("header", content[_START : _START + head_size], None)
    try:
        header = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ReplayError(f"header: expected JSON, got {str(error) or 'deep nesting'}") from None
    if not isinstance(header, dict):
        raise ReplayError(f"header: expected an object, got {type(header).__name__}")
    sections, start = {}, _START + head_size
    for name, packed, plain in _listed(header.pop("sections", None)):
        sections[name] = _inflate(name, content[start : start + packed], plain)
        start += packed
    if start != len(content):
        raise ReplayError(f"sections: expected {len(content)} bytes in total, got {start}")
    return header, sections


def _checked_head(content: bytes) -> int:
    """Length of the header, after checks of magic, version, length and checksum."""
    if content[: len(MAGIC)] != MAGIC:
        raise ReplayError("magic: expected the first bytes of a replay file, got others")
    if len(content) < _START:
        raise ReplayError(f"length: expected at least {_START} bytes, got {len(content)}: cut off")
    _, version, head_size, size = _FIXED.unpack_from(content)
    if version != VERSION:
        raise ReplayError(f"version: expected format {VERSION}, got {version}")
    if size != len(content):
        cut = ": cut off" if len(content) < size else ""
        raise ReplayError(f"length: expected {size} bytes, got {len(content)}{cut}")
    found = hashlib.sha256(content[: _FIXED.size] + content[_START:]).digest()
    if found != content[_FIXED.size : _START]:
        raise ReplayError("checksum: expected SHA-256 of the content, got another: damaged")
    if head_size > len(content) - _START:
        raise ReplayError(
            f"header: expected at most {len(content) - _START} bytes, got {head_size}"
        )
    return int(head_size)


def _listed(value: object) -> list[tuple[str, int, int]]:
    """Name, compressed and plain length of each section, checked."""
    if not isinstance(value, list):
        raise ReplayError(f"sections: expected a list, got {type(value).__name__}")
    listed = []
    for entry in value:
        valid = isinstance(entry, list) and [type(part) for part in entry] == [str, int, int]
        if not valid or min(entry[1:]) < 0 or entry[2] > _MAX_RATIO * (entry[1] + 1):
            raise ReplayError(f"sections: expected a name and two lengths, got {str(entry)[:80]}")
        listed.append((entry[0], entry[1], entry[2]))
    return listed


def _inflate(name: str, packed: bytes, plain: int | None) -> bytes:
    """Decompressed bytes, no longer than `plain`, or than the header may be."""
    limit = min(_MAX_HEADER, _MAX_RATIO * (len(packed) + 1)) if plain is None else plain
    inflater = zlib.decompressobj()
    try:
        content = inflater.decompress(packed, limit + 1)  # 0 would set no limit
    except zlib.error as error:
        raise ReplayError(f"{name}: expected zlib, got {error}") from None
    complete = inflater.eof and not inflater.unused_data
    if not complete or (plain is not None and len(content) != plain):
        expected = "its end" if plain is None else f"{plain} bytes"
        raise ReplayError(f"{name}: expected {expected} after decompression, got {len(content)}")
    return content
