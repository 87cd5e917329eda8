"""A trained policy: a small perceptron run in NumPy, kept in one safetensors file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer.files import write_atomically
from rsoccer.frame import Array, Floats
from rsoccer.policies.base import Memory, Policy, Seen

if TYPE_CHECKING:
    from rsoccer.rng import WorldRng
    from rsoccer.task import Task

FORMAT = "rsoccer-policy-1"
"""First thing a reader looks at; a new number means that old readers must refuse."""

ONE_THREAD = 2**18  # multiplications of a product that OpenBLAS still does on one thread

INSTALL_HINT = "policy files need safetensors: pip install 'rsoccer[cli]'"


class Network(Policy):
    """Mean action of a trained network, (n, robots, action) in [-1, 1]; deterministic.

    Torch is needed to train it, not to play with it. It decides as often as it did in training:
    with `action_repeat` k it looks at every k-th control step and holds its action between.
    Products of matrices are not bit-equal between batch sizes, so in two batch sizes its actions
    may differ by about 1e-6; whoever needs the same numbers twice plays in chunks of the same
    size, as `rsoccer.evaluate` does.
    """

    observes: Literal["nothing", "view", "observation"] = "observation"

    def __init__(self, arrays: Mapping[str, Array], metadata: Mapping[str, str]) -> None:
        """Check names, shapes, numbers and metadata, then copy the arrays.

        `arrays` holds `layers.<i>.weight` (out, in), `layers.<i>.bias` (out,), and `mean`, `std`
        (observation,), all float32. `metadata` is text: format, task, observation_size,
        action_size, activation, clip (bound of a normalised observation), where it is known
        layout (`Task.layout`) and, if it is not 1, action_repeat (control steps).
        """
        self.metadata = dict(metadata)
        self.clip, self.action_repeat = _read_metadata(self.metadata)
        self.layers = _read_layers(arrays)
        self.mean, self.std = _read_normaliser(arrays, self.observation_size)
        for name, size in self._sizes().items():
            if self.metadata.get(name) != str(size):
                raise ValueError(
                    f"metadata {name!r} should be {str(size)!r} as the layers are shaped, "
                    f"got {self.metadata.get(name)!r}"
                )

    @property
    def observation_size(self) -> int:
        """Numbers that the first layer takes."""
        return int(self.layers[0][0].shape[1])

    @property
    def action_size(self) -> int:
        """Numbers that the last layer gives."""
        return int(self.layers[-1][0].shape[0])

    @property
    def task_name(self) -> str:
        """Name of the task it was trained on."""
        return self.metadata["task"]

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """The action that is held (n, robots, action) and for how many steps it was (n,)."""
        if self.action_repeat == 1:
            return {}
        return {"held": np.zeros(shape, np.float32), "age": np.zeros(shape[0], np.int64)}

    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """Action for each robot by its own observation, (n, robots, action)."""
        if seen.observations is None:
            raise ValueError("a network needs observations (n, robots, o), got none")
        if self.action_repeat == 1:
            return self.decide(seen.observations)
        held, age = memory["held"], memory["age"]
        due = age == 0
        if due.any():
            held[due] = self.decide(seen.observations[due])
        age[:] = (age + 1) % self.action_repeat
        return held.copy()

    def decide(self, observations: Floats) -> Floats:
        """Mean action (..., action) for observations (..., o)."""
        if observations.shape[-1] != self.observation_size:
            raise ValueError(
                f"the network takes observations of {self.observation_size} numbers, "
                f"got {observations.shape[-1]}"
            )
        flat = observations.reshape(-1, self.observation_size)
        actions = np.empty((len(flat), self.action_size), np.float32)
        rows = self._rows_at_once()
        for first in range(0, len(flat), rows):
            actions[first : first + rows] = self._decide(flat[first : first + rows])
        return actions.reshape(*observations.shape[:-1], self.action_size)

    def _decide(self, observations: Floats) -> Floats:
        hidden = np.clip((observations - self.mean) / self.std, -self.clip, self.clip)
        for weight, bias in self.layers[:-1]:
            hidden = np.tanh(hidden @ weight.T + bias)
        weight, bias = self.layers[-1]
        actions: Floats = np.clip(hidden @ weight.T + bias, -1.0, 1.0)
        return actions

    def _rows_at_once(self) -> int:
        """Rows whose products stay on one thread: more would go on spinning on other cores."""
        return max(16, ONE_THREAD // max(weight.size for weight, _ in self.layers))

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Raise ValueError where the task shows or takes something else than the network."""
        wanted = {"observation_size": observation_size, "action_size": task.action_size}
        for name, size in self._sizes().items():
            if size != wanted[name]:
                raise ValueError(
                    f"a network trained on {self.task_name!r} has {name} {size}, "
                    f"but task {task.name!r} has {wanted[name]}"
                )
        layout = self.metadata.get("layout", task.layout)
        if layout != task.layout:
            raise ValueError(
                f"a network trained on {self.task_name!r} looks at {layout}, "
                f"but task {task.name!r} shows {task.layout}"
            )

    def arrays(self) -> dict[str, NDArray[np.float32]]:
        """Copies of all arrays by the names that the file uses."""
        named = {"mean": self.mean, "std": self.std}
        for index, (weight, bias) in enumerate(self.layers):
            named[f"layers.{index}.weight"] = weight
            named[f"layers.{index}.bias"] = bias
        return {name: np.ascontiguousarray(array).copy() for name, array in named.items()}

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Self:
        """Read a policy file; ValueError names the file and what is wrong with it."""
        try:
            arrays, metadata = _read_file(Path(path))
            return cls(arrays, metadata)
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)} is not a usable policy file: {error}") from error

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy file whole or not at all, whenever the machine stops."""
        _safetensors()
        from safetensors.numpy import save

        write_atomically(Path(path), save(self.arrays(), metadata=self.metadata))

    def _sizes(self) -> dict[str, int]:
        return {"observation_size": self.observation_size, "action_size": self.action_size}


def _read_metadata(metadata: Mapping[str, str]) -> tuple[np.float32, int]:
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


def _read_layers(arrays: Mapping[str, Array]) -> list[tuple[Floats, Floats]]:
    """Weight (out, in) and bias (out,) of each layer, the input side first."""
    count = sum(name.endswith(".weight") for name in arrays)
    expected = {f"layers.{index}.{part}" for index in range(count) for part in ("weight", "bias")}
    expected |= {"mean", "std"}
    if count == 0 or set(arrays) != expected:
        odd = sorted(set(arrays) ^ expected) or ["layers.0.weight"]
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


def _read_normaliser(arrays: Mapping[str, Array], size: int) -> tuple[Floats, Floats]:
    """Mean and standard deviation of observations, (o,) each; the latter above 0."""
    mean, std = _read_array(arrays, "mean", (size,)), _read_array(arrays, "std", (size,))
    if not (std > 0.0).all():
        raise ValueError(f"array 'std' should be above 0 everywhere, got {std.min()}")
    return mean, std


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


def _safetensors() -> Any:  # noqa: ANN401  (an optional module has no type before it is there)
    try:
        import safetensors
    except ImportError as error:
        raise ImportError(INSTALL_HINT) from error
    return safetensors


def _read_file(path: Path) -> tuple[dict[str, Array], dict[str, str]]:
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
