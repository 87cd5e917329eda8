"""Log files of the SSL."""

import random
import struct
from pathlib import Path

import pytest

from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.logs import LogEntry, LogKind, LogWriter, read_index, read_log
from rsoccer.protocols.schemas import referee_pb2, tracker_pb2, vision_pb2
from tools.protocols.samples import sample

ENTRIES = [
    LogEntry(0, LogKind.VISION, b"abc"),
    LogEntry(1_700_000_000_123_456_789, LogKind.REFEREE, b""),
    LogEntry(2**63 - 1, 17, bytes(range(256))),
]


def write(path: Path, *, index: bool = False) -> Path:
    with LogWriter(path, index=index) as log:
        for entry in ENTRIES:
            log.write(*entry)
    return path


@pytest.mark.parametrize("name", ["a.log", "a.log.gz"])
def test_messages_survive(name: str, tmp_path: Path) -> None:
    path = write(tmp_path / name)
    assert list(read_log(path)) == ENTRIES
    assert (path.read_bytes()[:2] == b"\x1f\x8b") is name.endswith(".gz")
    assert read_index(path) is None


def test_bytes_are_those_of_the_format(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    with LogWriter(path, index=True) as log:
        log.write(258, LogKind.VISION, b"xyz")
        log.write(259, LogKind.TRACKER, b"")
    first = b"\0\0\0\0\0\0\1\2" + b"\0\0\0\4" + b"\0\0\0\3" + b"xyz"
    second = b"\0\0\0\0\0\0\1\3" + b"\0\0\0\5" + b"\0\0\0\0"
    index = bytes(7) + b"\x10" + bytes(7) + b"\x23"  # places 16 and 35
    tail = bytes(7) + b"\x2f" + b"INDEXED"  # 47 bytes: head, places and this tail
    head = bytes(8) + b"\0\0\0\6" + b"\0\0\0\x1f"
    assert path.read_bytes() == b"SSL_LOG_FILE\0\0\0\1" + first + second + head + index + tail


def test_an_index_leads_to_the_messages(tmp_path: Path) -> None:
    path = write(tmp_path / "a.log", index=True)
    places, data = read_index(path), path.read_bytes()
    assert places is not None
    found = [struct.unpack_from(">qii", data, place)[:2] for place in places]
    assert found == [(entry.time, entry.kind) for entry in ENTRIES]
    assert list(read_log(path)) == ENTRIES, "reading skips the index"


def test_a_log_that_another_program_writes_is_left_alone(tmp_path: Path) -> None:
    pytest.importorskip("fcntl")
    path = tmp_path / "match.log"
    with LogWriter(path) as log:
        log.write(0, LogKind.REFEREE, b"")
        with pytest.raises(OSError, match=r"match\.log: another program writes this log"):
            LogWriter(path)
    assert [entry.kind for entry in read_log(path)] == [LogKind.REFEREE]
    with LogWriter(path):
        pass
    assert list(read_log(path)) == [], "it is replaced once it is closed"


def test_equal_messages_give_equal_files(tmp_path: Path) -> None:
    first, second = write(tmp_path / "a.log.gz"), write(tmp_path / "b.log.gz")
    assert first.read_bytes() == second.read_bytes()


def test_blank_messages_are_left_out(tmp_path: Path) -> None:
    with LogWriter(tmp_path / "a.log") as log:
        log.write(0, LogKind.BLANK, b"abc")
    assert list(read_log(tmp_path / "a.log")) == []


def test_entries_become_messages() -> None:
    rng = random.Random(0)
    kinds = {
        LogKind.VISION: vision_pb2.Packet,
        LogKind.TRACKER: tracker_pb2.Packet,
        LogKind.REFEREE: referee_pb2.Packet,
        LogKind.VISION_2010: vision_pb2.Packet2010,
    }
    for kind, message_type in kinds.items():
        message = sample(message_type, rng)
        assert LogEntry(0, kind, message.SerializeToString()).message() == message
    assert LogEntry(0, LogKind.UNKNOWN, b"").message() is None
    assert LogEntry(1_500_000_000, 0, b"").seconds == 1.5
    with pytest.raises(MessageError):
        LogEntry(0, LogKind.VISION, b"\xff").message()


def refused(path: Path, text: str) -> None:
    with pytest.raises(MessageError, match=text) as error:
        list(read_log(path))
    assert error.value.code is (Code.CUT_OFF if "cut off" in text else Code.BAD_LOG)


def test_other_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.log"
    for content, text in [
        (b"", r"^log: expected a file that begins with SSL_LOG_FILE"),
        (b"SSL_LOG_FILE\0\0", r"^log: expected a file that begins"),
        (b"RSL_LOG_FILE\0\0\0\1", r"^log: expected a file that begins"),
        (b"SSL_LOG_FILE\0\0\0\2", r"^log: expected version 1, got 2"),
        (b"SSL_LOG_FILE\0\0\0\1abc", r"^log: the file is cut off in the head"),
        (b"SSL_LOG_FILE\0\0\0\1" + bytes(11) + b"\4\0\0\0\5ab", r"cut off in a message"),
        (b"SSL_LOG_FILE\0\0\0\1" + bytes(11) + b"\4\xff\xff\xff\xff", r"0 to 65507 bytes, got -1"),
        (b"SSL_LOG_FILE\0\0\0\1" + bytes(11) + b"\4\x7f\xff\xff\xff", r"bytes, got 2147483647"),
        (b"SSL_LOG_FILE\0\0\0\1" + bytes(11) + b"\6\x7f\xff\xff\xff", r"cut off in its index"),
        (b"SSL_LOG_FILE\0\0\0\1" + bytes(11) + b"\6\xff\xff\xff\xff", r"index of 0 bytes or more"),
    ]:
        path.write_bytes(content)
        refused(path, text)


def test_damaged_compressed_files_are_refused(tmp_path: Path) -> None:
    path = write(tmp_path / "a.log.gz")
    content = path.read_bytes()
    path.write_bytes(content[:-9])
    refused(path, r"^log: the compressed file is cut off")
    path.write_bytes(content[:12] + bytes(8) + content[20:])
    refused(path, r"^log: ")


def test_messages_before_the_damage_are_read(tmp_path: Path) -> None:
    path = write(tmp_path / "a.log")
    path.write_bytes(path.read_bytes()[:-1])
    found = []
    with pytest.raises(MessageError, match="cut off in a message"):
        for entry in read_log(path):
            found.append(entry)  # noqa: PERF402  (the error comes in between)
    assert found == ENTRIES[:2]


def test_changed_bytes_raise_nothing_else(tmp_path: Path) -> None:
    rng, path = random.Random(3), tmp_path / "a.log"
    outcomes = set()
    for name in ("b.log", "b.log.gz"):
        content = write(tmp_path / name, index=not name.endswith("gz")).read_bytes()
        for _ in range(300):
            changed = bytearray(content)
            changed[rng.randrange(len(changed))] = rng.randrange(256)
            path.write_bytes(
                changed[: rng.randrange(len(changed) + 1)] if rng.random() < 0.3 else changed
            )
            try:
                list(read_log(path))
                if not name.endswith("gz"):
                    read_index(path)
                outcomes.add("read")
            except MessageError:
                outcomes.add("refused")
    assert outcomes == {"read", "refused"}


def test_bad_entries_are_refused_when_written(tmp_path: Path) -> None:
    with LogWriter(tmp_path / "a.log") as log:
        with pytest.raises(ValueError, match=r"^data: expected at most 65507 bytes, got 65508"):
            log.write(0, LogKind.VISION, bytes(65508))
        with pytest.raises(ValueError, match=r"^kind: expected no index"):
            log.write(0, LogKind.INDEX, b"")
        with pytest.raises(ValueError, match=r"^time: expected 0 to 2\*\*63 - 1 ns, got -1"):
            log.write(-1, LogKind.VISION, b"")
        log.close()
        log.close()
    assert list(read_log(tmp_path / "a.log")) == []
    with pytest.raises(ValueError, match=r"^index: expected False for a compressed file"):
        LogWriter(tmp_path / "a.log.gz", index=True)
    with pytest.raises(FileNotFoundError):
        list(read_log(tmp_path / "none.log"))
