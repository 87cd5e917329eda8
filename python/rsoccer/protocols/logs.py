"""Log files of the SSL: what was received, with times, as the league's tools write and play it.

A file has the text `SSL_LOG_FILE`, its version 1 as a number, and messages: time in ns, kind and
length as numbers, and the bytes of the packet. Numbers are big-endian, of 8, 4 and 4 bytes. A file
that is not compressed may end in an index: the places of all messages, the length of the index
with its own head, and the text `INDEXED`. Source: ssl-go-tools a0f5851.
"""

from __future__ import annotations

import gzip
import struct
import zlib
from collections.abc import Iterator
from enum import IntEnum
from pathlib import Path
from types import TracebackType
from typing import IO, Final, NamedTuple

from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.parsing import MAX_SIZE, parse
from rsoccer.protocols.protobuf import Message
from rsoccer.protocols.schemas import referee_pb2, tracker_pb2, vision_pb2

try:
    import fcntl
except ImportError:  # on Windows
    fcntl = None  # type: ignore[assignment]

MARK: Final = b"SSL_LOG_FILE"
"""First bytes of a log."""
VERSION: Final = 1
"""Version of the format."""
NANOSECONDS: Final = 1_000_000_000
"""Nanoseconds in a second."""
COMPRESSED_SUFFIX: Final = ".gz"
"""Suffix of files that are written compressed; reading tells them by their content."""
_INDEX_MARK: Final = b"INDEXED"
_GZIP_MARK: Final = b"\x1f\x8b"
_HEAD: Final = struct.Struct(">qii")
_VERSION: Final = struct.Struct(">i")
_PLACE: Final = struct.Struct(">q")
_CHUNK: Final = 1 << 16


class LogKind(IntEnum):
    """Kind of a message in a log."""

    BLANK = 0
    """To be ignored."""
    UNKNOWN = 1
    """A packet whose kind the recorder did not know."""
    VISION_2010 = 2
    """A vision packet with the geometry of 2010."""
    REFEREE = 3
    """A packet of the game controller."""
    VISION = 4
    """A vision packet, since 2014."""
    TRACKER = 5
    """A packet of a tracker."""
    INDEX = 6
    """The index at the end of the file."""


_MESSAGES: Final[dict[int, type[Message]]] = {
    LogKind.VISION_2010: vision_pb2.Packet2010,
    LogKind.REFEREE: referee_pb2.Packet,
    LogKind.VISION: vision_pb2.Packet,
    LogKind.TRACKER: tracker_pb2.Packet,
}


class LogEntry(NamedTuple):
    """A message in a log."""

    time: int
    """Time at which it was received, Unix time, ns."""
    kind: int
    """A value of `LogKind`, or another number."""
    data: bytes
    """The packet."""

    @property
    def seconds(self) -> float:
        """Time at which it was received, Unix time, s."""
        return self.time / NANOSECONDS

    def message(self) -> Message | None:
        """Return the packet; None if its kind is none that this package reads.

        Raises:
            MessageError: the bytes are no such packet.
        """
        kind = _MESSAGES.get(self.kind)
        return None if kind is None else parse(kind, self.data)


def _own_file(path: Path) -> IO[bytes]:
    """An empty file that no other log is written to."""
    file = path.open("ab")  # which keeps what another program has written
    try:
        if fcntl is not None:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        file.truncate(0)
    except BlockingIOError as error:
        file.close()
        raise OSError(f"{path}: another program writes this log") from error
    except BaseException:
        file.close()
        raise
    return file


class LogWriter:
    """A log that is written: a context manager.

    Example:
        >>> from rsoccer.protocols.logs import LogKind, LogWriter, read_log
        >>> with LogWriter("match.log.gz") as log:
        ...     log.write(0, LogKind.REFEREE, b"")
        >>> [entry.kind for entry in read_log("match.log.gz")]
        [3]
    """

    def __init__(self, path: Path | str, *, index: bool = False) -> None:
        """Create the file, or replace it.

        Args:
            path: the file; it is compressed if its name ends in .gz.
            index: whether to end the file in an index, which players use to jump. A compressed
                file has none.

        Raises:
            OSError: the file cannot be written, or another program writes it.
            ValueError: an index of a compressed file.
        """
        self._compressed = Path(path).suffix == COMPRESSED_SUFFIX
        if index and self._compressed:
            raise ValueError("index: expected False for a compressed file, got True")
        self._places: list[int] | None = [] if index else None
        self._raw: IO[bytes] = _own_file(Path(path))
        self._file: IO[bytes] = self._raw
        if self._compressed:
            # Without a name and a time, equal messages give equal files.
            self._file = gzip.GzipFile("", "wb", fileobj=self._raw, mtime=0)  # type: ignore[assignment]
        self._file.write(MARK + _VERSION.pack(VERSION))
        self._place = len(MARK) + _VERSION.size

    def write(self, time: int, kind: int, data: bytes) -> None:
        """Add a message.

        Args:
            time: time at which it was received, Unix time, ns.
            kind: a value of `LogKind`.
            data: the packet.

        Raises:
            ValueError: a packet that is too long, a time that does not fit, or an index.
        """
        if len(data) > MAX_SIZE:
            raise ValueError(f"data: expected at most {MAX_SIZE} bytes, got {len(data)}")
        if kind == LogKind.INDEX:
            raise ValueError("kind: expected no index, which the file writes itself")
        if not 0 <= time < 2**63:
            raise ValueError(f"time: expected 0 to 2**63 - 1 ns, got {time}")
        if self._places is not None:
            self._places.append(self._place)
        self._file.write(_HEAD.pack(time, kind, len(data)) + data)
        self._place += _HEAD.size + len(data)

    def close(self) -> None:
        """End the file; a second call does nothing."""
        if self._raw.closed:
            return
        if self._places is not None:
            places = b"".join(map(_PLACE.pack, self._places))
            size = len(places) + _PLACE.size + len(_INDEX_MARK)
            self._file.write(_HEAD.pack(0, LogKind.INDEX, size) + places)
            self._file.write(_PLACE.pack(_HEAD.size + size) + _INDEX_MARK)
        self._file.close()
        self._raw.close()

    def __enter__(self) -> LogWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()


