import hashlib
import json
import struct
import tracemalloc
import zlib

import pytest

from rsoccer.replay import ReplayError, container
from rsoccer.replay.container import MAGIC, pack, unpack

HEADER = {"a": 1, "b": [1.5, "text"]}
SECTIONS = {"one": b"\x00" * 1000, "two": bytes(range(256)), "none": b""}


def signed(head: bytes, body: bytes = b"", version: int = 4, magic: bytes = MAGIC) -> bytes:
    """A file whose lengths and checksum are right, whatever it holds."""
    fixed = struct.pack("<8sIIQ", magic, version, len(head), 56 + len(head) + len(body))
    return fixed + hashlib.sha256(fixed + head + body).digest() + head + body


def with_sections(sections: object, body: bytes = b"") -> bytes:
    return signed(zlib.compress(json.dumps({"sections": sections}).encode()), body)


def test_content_comes_back() -> None:
    content = pack(HEADER, SECTIONS)
    assert unpack(content) == (HEADER, SECTIONS)
    assert pack(HEADER, SECTIONS) == content
    assert len(content) < 600


def test_the_layout_is_the_documented_one() -> None:
    content = pack(HEADER, {})
    magic, version, head, size = struct.unpack_from("<8sIIQ", content)
    assert (magic, version, size) == (b"\x89RSR\r\n\x1a\n", 4, len(content))
    assert hashlib.sha256(content[:24] + content[56:]).digest() == content[24:56]
    assert json.loads(zlib.decompress(content[56 : 56 + head])) == {**HEADER, "sections": []}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "magic"),
        (b"PK\x03\x04" * 30, "magic: expected the first bytes of a replay file"),
        (MAGIC, "length: expected at least 56 bytes, got 8: cut off"),
        (signed(b"", version=1), "version: expected format 4, got 1"),
        (pack(HEADER, SECTIONS)[:-1], "cut off"),
        (pack(HEADER, SECTIONS) + b"\x00", r"length: expected \d+ bytes, got \d+$"),
        (signed(b"no zlib"), "header: expected zlib"),
        (signed(zlib.compress(b"{")), "header: expected JSON"),
        (signed(zlib.compress(b"[" * 100_000)), "header: expected JSON"),
        (signed(zlib.compress(b"[]")), "header: expected an object, got list"),
        (signed(zlib.compress(b"{}")[:-4]), "header: expected its end"),
        (with_sections(None), "sections: expected a list"),
        (with_sections([["rows", 1]]), "sections: expected a name and two lengths"),
        (with_sections([["rows", True, 1]]), "sections: expected a name and two lengths"),
        (with_sections([["rows", -1, 0]]), "sections: expected a name and two lengths"),
        (with_sections([["rows", 10, 10**9]]), "sections: expected a name and two lengths"),
        (with_sections([["rows", 11, 5]], zlib.compress(b"abc")), "rows: expected 5 bytes"),
        (with_sections([["rows", 11, 2]], zlib.compress(b"abc")), "rows: expected 2 bytes"),
        (with_sections([], b"more"), "sections: expected"),
    ],
)
def test_bad_files_are_refused_by_name(content: bytes, message: str) -> None:
    with pytest.raises(ReplayError, match=message):
        unpack(content)


def test_a_changed_byte_is_found() -> None:
    content = bytearray(pack(HEADER, SECTIONS))
    content[-3] ^= 1
    with pytest.raises(ReplayError, match="checksum"):
        unpack(bytes(content))


def test_a_bomb_is_not_unpacked() -> None:
    bomb = zlib.compress(bytes(2**26), 9)
    for content in (
        with_sections([["rows", len(bomb), 100]], bomb),
        signed(zlib.compress(b" " * 2**27, 9)),
    ):
        tracemalloc.start()
        with pytest.raises(ReplayError):
            unpack(content)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 2**28


def test_a_header_that_could_not_be_read_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(container, "_MAX_HEADER", 100)
    with pytest.raises(ReplayError, match="header: expected at most 100 bytes, got 1"):
        pack({"text": "x" * 100}, {})
    assert unpack(pack({"text": "x"}, {}))[0] == {"text": "x"}
