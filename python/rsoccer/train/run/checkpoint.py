"""Checkpoints of a training run: arrays as safetensors, other values as JSON in the metadata.

A checkpoint is one file, replaced in one step: a run that is killed at any moment leaves either the
old checkpoint or the new one. Nothing is unpickled, so a checkpoint from an unknown source may be
refused, but it cannot run code.
"""

from __future__ import annotations

import json
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer.files import safetensors_bytes, write_atomically
from rsoccer.train.prefixes import Arrays

FORMAT = "rsoccer-checkpoint-3"
"""Value of "format" in the metadata of a checkpoint."""
FILE_NAME = "checkpoint.safetensors"
"""Name of the checkpoint in a run's folder."""


@dataclass(frozen=True)
class Checkpoint:
    """Complete state of a run: a resumed run continues bit for bit as if it had never stopped."""

    arrays: Arrays
    """Arrays of all parts of the run by `part.name`."""
    info: dict[str, Any]
    """JSON values by name: the settings, counters, and the size of the log."""


def save(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint in one step: `path` holds either the old file or the complete new one.

    Args:
        path: the file to replace.
        checkpoint: state to save.
    """
    arrays = {name: np.asarray(array, order="C") for name, array in checkpoint.arrays.items()}
    metadata = {"format": FORMAT, "info": json.dumps(checkpoint.info)}
    write_atomically(path, safetensors_bytes(arrays, metadata))


def load(path: Path) -> Checkpoint:
    """Return the checkpoint in a file.

    Args:
        path: a file that `save` wrote.

    Raises:
        ValueError: a missing, truncated or foreign file; the message names the file.
    """
    from safetensors import SafetensorError, safe_open

    if not path.is_file():
        raise ValueError(f"{path} does not exist, so there is no run to resume")
    try:
        with safe_open(path, framework="numpy") as file:
            metadata = file.metadata() or {}
            _expect_format(path, metadata)
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
            info = json.loads(metadata["info"])
    except (SafetensorError, KeyError, TypeError, json.JSONDecodeError) as error:
        raise ValueError(f"{path} is damaged or not a checkpoint: {error}") from error
    needed = {"args": dict, "log_size": int}
    if not isinstance(info, dict) or any(
        not isinstance(info.get(name), kind) for name, kind in needed.items()
    ):
        raise ValueError(f"{path} is damaged or not a checkpoint: expected {', '.join(needed)}")
    return Checkpoint(arrays, info)


def _expect_format(path: Path, metadata: Mapping[str, str]) -> None:
    """Raise ValueError unless the metadata names the format of checkpoints."""
    found = metadata.get("format")
    if found != FORMAT:
        raise ValueError(f"{path} is not a training checkpoint: format {found!r}, not {FORMAT!r}")


def prepare_folder(folder: Path) -> None:
    """Create the folder of a run and prove that files can be written there.

    Args:
        folder: created with its parents if it does not exist.

    Raises:
        ValueError: the folder cannot be created or written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise ValueError(f"out must be a folder to write in, got {folder}: {error}") from error
