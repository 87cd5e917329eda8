"""Trained policies: a small perceptron that runs in NumPy."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rsoccer import checks, option_values
from rsoccer.arrays import Array, Floats
from rsoccer.files import as_path
from rsoccer.policies import policy_file, training_conditions
from rsoccer.policies.activations import activation as activation_of
from rsoccer.policies.fits import check_fits
from rsoccer.policies.heads import CHOOSING, Deviation
from rsoccer.policies.held_actions import HeldActions
from rsoccer.policies.layers import read_layers
from rsoccer.policies.shield import check_shield
from rsoccer.registry import as_task, is_registered, options_of

if TYPE_CHECKING:
    from rsoccer._core import Sensing
    from rsoccer.policies.layers import Layers
    from rsoccer.policies.policy_file import Value
    from rsoccer.policies.torch_network import TorchNetwork
    from rsoccer.randomization import Ranges
    from rsoccer.rng import WorldRng
    from rsoccer.sources import SensingSource
    from rsoccer.task import Task

SINGLE_THREAD_SIZE: Final = 2**18
"""Multiplications in a matrix product up to which OpenBLAS uses one thread."""

MODES: Final = ("sample", "mean")
"""Action selection of a network: drawn from its distribution, or the most likely action."""


class Network(HeldActions):
    """A trained network, run in NumPy; PyTorch is needed for training only.

    In mode "sample" each decision is drawn from the distribution of the training, with the random
    stream of each world. Mode "mean" is deterministic: the mean of a Gaussian, the most likely one
    of discrete choices. A robot may then stay stuck where noise would free it. With `action_repeat`
    k the network decides at every k-th control step and holds its action in
    between. With a `history` it stacks its last observations and actions itself, so it plays
    wherever a network without one does.

    Matrix products are not bit-equal between batch sizes, so actions differ by about 1e-6 between
    batch sizes. For reproducible numbers play in chunks of one size, as `rsoccer.evaluate` does.
    The random draws are equal in all batch sizes.

    Example:
        >>> network = Network.load("policy.safetensors", mode="mean")  # doctest: +SKIP
        >>> controllers = {"blue": network}  # doctest: +SKIP
        >>> matches = rsoccer.Matches(network.task_name, controllers=controllers)  # doctest: +SKIP
    """

    def __init__(
        self, arrays: Mapping[str, Array], metadata: Mapping[str, str], mode: str | None = None
    ) -> None:
        """Build a network from the content of a policy file; the arrays are copied.

        Args:
            arrays: weights and normalization by name, see `rsoccer.policies.policy_file`.
            metadata: text by key, see the same module.
            mode: "sample" or "mean"; None is "sample" if the head has a distribution, else "mean".

        Raises:
            ValueError: arrays, metadata or mode that do not fit the format or each other.
        """
        self.metadata = dict(metadata)
        self.clip, self.action_repeat = policy_file.read_metadata(self.metadata)
        policy_file.read_task_options(self.metadata)  # refuses wrong ones before they are needed
        training_conditions.describe(self.metadata)
        self.forecasts = self.needs_forecast = training_conditions.has_forecast(self.metadata)
        self.layers = policy_file.read_layers(arrays)
        self.mean, self.std = policy_file.read_normalizer(arrays, self.observation_size)
        self.head = policy_file.read_head(arrays, self.metadata, len(self.layers[-1][1]))
        self.value = policy_file.read_value(arrays, self.metadata, self.observation_size)
        self._activation = activation_of(self.activation)
        self.stack = policy_file.read_stack(self.metadata, self.observation_size, self.action_size)
        self.shield = policy_file.read_shield(self.metadata)
        self.mode = self._checked_mode(mode)
        for name, size in self._sizes().items():
            if self.metadata.get(name) != str(size):
                raise ValueError(
                    f"metadata {name!r} should be {str(size)!r} as the layers are shaped, "
                    f"got {self.metadata.get(name)!r}"
                )

    @classmethod
    def from_layers(
        cls,
        task: Task | str,
        layers: Layers,
        action_std: ArrayLike | None = None,
        *,
        activation: str | None = None,
        head: str = "gaussian",
        deviation: Deviation | str | None = None,
        action_table: ArrayLike | None = None,
        action_repeat: int = 1,
        history: int = 1,
        mean: ArrayLike = 0.0,
        std: ArrayLike = 1.0,
        clip: float = 10.0,
        task_name: str | None = None,
        task_options: Mapping[str, Any] | None = None,
        sensing: SensingSource | None = None,
        randomization: Ranges | None = None,
        shield: str | None = None,
        value: Value | None = None,
    ) -> Self:
        """Return a network of weights that another program has trained.

        `rsoccer.policies.libraries` makes networks of whole models of libraries.

        Args:
            task: the task of the training, such as `Matches.task`, or its name.
            layers: weight (out, in) and bias (out,) of each linear layer, from the observation
                to the action, with the activation between them; or the modules of torch,
                `nn.Linear` and an activation in turn, such as an `nn.Sequential`.
            action_std: (action,) standard deviation of the actions; None for a policy without
                noise, or with one that the network computes.
            activation: between the layers: "tanh", "relu", "leaky_relu", "elu" or "silu"; None is
                that of the modules, or tanh.
            head: meaning of the outputs of the last layer: "gaussian", "squashed", "categorical"
                or "greedy", see `rsoccer.policies.heads`.
            deviation: standard deviation as a function of the second half of the outputs of the
                last layer, a `Deviation` or its text, such as "exp -20 2"; None without.
            action_table: (choices, action) actions that "categorical" and "greedy" choose from;
                None for those of the task.
            action_repeat: control steps for which an action is held, at least 1.
            history: observations in each stacked one that it reads, at least 1, as for `Matches`.
            mean: (o,) or a number: subtracted from observations.
            std: (o,) or a number above 0: observations are divided by it.
            clip: bound of a normalized observation, above 0, standard deviations.
            task_name: name of the task for `make_task`; None for the task's own, which has to be
                registered.
            task_options: options of the task for `make_task`; None for those of the task that
                differ from its defaults, or for none where a name is given.
            sensing: what robots knew of the true state in the training, as for `Matches`; a note
                in the file, which does not change how the policy plays.
            randomization: numbers that each episode of the training drew; a note, too.
            shield: "vsss" or "ssl_attack" to change actions against rules, see
                `rsoccer.policies.shield`; None for none.
            value: the value network of the training, with which `rsoccer.policies.lookahead` plays;
                None without one.

        Raises:
            TypeError: neither a task nor its name, something else than layers, or an argument of
                another wrong type.
            ValueError: other modules, an unknown name in `randomization`, weights or numbers that
                do not fit the policy file's format or the task, or a task that the file cannot
                name.
        """
        task = as_task(task)
        clip = checks.positive_number("clip", clip)
        most = policy_file.MAX_ACTION_REPEAT
        action_repeat = checks.integer_in_range("action_repeat", action_repeat, 1, most)
        if task_name is None:
            task_options = _named_options(task, task_options)
        parts, activation = read_layers(layers, activation)
        if action_table is None and head in CHOOSING:
            action_table = task.action_table
        inputs = parts[0][0].shape[-1:]
        arrays: dict[str, Array] = {
            name: _by_input(name, each, inputs) for name, each in (("mean", mean), ("std", std))
        }
        arrays |= policy_file.named_layers(policy_file.POLICY, parts)
        for name, array in (("action_std", action_std), ("action_table", action_table)):
            if array is not None:
                arrays[name] = np.asarray(array, np.float32)
        text = deviation.text if isinstance(deviation, Deviation) else deviation
        beyond = {"head": None if head == "gaussian" else head, "deviation": text}
        kept = {name: value for name, value in beyond.items() if value is not None}
        metadata = {
            "format": policy_file.HEAD_FORMAT if kept else policy_file.FORMAT,
            "task": task.name if task_name is None else task_name,
            "layout": task.layout.text,
            "observation_size": str(arrays["mean"].size),
            "action_size": str(_action_size(arrays, parts[-1][1].size, deviation)),
            "activation": activation,
            "clip": f"{clip:g}",
            "action_repeat": str(action_repeat),
            **kept,
        }
        if checks.integer("history", history, 1) > 1:
            metadata["history"] = str(history)
        if task_options:
            encoded = {name: option_values.encoded(name, v) for name, v in task_options.items()}
            metadata["task_options"] = json.dumps(encoded, sort_keys=True)
        metadata |= training_conditions.written(sensing, randomization)
        check_shield("shield", shield, task)
        metadata |= {} if shield is None else {"shield": shield}
        metadata |= {} if value is None else {policy_file.VALUE: value.text}
        arrays |= {} if value is None else value.arrays()
        network = cls(arrays, metadata)
        network.check_fits(task, task.layout.size)
        return network

    @property
    def observation_size(self) -> int:
        """Numbers in an observation, a stacked one with a history."""
        return int(self.layers[0][0].shape[1])

    @property
    def history(self) -> int:
        """Observations in a stacked one, as for `Matches`; 1 if it reads plain observations."""
        return 1 if self.stack is None else self.stack.history

    @property
    def action_size(self) -> int:
        """Numbers in an action."""
        return self.head.action_size

    @property
    def action_std(self) -> Floats | None:
        """(action,) standard deviation of the actions; None if the network computes it, or none."""
        return self.head.action_std

    @property
    def activation(self) -> str:
        """Name of the activation between the layers, such as "tanh"."""
        return self.metadata["activation"]

    @property
    def task_name(self) -> str:
        """Name of the task that it was trained on, for `make_task`."""
        return self.metadata["task"]

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of that task in the training, for `make_task`; {} for the defaults."""
        return policy_file.read_task_options(self.metadata)

    @property
    def sensing(self) -> Sensing | str | None:
        """Senses of the robots in the training, a `Sensing` or "module:name"; None for none."""
        return training_conditions.read_sensing(self.metadata)

    @property
    def randomization(self) -> dict[str, Any]:
        """Distributions of numbers in the training by name; {} if all matches had the same."""
        return training_conditions.read_randomization(self.metadata)

    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """Choose actions as the mode says, without holding them.

        Args:
            observations: (n, robots, o) observations, stacked with a history.
            rng: (n,) random streams; used in mode "sample".

        Returns:
            (n, robots, action) in [-1, 1].
        """
        if self.mode == "mean" or not self.head.can_sample:
            return self.mean_actions(observations)
        return self.head.drawn_actions(self.outputs(observations), rng)

    def mean_actions(self, observations: Floats) -> Floats:
        """Return the actions of mode "mean", (..., action) in [-1, 1].

        Args:
            observations: (..., o) observations, stacked with a history.
        """
        return self.head.mean_actions(self.outputs(observations))

    def outputs(self, observations: Floats) -> Floats:
        """Return the outputs of the last layer, (..., outputs), of which the head makes actions.

        Args:
            observations: (..., o) observations, stacked with a history.

        Raises:
            ValueError: observations of another size.
        """
        return self._outputs_of(self.layers, observations)

    def values(self, observations: Floats) -> Floats:
        """Return the discounted returns that robots expect, in `value.reward_std`, (...).

        Args:
            observations: (..., o) observations, stacked with a history.

        Raises:
            ValueError: a policy without a value network, or observations of another size.
        """
        if self.value is None:
            raise ValueError(f"expected a policy with a value network, got one of {self.task_name}")
        values: Floats = self._outputs_of(self.value.layers, observations)[..., 0]
        return values

    def set_value(self, value: Value | None) -> None:
        """Replace the value network, in the metadata too.

        Args:
            value: the value network; None to remove it.
        """
        self.value = value
        self.metadata.pop(policy_file.VALUE, None)
        if value is not None:
            self.metadata[policy_file.VALUE] = value.text

    def _outputs_of(self, layers: list[tuple[Floats, Floats]], observations: Floats) -> Floats:
        """Outputs of the policy or of the value network, (..., outputs)."""
        if observations.shape[-1] != self.observation_size:
            raise ValueError(
                f"the network takes observations of {self.observation_size} numbers, "
                f"got {observations.shape[-1]}"
            )
        flat, size = observations.reshape(-1, observations.shape[-1]), len(layers[-1][1])
        outputs = np.empty((len(flat), size), np.float32)
        # More rows would use further threads, which spin on other cores. Layers that are larger by
        # themselves use them anyway.
        rows = SINGLE_THREAD_SIZE // max(weight.size for weight, _ in layers) or max(1, len(flat))
        for first in range(0, len(flat), rows):
            outputs[first : first + rows] = self._forward(layers, flat[first : first + rows])
        return outputs.reshape(*observations.shape[:-1], size)

    def _forward(self, layers: list[tuple[Floats, Floats]], observations: Floats) -> Floats:
        hidden = np.clip((observations - self.mean) / self.std, -self.clip, self.clip)
        for weight, bias in layers[:-1]:
            hidden = self._activation(hidden @ weight.T + bias)
        weight, bias = layers[-1]
        outputs: Floats = hidden @ weight.T + bias
        return outputs

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Raise ValueError for a task with other observations or actions."""
        check_fits(
            f"a network trained on {self.task_name!r}",
            self._sizes(),
            self.metadata.get("layout"),
            self.history,
            task,
            observation_size,
            (self.task_name, self.task_options),
        )

    def arrays(self) -> dict[str, NDArray[np.float32]]:
        """Return copies of all arrays, by their names in the policy file."""
        optional = {"action_std": self.head.action_std, "action_table": self.head.table}
        named = {"mean": self.mean, "std": self.std}
        named |= {name: array for name, array in optional.items() if array is not None}
        named |= policy_file.named_layers(policy_file.POLICY, self.layers)
        named |= {} if self.value is None else self.value.arrays()
        return {name: np.ascontiguousarray(array).copy() for name, array in named.items()}

    @classmethod
    def load(cls, path: str | os.PathLike[str], mode: str | None = None) -> Self:
        """Read a policy file.

        Args:
            path: the file.
            mode: "sample" or "mean"; None is as in training.

        Returns:
            The network.

        Raises:
            FileNotFoundError: no such file.
            TypeError: no path.
            ValueError: the file is not a usable policy file, or the mode does not fit it.
        """
        file = as_path("path", path)
        if not file.exists():
            raise FileNotFoundError(f"policy: the file {file} does not exist")
        try:
            network = cls(*policy_file.read_file(file))
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)} is not a usable policy file: {error}") from error
        network.mode = network._checked_mode(mode)
        return network

    def to_torch(self) -> TorchNetwork:
        """Return a copy as a module of torch, with the normalization and the head.

        Raises:
            ImportError: torch is not installed.
        """
        from rsoccer.policies.torch_network import TorchNetwork

        return TorchNetwork(self)

    def save(self, path: str | os.PathLike[str], *, half_precision: bool = False) -> None:
        """Write the policy file atomically; equal policies give equal bytes.

        Args:
            path: the file; an existing one is replaced.
            half_precision: write the weights as float16, in half the size and with 3 digits.

        Raises:
            ImportError: safetensors is not installed.
            ValueError: a weight above 65,504, the greatest number of float16.
        """
        arrays: dict[str, Array] = dict(self.arrays())
        if half_precision:
            limit = np.finfo(np.float16).max
            for name in [name for name in arrays if name.endswith(".weight")]:
                largest = np.abs(arrays[name]).max()
                if largest > limit:
                    raise ValueError(f"{name}: expected at most {limit:.0f}, got {largest:g}")
                arrays[name] = arrays[name].astype(np.float16)
        policy_file.write_file(Path(path), arrays, self.metadata)

    def save_onnx(self, path: str | os.PathLike[str]) -> None:
        """Write an ONNX file atomically, see `rsoccer.policies.onnx_export`.

        Args:
            path: the file, `*.onnx`; an existing one is replaced.

        Raises:
            ImportError: onnx is not installed.
            ValueError: another name of a file.
        """
        from rsoccer.policies.onnx_export import write_onnx

        write_onnx(self, Path(path))

    def _sizes(self) -> dict[str, int]:
        return {"observation_size": self.observation_size, "action_size": self.action_size}

    def _checked_mode(self, mode: str | None) -> str:
        """The mode; as in training if it is None."""
        if mode not in (None, *MODES):
            raise ValueError(f"mode: expected one of {MODES}, got {mode!r}")
        if mode == "sample" and not self.head.can_sample:
            raise ValueError(
                "mode: expected 'mean', as the policy has no action_std to sample with, "
                "got 'sample'"
            )
        return mode or ("sample" if self.head.can_sample else "mean")


def _named_options(task: Task, options: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """Options of a task, those given or its own, with which its name stands for it in a file."""
    if not is_registered(task):
        kind = type(task).__name__
        raise ValueError(
            "task: expected a registered task, as a policy file keeps its name and options, got "
            f"{kind}; register it first with rsoccer.register('{kind}-v0', {kind}), or give a "
            "task_name"
        )
    found = options_of(task) if options is None else options
    if found is None:
        raise ValueError(
            f"task: expected options that a policy file can keep, got others in {task.name}; "
            "give those to keep as task_options"
        )
    return found


def _by_input(name: str, value: ArrayLike, inputs: tuple[int, ...]) -> Floats:
    """One number for each input of the first layer, from one for all or from one each."""
    array = checks.as_array(name, value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected numbers, got {value!r}")
    if array.shape not in ((), inputs):
        raise ValueError(f"{name}: expected a number or shape {inputs}, got {array.shape}")
    return np.broadcast_to(array.astype(np.float32), inputs).copy()


def _action_size(
    arrays: Mapping[str, Array], outputs: int, deviation: Deviation | str | None
) -> int:
    """Numbers in an action, from arrays that may still be wrong."""
    if "action_table" in arrays:
        return int(arrays["action_table"].shape[-1])
    return outputs if deviation is None else outputs // 2
