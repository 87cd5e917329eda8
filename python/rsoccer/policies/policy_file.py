"""The file of a trained policy: what it must hold, and how it is read and written."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer.files import safetensors_bytes, write_atomically
from rsoccer.frame import Array, Floats

FORMAT = "rsoccer-policy-2"
"""First thing a reader looks at; a new number means that old readers must refuse."""

MOST_REPEAT = 1_000_000
"""Control steps that an action may last, some seven hours of play."""

INSTALL_HINT = "policy files need safetensors: pip install 'rsoccer[cli]'"


def read_metadata(metadata: Mapping[str, str]) -> tuple[np.float32, int]:
    """Bound of a normalised observation, and action repeat, once the rest is found right."""
    for name, wanted in {"format": FORMAT, "activation": "tanh"}.items():
        if metadata.get(name) != wanted:
            raise ValueError(f"metadata {name!r} should be {wanted!r}, got {metadata.get(name)!r}")
    if not metadata.get("task"):
        raise ValueError("metadata 'task' should name the task it was trained on, got nothing")
    clip = _read_number(metadata, "clip", "10")
    repeat = _read_number(metadata, "action_repeat", "1")
    if not repeat.is_integer():
        raise ValueError(f"metadata 'action_repeat' should be a whole number, got {repeat}")
    if repeat > MOST_REPEAT:
        raise ValueError(
            f"metadata 'action_repeat' should be at most {MOST_REPEAT}, "
            f"got {metadata['action_repeat']!r}"
        )
    return np.float32(clip), int(repeat)


def _read_number(metadata: Mapping[str, str], name: str, default: str) -> float:
    """A finite number above 0."""
    text = metadata.get(name, default)
    try:
        number = float(text)
    except ValueError:
        number = float("nan")
    if not (np.isfinite(number) and number > 0.0):
        raise ValueError(f"metadata {name!r} should be a finite number above 0, got {text!r}")
    return number


def read_layers(arrays: Mapping[str, Array]) -> list[tuple[Floats, Floats]]:
    """Weight (out, in) and bias (out,) of each layer, the input side first."""
    count = sum(name.endswith(".weight") for name in arrays)
    expected = {f"layers.{index}.{part}" for index in range(count) for part in ("weight", "bias")}
    expected |= {"mean", "std"}
    if count == 0 or set(arrays) - {"action_std"} != expected:
        odd = sorted((set(arrays) - {"action_std"}) ^ expected) or ["layers.0.weight"]
        raise ValueError(f"missing or unknown arrays: {', '.join(odd)}")
    layers: list[tuple[Floats, Floats]] = []
    for index in range(count):
        weight = _read_array(arrays, f"layers.{index}.weight", (None, None))
        bias = _read_array(arrays, f"layers.{index}.bias", (weight.shape[0],))
        if layers and weight.shape[1] != layers[-1][0].shape[0]:
            raise ValueError(
                f"layers.{index}.weight takes {weight.shape[1]} numbers, "
                f"but the layer before gives {layers[-1][0].shape[0]}"
            )
        layers.append((weight, bias))
    return layers


def read_normaliser(arrays: Mapping[str, Array], size: int) -> tuple[Floats, Floats]:
    """Mean and standard deviation of observations, (o,) each; the latter above 0."""
    mean, std = _read_array(arrays, "mean", (size,)), _read_array(arrays, "std", (size,))
    if not (std > 0.0).all():
        raise ValueError(f"array 'std' should be above 0 everywhere, got {std.min()}")
    return mean, std


def read_spread(arrays: Mapping[str, Array], size: int) -> Floats | None:
    """Spread of actions while it learned (action,), above 0; None if it learned without."""
    if "action_std" not in arrays:
        return None
    spread = _read_array(arrays, "action_std", (size,))
    if not (spread > 0.0).all():
        raise ValueError(f"array 'action_std' should be above 0 everywhere, got {spread.min()}")
    return spread


def _read_array(arrays: Mapping[str, Array], name: str, shape: tuple[int | None, ...]) -> Floats:
    """Own copy of one array, float32 and finite; None in `shape` is any size above 0."""
    array = np.asarray(arrays[name])
    fits = array.ndim == len(shape) and all(
        size > 0 if wanted is None else size == wanted
        for size, wanted in zip(array.shape, shape, strict=True)
    )
    if array.dtype != np.float32 or not fits:
        sizes = ", ".join("any" if size is None else str(size) for size in shape)
        raise ValueError(
            f"array {name!r} should be float32 ({sizes}), got {array.dtype} {array.shape}"
        )
    if not np.isfinite(array).all():
        raise ValueError(f"array {name!r} has NaN or infinite numbers")
    return array.copy()


def write(path: Path, arrays: Mapping[str, Array], metadata: Mapping[str, str]) -> None:
    """Write the file whole or not at all; equal content gives equal bytes."""
    _safetensors()
    write_atomically(path, safetensors_bytes(arrays, metadata))


def _safetensors() -> Any:  # noqa: ANN401  (an optional module has no type before it is there)
    try:
        import safetensors
    except ImportError as error:
        raise ImportError(INSTALL_HINT) from error
    return safetensors


def read_file(path: Path) -> tuple[dict[str, Array], dict[str, str]]:
    """Arrays and metadata as they stand in the file."""
    safetensors = _safetensors()
    if path.is_dir():
        raise ValueError("it is a folder")
    try:
        with safetensors.safe_open(path, framework="numpy") as file:
            for name in file.keys():  # noqa: SIM118  (the handle is no mapping)
                kind = file.get_slice(name).get_dtype()
                if kind != "F32":  # before NumPy meets a type that it does not know
                    raise ValueError(f"array {name!r} should be float32, got {kind}")
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
            return arrays, dict(file.metadata() or {})
    except safetensors.SafetensorError as error:
        raise ValueError(f"truncated or not safetensors ({error})") from error
