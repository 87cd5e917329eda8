"""Atomic writing of files; safetensors files: writing with reproducible bytes, and reading."""

from __future__ import annotations

import json
import math
import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

LENGTH_BYTES: Final = 8
"""Bytes of the length of the header, with which a safetensors file begins."""


def as_path(name: str, value: object) -> Path:
    """Return the path that an argument is.

    Args:
        name: name of the argument, for the error.
        value: the argument.

    Raises:
        TypeError: neither text nor a path.
    """
    if not isinstance(value, str | os.PathLike):
        raise TypeError(f"{name}: expected a path, got {value!r}")
    return Path(value)


def write_atomically(path: Path, content: bytes) -> None:
    """Replace a file in one step, through a temporary file in the same folder.

    A reader, or a restart after a crash, finds either the old file or the complete new one.

    Args:
        path: the file to create or replace; its folder must exist.
        content: the new content.
    """
    partial = path.with_name(f".{path.name}.partial")
    try:
        with partial.open("wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
    _sync_folder(path.parent)


def check_writable(name: str, path: Path) -> None:
    """Check that a file can be created or replaced, before work whose result it gets.

    Args:
        name: name of the argument, for the error message.
        path: the file; it stays as it is.

    Raises:
        ValueError: a folder or a device, or a file in a folder that does not exist or cannot be
            written.
    """
    try:
        if path.exists() and not path.is_file():
            raise ValueError(f"{name}: expected a file, got {path}")
        if not path.resolve().parent.is_dir():
            raise ValueError(f"{name}: expected a file in a folder that exists, got {path}")
        with tempfile.NamedTemporaryFile(dir=path.resolve().parent, prefix=f".{path.name}."):
            pass
    except OSError as error:
        raise ValueError(f"{name}: cannot write {path}: {error.strerror}") from error


def _sync_folder(folder: Path) -> None:
    """Make the rename survive a power cut; Windows cannot sync folders."""
    if os.name == "nt":
        return
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def safetensors_bytes(arrays: Mapping[str, NDArray[Any]], metadata: Mapping[str, str]) -> bytes:
    """Return a safetensors file whose bytes depend on its content alone.

    The library writes the metadata in an order that changes from run to run; here they are sorted.

    Args:
        arrays: arrays by name.
        metadata: texts by name.
    """
    from safetensors.numpy import save

    content = save(dict(arrays), metadata=dict(metadata))
    end = LENGTH_BYTES + int.from_bytes(content[:LENGTH_BYTES], "little")
    header = json.loads(content[LENGTH_BYTES:end])
    sorted_header = json.dumps(header, sort_keys=True, separators=(",", ":")).encode()
    sorted_header += b" " * (-len(sorted_header) % 8)  # keeps the data aligned
    return len(sorted_header).to_bytes(LENGTH_BYTES, "little") + sorted_header + content[end:]


def read_safetensors(content: bytes) -> tuple[dict[str, NDArray[np.float32]], dict[str, str]]:
    """Read a safetensors file of float32 and float16 arrays, without the library of that name.

    A file is the length of its header, the header in JSON, and the numbers of the arrays, one array
    after the other. The header has the type, shape and place of each array by name, and the
    metadata under "__metadata__".

    Args:
        content: the bytes of the file.

    Returns:
        Copies of the arrays by name, as float32, and the metadata by key.

    Raises:
        ValueError: bytes of another format, a truncated file, or an array of another type.
    """
    end = LENGTH_BYTES + int.from_bytes(content[:LENGTH_BYTES], "little")
    if len(content) < max(end, LENGTH_BYTES):
        raise ValueError("truncated or not safetensors (its header is longer than the file)")
    try:
        header = json.loads(content[LENGTH_BYTES:end].decode())
        metadata = header.pop("__metadata__", {})
        places = {name: tuple(entry["data_offsets"]) for name, entry in header.items()}
        valid = all(type(text) is str for text in metadata.values())
        if not valid or not _are_consecutive(list(places.values()), len(content) - end):
            raise ValueError("places of arrays or metadata")
        data = memoryview(content)[end:]
        arrays = {
            name: _array(name, entry, data[slice(*places[name])]) for name, entry in header.items()
        }
    except _WrongType as error:
        raise ValueError(str(error)) from None
    except (AttributeError, KeyError, RecursionError, TypeError, ValueError) as error:
        raise ValueError(f"truncated or not safetensors ({error})") from error
    return arrays, metadata


class _WrongType(ValueError):
    """An array that is neither float32 nor float16."""


_TYPES: Final = {"F32": "<f4", "F16": "<f2"}
"""Types of numbers in files, and in NumPy."""


def _array(name: str, entry: Mapping[str, Any], data: memoryview) -> NDArray[np.float32]:
    """Copy of an array from its entry in the header and its bytes."""
    if entry["dtype"] not in _TYPES:
        raise _WrongType(f"array {name!r} should be float32 or float16, got {entry['dtype']}")
    dtype = np.dtype(_TYPES[entry["dtype"]])
    shape = entry["shape"]
    if not all(type(size) is int and size >= 0 for size in shape):
        raise ValueError(f"shape {shape} of {name!r}")
    if math.prod(shape) * dtype.itemsize != len(data):
        raise ValueError(f"{len(data)} bytes for shape {shape} of {name!r}")
    return np.frombuffer(data, dtype).reshape(shape).astype(np.float32)


def _are_consecutive(places: list[tuple[Any, ...]], length: int) -> bool:
    """Whether places (begin, end) follow each other without gaps from 0 to a length."""
    last = 0
    for begin, end in sorted(places):
        if (type(begin), type(end)) != (int, int) or begin != last or end < begin:
            return False
        last = end
    return last == length
