"""Atomic writing of files, and safetensors files with reproducible bytes."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from numpy.typing import NDArray


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
    end = 8 + int.from_bytes(content[:8], "little")  # 8 bytes of length, header in JSON, data
    header = json.dumps(json.loads(content[8:end]), sort_keys=True, separators=(",", ":")).encode()
    header += b" " * (-len(header) % 8)  # keeps the data aligned
    return len(header).to_bytes(8, "little") + header + content[end:]
