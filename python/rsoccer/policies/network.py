"""A trained policy: a small perceptron run in NumPy, kept in one safetensors file."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Array, Floats
from rsoccer.policies import policy_file
from rsoccer.policies.base import Memory, Policy, PolicyInput

if TYPE_CHECKING:
    from rsoccer.rng import WorldRng
    from rsoccer.task import Task

ONE_THREAD = 2**18  # multiplications of a product that OpenBLAS still does on one thread

PLAYS: Final = ("sample", "mean")
"""How a network may act: drawn with the spread it was trained with, or the mean of that."""


class Network(Policy):
    """A trained network: actions (n, robots, action) in [-1, 1], chosen as it was trained.

    Torch is needed to train it, not to play with it. It decides as often as it did in training:
    with `action_repeat` k it looks at every k-th control step and holds its action between. With
    `play` "sample" it draws each decision around its mean, with the spread that it learned with,
    from the stream of each world; "mean" is deterministic, and stands still where chance would
    have freed it. Products of matrices are not bit-equal between batch sizes, so in two batch
    sizes its actions may differ by about 1e-6; whoever needs the same numbers twice plays in
    chunks of the same size, as `rsoccer.evaluate` does. What it draws is equal in all.
    """

    observes: Literal["nothing", "view", "observation"] = "observation"

    def __init__(
        self, arrays: Mapping[str, Array], metadata: Mapping[str, str], play: str | None = None
    ) -> None:
        """Check names, shapes, numbers and metadata, then copy the arrays.

        `arrays` holds `layers.<i>.weight` (out, in), `layers.<i>.bias` (out,), `mean`, `std`
        (observation,), and `action_std` (action,) unless it was trained without a spread, all
        float32. `metadata` is text: format, task, observation_size, action_size, activation,
        clip (bound of a normalised observation), where it is known layout (`Task.layout`) and,
        if it is not 1, action_repeat (control steps). `play` is "sample" or "mean"; None is as it
        was trained.
        """
        self.metadata = dict(metadata)
        self.clip, self.action_repeat = policy_file.read_metadata(self.metadata)
        self.layers = policy_file.read_layers(arrays)
        self.mean, self.std = policy_file.read_normaliser(arrays, self.observation_size)
        self.action_std = policy_file.read_spread(arrays, self.action_size)
        self.play = _chosen(play, self.action_std)
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
        """Name of the task it was trained on, for `make_task`."""
        return self.metadata["task"]

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """The action that is held (n, robots, action) and for how many steps it was (n,)."""
        if self.action_repeat == 1:
            return {}
        return {"held": np.zeros(shape, np.float32), "age": np.zeros(shape[0], np.int64)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Action for each robot by its own observation, (n, robots, action)."""
        if inputs.observations is None:
            raise ValueError("a network needs observations (n, robots, o), got none")
        if self.action_repeat == 1:
            return self.choose(inputs.observations, rng)
        held, age = memory["held"], memory["age"]
        due = age == 0
        if due.any():
            streams = rng[due]
            held[due] = self.choose(inputs.observations[due], streams)
            rng.put(due, streams)
        age[:] = (age + 1) % self.action_repeat
        return held.copy()

    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """A decision for each robot as `play` says, (n, robots, action), by (n, robots, o)."""
        if self.play == "mean" or self.action_std is None:
            return self.decide(observations)
        actions = self._means(observations)
        actions += self.action_std * rng.normal(actions.shape[1:])
        return np.clip(actions, -1.0, 1.0, out=actions)

    def decide(self, observations: Floats) -> Floats:
        """Mean action (..., action) for observations (..., o)."""
        actions = self._means(observations)
        return np.clip(actions, -1.0, 1.0, out=actions)

    def _means(self, observations: Floats) -> Floats:
        """What actions are drawn around (..., action), beyond [-1, 1] too."""
        if observations.shape[-1] != self.observation_size:
            raise ValueError(
                f"the network takes observations of {self.observation_size} numbers, "
                f"got {observations.shape[-1]}"
            )
        flat = observations.reshape(-1, self.observation_size)
        actions = np.empty((len(flat), self.action_size), np.float32)
        rows = self._rows_at_once()
        for first in range(0, len(flat), rows):
            actions[first : first + rows] = self._forward(flat[first : first + rows])
        return actions.reshape(*observations.shape[:-1], self.action_size)

    def _forward(self, observations: Floats) -> Floats:
        hidden = np.clip((observations - self.mean) / self.std, -self.clip, self.clip)
        for weight, bias in self.layers[:-1]:
            hidden = np.tanh(hidden @ weight.T + bias)
        weight, bias = self.layers[-1]
        actions: Floats = hidden @ weight.T + bias
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
        if self.action_std is not None:
            named["action_std"] = self.action_std
        for index, (weight, bias) in enumerate(self.layers):
            named[f"layers.{index}.weight"] = weight
            named[f"layers.{index}.bias"] = bias
        return {name: np.ascontiguousarray(array).copy() for name, array in named.items()}

    @classmethod
    def load(cls, path: str | os.PathLike[str], play: str | None = None) -> Self:
        """Read a policy file; ValueError names the file and what is wrong with it.

        `play` is "sample" or "mean"; without it, the network plays as it was trained.
        """
        try:
            network = cls(*policy_file.read_file(Path(path)))
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)} is not a usable policy file: {error}") from error
        network.play = _chosen(play, network.action_std)
        return network

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the policy file whole or not at all; equal policies are equal bytes."""
        policy_file.write(Path(path), self.arrays(), self.metadata)

    def _sizes(self) -> dict[str, int]:
        return {"observation_size": self.observation_size, "action_size": self.action_size}


def _chosen(play: str | None, spread: Floats | None) -> str:
    """How to play; as it was trained if nobody says."""
    if play not in (None, *PLAYS):
        raise ValueError(f"play: expected one of {PLAYS}, got {play!r}")
    if play == "sample" and spread is None:
        raise ValueError(
            "play: expected 'mean', as there is no spread to sample with, got 'sample'"
        )
    return play or ("mean" if spread is None else "sample")
