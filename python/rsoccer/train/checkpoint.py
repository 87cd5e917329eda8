"""A training run on disk: arrays as safetensors, the rest as JSON in that file's metadata.

One file, replaced whole: a run killed at any moment leaves either the old checkpoint or the new
one. Nothing is unpickled, so a checkpoint from a stranger can be refused but cannot run code.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer.files import safetensors_bytes, write_atomically

FORMAT = "rsoccer-checkpoint-2"
FILE_NAME = "checkpoint.safetensors"

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class Checkpoint:
    """Everything that a run needs to go on as if it had never stopped."""

    arrays: Arrays
    info: dict[str, Any]


def save(path: Path, checkpoint: Checkpoint) -> None:
    """Write the checkpoint so that `path` holds either the old or the new one, whole."""
    arrays = {name: np.asarray(array, order="C") for name, array in checkpoint.arrays.items()}
    metadata = {"format": FORMAT, "info": json.dumps(checkpoint.info)}
    write_atomically(path, safetensors_bytes(arrays, metadata))


def load(path: Path) -> Checkpoint:
    """Read a checkpoint; a missing, truncated or foreign file is a ValueError naming the file."""
    from safetensors import SafetensorError, safe_open

    if not path.is_file():
        raise ValueError(f"{path} does not exist, so there is no run to resume")
    try:
        with safe_open(path, framework="numpy") as file:
            metadata = file.metadata() or {}
            _expect_format(path, metadata)
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
        return Checkpoint(arrays, json.loads(metadata["info"]))
    except (SafetensorError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(f"{path} is damaged or not a checkpoint: {error}") from error


def _expect_format(path: Path, metadata: Mapping[str, str]) -> None:
    found = metadata.get("format")
    if found != FORMAT:
        raise ValueError(f"{path} is not a training checkpoint: format {found!r}, not {FORMAT!r}")


def prepare_folder(folder: Path) -> None:
    """Create the folder and prove that files can be written there, before any work is done."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise ValueError(f"out must be a folder to write in, got {folder}: {error}") from error


def prefixed(prefix: str, arrays: Mapping[str, NDArray[Any]]) -> Arrays:
    """The arrays under `prefix.name`, so that several owners share one file."""
    return {f"{prefix}.{name}": array for name, array in arrays.items()}


def owned(prefix: str, arrays: Mapping[str, NDArray[Any]]) -> Arrays:
    """The arrays that were saved under a prefix, by their own names."""
    start = f"{prefix}."
    return {name[len(start) :]: array for name, array in arrays.items() if name.startswith(start)}
