"""Atomic writing of files, and reading of safetensors files."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from safetensors.numpy import save

from rsoccer.files import (
    as_path,
    check_writable,
    read_safetensors,
    safetensors_bytes,
    write_atomically,
)
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.network import Network
from rsoccer.policies.onnx_policy import OnnxPolicy
from rsoccer.replay import Replay


def test_a_file_is_replaced_in_one_step(tmp_path: Path) -> None:
    path = tmp_path / "file"
    write_atomically(path, b"old")
    write_atomically(path, b"new")
    assert path.read_bytes() == b"new"
    assert list(tmp_path.iterdir()) == [path]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "file"
    write_atomically(path, b"old")

    def full_disk(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(OSError, match="No space left"):
        write_atomically(path, b"new")
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize(
    ("place", "message"),
    [
        (".", "name: expected a file, got "),
        ("none/file", "name: expected a file in a folder that exists, got .*none"),
        ("/proc/file", "name: cannot write /proc/file: No such file"),
        ("/dev/null", "name: expected a file, got /dev/null"),
        ("n" * 300, "name: cannot write .*: File name too long"),
    ],
)
def test_places_where_no_file_can_be_written_are_refused(
    place: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=message):
        check_writable("name", tmp_path / place)
    file = tmp_path / "file"
    file.write_text("content")
    check_writable("name", file)
    assert (file.read_text(), list(tmp_path.iterdir())) == ("content", [file])


def test_the_error_names_a_missing_folder(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="nowhere"):
        write_atomically(tmp_path / "nowhere" / "file", b"")


def test_safetensors_are_read_as_the_library_writes_them() -> None:
    rng = np.random.default_rng(0)
    shapes = {"scalar": (), "empty": (0, 3), "vector": (5,), "cube": (2, 3, 4)}
    arrays = {name: rng.normal(size=shape).astype(np.float32) for name, shape in shapes.items()}
    for content in (save(arrays, metadata={"k": "ü"}), safetensors_bytes(arrays, {"k": "ü"})):
        found, metadata = read_safetensors(content)
        assert metadata == {"k": "ü"}
        assert {name: array.shape for name, array in found.items()} == shapes
        for name, array in arrays.items():
            np.testing.assert_array_equal(found[name], array)
            assert found[name].flags.writeable
    assert read_safetensors(save({}))[0] == {}


def file_of(header: Any, data: bytes = bytes(8)) -> bytes:  # noqa: ANN401  (JSON)
    text = header if isinstance(header, bytes) else json.dumps(header).encode()
    return len(text).to_bytes(8, "little") + text + data


def entry(dtype: object = "F32", shape: object = (2,), data_offsets: object = (0, 8)) -> Any:  # noqa: ANN401
    return {"dtype": dtype, "shape": shape, "data_offsets": data_offsets}


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"\x05",
        bytes(7),
        (2**63).to_bytes(8, "little") + bytes(50),
        file_of(b"\xff\xfe"),
        file_of(b"["),
        file_of(b"[" * 100_000),
        file_of([]),
        file_of(5),
        file_of({"a": 5}),
        file_of({"a": {"dtype": "F32"}}),
        file_of({"a": entry(), "__metadata__": {"k": 5}}),
        file_of({"a": entry(), "__metadata__": []}),
        file_of({"a": entry(shape=[3])}),
        file_of({"a": entry(shape=[-1, -2])}),
        file_of({"a": entry(shape=[2.0])}),
        file_of({"a": entry(shape="2")}),
        file_of({"a": entry(shape=None)}),
        file_of({"a": entry(data_offsets=[0, 9])}),
        file_of({"a": entry(data_offsets=[0, 4], shape=[1])}),
        file_of({"a": entry(data_offsets=[4, 8], shape=[1])}),
        file_of({"a": entry(data_offsets=[8, 0])}),
        file_of({"a": entry(data_offsets=["0", "8"])}),
        file_of({"a": entry(data_offsets=[0, 4, 8])}),
        file_of({"a": entry(), "b": entry()}),
        file_of({"a": entry(), "b": entry(data_offsets=[8, 16])}),
    ],
)
def test_bytes_that_are_no_safetensors_are_refused(content: bytes) -> None:
    with pytest.raises(ValueError, match="truncated or not safetensors"):
        read_safetensors(content)


def test_half_precision_is_read_as_single_precision() -> None:
    half = np.array([[1.5, -0.25, 65504.0]], np.float16)
    found, _ = read_safetensors(save({"a": half, "b": np.ones(3, np.float32)}))
    assert {array.dtype for array in found.values()} == {np.dtype(np.float32)}
    np.testing.assert_array_equal(found["a"], half.astype(np.float32))


def test_a_refused_type_is_named() -> None:
    with pytest.raises(ValueError, match="'a' should be float32 or float16, got BF16"):
        read_safetensors(file_of({"a": entry("BF16", (4,))}))


@pytest.mark.parametrize("load", [Replay.load, Network.load, OnnxPolicy.load, Evolved.load])
@pytest.mark.parametrize("path", [3, None, b"a.rsr"])
def test_what_is_no_path_is_named(load: Callable[..., object], path: object) -> None:
    with pytest.raises(TypeError, match=r"^path: expected a path, got "):
        load(path)
    assert as_path("path", "a") == Path("a")
