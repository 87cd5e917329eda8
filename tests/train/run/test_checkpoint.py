"""Checkpoints: complete or not written at all, and foreign files are refused."""

import os
import tempfile
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save_file

from rsoccer.train.run import checkpoint
from rsoccer.train.run.checkpoint import Checkpoint

SAVED = Checkpoint(
    arrays={
        "model.weight": np.arange(6, dtype=np.float32).reshape(2, 3),
        "model.turned": np.arange(6, dtype=np.float32).reshape(2, 3).T,
        "worlds.snapshot": np.arange(256, dtype=np.uint8),
        "worlds.rng": np.array([2**64 - 1], np.uint64),
        "adam.step": np.array(3.0, np.float32),
        "empty": np.zeros((0, 3), np.float32),
    },
    info={"samples": 12, "log_size": 0, "args": {"task": "x", "gamma": 0.995}},
)


def test_a_checkpoint_makes_a_round_trip(tmp_path: Path) -> None:
    path = tmp_path / "a.safetensors"
    checkpoint.save(path, SAVED)
    loaded = checkpoint.load(path)
    assert loaded.info == SAVED.info
    assert loaded.arrays.keys() == SAVED.arrays.keys()
    for name, array in SAVED.arrays.items():
        assert loaded.arrays[name].dtype == array.dtype
        assert loaded.arrays[name].shape == array.shape
        assert loaded.arrays[name].tobytes() == array.tobytes()


@pytest.mark.parametrize("failing", ["fsync", "replace"])
def test_an_interrupted_write_leaves_the_old_checkpoint(
    failing: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a.safetensors"
    checkpoint.save(path, SAVED)
    before = path.read_bytes()

    def fail(*args: object) -> None:
        raise OSError("no space left on device")

    owner: object = os if failing == "fsync" else Path
    monkeypatch.setattr(owner, failing, fail)
    with pytest.raises(OSError, match="no space"):
        checkpoint.save(path, Checkpoint({"other": np.zeros(9)}, {}))
    assert path.read_bytes() == before
    assert [file.name for file in tmp_path.iterdir()] == [path.name], "a temporary file is left"


def test_every_truncation_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.safetensors"
    checkpoint.save(path, SAVED)
    content = path.read_bytes()
    for size in [*range(0, len(content), 29), len(content) - 1]:
        path.write_bytes(content[:size])
        with pytest.raises(ValueError, match=r"a\.safetensors is damaged"):
            checkpoint.load(path)


def test_foreign_files_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.safetensors"
    with pytest.raises(ValueError, match="does not exist"):
        checkpoint.load(path)
    path.write_bytes(b"\x80\x04K\x01." * 100)  # the start of a pickle
    with pytest.raises(ValueError, match="damaged or not a checkpoint"):
        checkpoint.load(path)
    save_file({"a": np.zeros(2)}, path, {"format": "rsoccer-policy-1"})
    with pytest.raises(ValueError, match="not a training checkpoint"):
        checkpoint.load(path)
    save_file({"a": np.zeros(2)}, path, {"format": checkpoint.FORMAT, "info": "{"})
    with pytest.raises(ValueError, match="damaged or not a checkpoint"):
        checkpoint.load(path)


def test_a_folder_is_made_with_its_parents(tmp_path: Path) -> None:
    for _ in range(2):
        checkpoint.prepare_folder(tmp_path / "runs" / "first")
        assert not list((tmp_path / "runs" / "first").iterdir())


def test_a_folder_that_cannot_be_written_is_refused_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(ValueError, match="out must be a folder to write in"):
        checkpoint.prepare_folder(tmp_path / "file")

    def refuse(*args: object, **options: object) -> None:
        raise PermissionError("read-only file system")

    # Permissions do not bind root, so the refusal of the system is simulated.
    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    with pytest.raises(ValueError, match="read-only file system"):
        checkpoint.prepare_folder(tmp_path / "new")