def read_log(path: Path | str) -> Iterator[LogEntry]:
    """Yield the messages of a log, without blank ones and the index.

    Args:
        path: the file, compressed or not.

    Raises:
        FileNotFoundError: no such file.
        MessageError: the file is no log, of another version, damaged or cut off. Messages before
            the damage have been yielded.
    """
    with Path(path).open("rb") as raw:
        compressed = raw.read(len(_GZIP_MARK)) == _GZIP_MARK
        raw.seek(0)
        file: IO[bytes] = gzip.GzipFile("", "rb", fileobj=raw) if compressed else raw  # type: ignore[assignment]
        try:
            yield from _entries(file)
        except EOFError:
            raise MessageError(Code.CUT_OFF, "log: the compressed file is cut off") from None
        except (gzip.BadGzipFile, zlib.error) as error:
            raise MessageError(
                Code.BAD_LOG, f"log: the compressed file is damaged: {error}"
            ) from None


def _check_start(file: IO[bytes]) -> None:
    start = file.read(len(MARK) + _VERSION.size)
    if start[: len(MARK)] != MARK or len(start) != len(MARK) + _VERSION.size:
        raise MessageError(Code.BAD_LOG, f"log: expected a file that begins with {MARK.decode()}")
    (version,) = _VERSION.unpack(start[len(MARK) :])
    if version != VERSION:
        raise MessageError(Code.BAD_LOG, f"log: expected version {VERSION}, got {version}")


def _entries(file: IO[bytes]) -> Iterator[LogEntry]:
    _check_start(file)
    while head := file.read(_HEAD.size):
        if len(head) < _HEAD.size:
            raise MessageError(Code.CUT_OFF, "log: the file is cut off in the head of a message")
        time, kind, size = _HEAD.unpack(head)
        if kind == LogKind.INDEX:
            _skip(file, size)
            continue
        if not 0 <= size <= MAX_SIZE:
            raise MessageError(
                Code.BAD_LOG, f"log: expected messages of 0 to {MAX_SIZE} bytes, got {size}"
            )
        data = file.read(size)
        if len(data) < size:
            raise MessageError(Code.CUT_OFF, "log: the file is cut off in a message")
        if kind != LogKind.BLANK:
            yield LogEntry(time, kind, data)


def _skip(file: IO[bytes], size: int) -> None:
    """Skip an index, which is as long as the match."""
    if size < 0:
        raise MessageError(Code.BAD_LOG, f"log: expected an index of 0 bytes or more, got {size}")
    while size > 0:
        skipped = len(file.read(min(size, _CHUNK)))
        if not skipped:
            raise MessageError(Code.CUT_OFF, "log: the file is cut off in its index")
        size -= skipped


def read_index(path: Path | str) -> list[int] | None:
    """Return the places of all messages in the index of a log; None if it has no index.

    Args:
        path: the file, not compressed.

    Raises:
        FileNotFoundError: no such file.
        MessageError: an index that is not inside the file.
    """
    content_size = Path(path).stat().st_size
    tail = _PLACE.size + len(_INDEX_MARK)
    with Path(path).open("rb") as file:
        file.seek(max(0, content_size - tail))
        end = file.read()
        if len(end) < tail or not end.endswith(_INDEX_MARK):
            return None
        (size,) = _PLACE.unpack(end[: _PLACE.size])
        places = size - tail - _HEAD.size
        if places < 0 or places % _PLACE.size or size > content_size:
            raise MessageError(
                Code.BAD_LOG, f"log: expected an index in the file, got {size} bytes"
            )
        file.seek(content_size - size + _HEAD.size)
        return [place for (place,) in _PLACE.iter_unpack(file.read(places))]
