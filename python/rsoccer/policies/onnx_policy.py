"""ONNX files as policies: those of `rsoccer export --onnx`, and models of other programs."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any, Final, Self

import numpy as np

from rsoccer.files import as_path
from rsoccer.policies import policy_file, training_conditions
from rsoccer.policies.fits import check_fits
from rsoccer.policies.heads import Head
from rsoccer.policies.held_actions import HeldActions

if TYPE_CHECKING:
    from rsoccer.arrays import Array, Floats
    from rsoccer.rng import WorldRng
    from rsoccer.task import Task

INSTALL_HINT: Final = "playing ONNX files needs onnxruntime: pip install 'rsoccer[onnx]'"
ACTIONS: Final = ("action", "actions")
"""Names of the output with the actions; without one of them it is the first output."""
MODES: Final = ("sample", "mean")
"""Action selection: drawn from the distribution of the file, or the most likely action."""
_TYPES: Final = {"tensor(float)": np.float32, "tensor(double)": np.float64}


class OnnxPolicy(HeldActions):
    """A policy whose network is an ONNX model, run by onnxruntime on one thread.

    The model has one input (n, o), the observations of robots, with n of any size, or 1. Its output
    named `action` or `actions`, or else its first one, has the actions (n, a), which are clipped to
    [-1, 1]; or whole numbers (n,), the rows of the task's `action_table`. Normalization of
    observations is part of the model. Files that the package has exported also keep their action
    repeat, their history, the task of the training, and the distribution of mode "sample".

    Example:
        >>> policy = OnnxPolicy.load("policy.onnx")  # doctest: +SKIP
        >>> rsoccer.evaluate(policy, "ou", task="VSS-v0")  # doctest: +SKIP
    """

    def __init__(
        self, content: bytes, mode: str | None = None, action_table: Floats | None = None
    ) -> None:
        """Build a policy from the bytes of an ONNX file.

        Args:
            content: the bytes.
            mode: "sample" or "mean"; None is "sample" if the file has a distribution, else "mean".
            action_table: (choices, action) rows for a model that gives whole numbers, that of the
                discrete task to be played; None without.

        Raises:
            ImportError: onnxruntime is not installed.
            ValueError: no ONNX model, one with other inputs or outputs, or a mode that it lacks.
        """
        self._content = content
        self._session = _session(content)
        self.metadata: dict[str, str] = dict(self._session.get_modelmeta().custom_metadata_map)
        self._own = self.metadata.get("format", "").startswith("rsoccer-policy-")
        self._input, self._dtype, self._rows, self.observation_size = _input(self._session)
        self._outputs = [output.name for output in self._session.get_outputs()]
        self._action = next((n for n in self._outputs if n in ACTIONS), self._outputs[0])
        self._table = action_table
        self.action_repeat = 1
        if self._own:
            _, self.action_repeat = policy_file.read_metadata(self.metadata)
            self.forecasts = self.needs_forecast = training_conditions.has_forecast(self.metadata)
            self.shield = policy_file.read_shield(self.metadata)
        self.action_size = self._probed_size()
        if self._own:
            self.stack = policy_file.read_stack(
                self.metadata, self.observation_size, self.action_size
            )
        self.mode = self._checked_mode(mode)

    @classmethod
    def load(
        cls, path: str | os.PathLike[str], mode: str | None = None, task: Task | None = None
    ) -> Self:
        """Read an ONNX file.

        Args:
            path: the file.
            mode: "sample" or "mean"; None is as in training.
            task: the task that is played, whose `action_table` a model needs that gives whole
                numbers; None without.

        Returns:
            The policy.

        Raises:
            FileNotFoundError: no such file.
            ImportError: onnxruntime is not installed.
            TypeError: no path.
            ValueError: no usable ONNX model, or a mode that it lacks.
        """
        file = as_path("path", path)
        if not file.is_file():
            raise FileNotFoundError(f"policy: the file {file} does not exist")
        table = None if task is None else task.action_table
        try:
            return cls(file.read_bytes(), mode, table)
        except ValueError as error:
            raise ValueError(f"{os.fspath(path)} is not a usable policy: {error}") from error

    @property
    def task_name(self) -> str | None:
        """Name of the task that it was trained on; None for a model of another program."""
        return self.metadata["task"] if self._own else None

    @property
    def task_options(self) -> dict[str, Any]:
        """Options of that task in the training; {} for the defaults."""
        return policy_file.read_task_options(self.metadata) if self._own else {}

    @property
    def history(self) -> int:
        """Observations in a stacked one; 1 if it reads plain observations."""
        return 1 if self.stack is None else self.stack.history

    def choose(self, observations: Floats, rng: WorldRng) -> Floats:
        """Choose actions as the mode says, without holding them.

        Args:
            observations: (n, robots, o) observations, stacked with a history.
            rng: (n,) random streams; used in mode "sample".

        Returns:
            (n, robots, action) in [-1, 1].

        Raises:
            ValueError: observations of another size, or actions that are not finite.
        """
        if self.mode == "mean":
            return self.mean_actions(observations)
        lead = observations.shape[:-1]
        if self._head == "categorical":
            (logits,) = self._run(observations, ["logits"])
            table = np.array(json.loads(self.metadata["action_table"]), np.float32)
            head = Head("categorical", len(table), table=table)
            return head.drawn_actions(logits.reshape(*lead, -1), rng)
        mean, std = (part.reshape(*lead, -1) for part in self._run(observations, ["mean", "std"]))
        return Head(self._head, self.action_size, std).drawn_actions(mean, rng)

    def mean_actions(self, observations: Floats) -> Floats:
        """Return the actions of the model, (..., action) in [-1, 1].

        Args:
            observations: (..., o) observations, stacked with a history.

        Raises:
            ValueError: observations of another size, or actions that are not finite.
        """
        (actions,) = self._run(observations, [self._action])
        if actions.dtype.kind in "iu":
            actions = self._rows_of_table(actions)
        shaped = actions.reshape(*observations.shape[:-1], self.action_size).astype(np.float32)
        if not np.isfinite(shaped).all():
            raise ValueError(f"the ONNX model gives {self._action!r} with NaN or infinite numbers")
        return np.clip(shaped, -1.0, 1.0, out=shaped)

    def check_fits(self, task: Task, observation_size: int) -> None:
        """Raise ValueError for a task with other observations or actions."""
        if not self.action_size:
            raise ValueError(
                f"the ONNX model gives whole numbers as {self._action!r}, the rows of an action "
                f"table: expected a discrete task, got {task.name!r}"
            )
        source = f"a network trained on {self.task_name!r}" if self._own else "the ONNX model"
        sizes = {"observation_size": self.observation_size, "action_size": self.action_size}
        layout = self.metadata.get("layout") if self._own else None
        trained = (self.task_name, self.task_options) if self._own and self.task_name else None
        check_fits(source, sizes, layout, self.history, task, observation_size, trained)

    @property
    def _head(self) -> str:
        return self.metadata.get("head", "gaussian")

    def _checked_mode(self, mode: str | None) -> str:
        """The mode; as in training if it is None."""
        if mode not in (None, *MODES):
            raise ValueError(f"mode: expected one of {MODES}, got {mode!r}")
        can_sample = self._own and bool({"std", "logits"} & set(self._outputs))
        if mode == "sample" and not can_sample:
            raise ValueError(
                "mode: expected 'mean', as the model has no distribution, got 'sample'"
            )
        return mode or ("sample" if can_sample else "mean")

    def _probed_size(self) -> int:
        """Numbers in an action, found by a run, as sizes may be open; 0 for unknown rows."""
        (actions,) = self._run(np.zeros((1, self.observation_size), np.float32), [self._action])
        if actions.dtype.kind in "iu" and actions.size == 1:
            return 0 if self._table is None else int(self._table.shape[1])
        if actions.dtype.kind == "f" and actions.ndim == 2 and len(actions) == 1:
            return int(actions.shape[1])
        raise ValueError(
            f"output {self._action!r}: expected actions (n, a), or whole numbers (n,) for a "
            f"discrete task, got {actions.dtype} {actions.shape} for one observation"
        )

    def _rows_of_table(self, indices: Array) -> Floats:
        """Rows (n, a) of the action table."""
        if self._table is None:
            raise ValueError(
                f"output {self._action!r}: expected an `action_table` for its whole numbers, got "
                "none; give the discrete task that is played"
            )
        flat = indices.reshape(-1)
        if flat.min() < 0 or flat.max() >= len(self._table):
            raise ValueError(
                f"output {self._action!r}: expected rows from 0 to {len(self._table) - 1}, "
                f"got {flat.min()} to {flat.max()}"
            )
        rows: Floats = self._table[flat]
        return rows

    def _run(self, observations: Floats, names: list[str]) -> list[Array]:
        """Outputs of the model for observations (..., o), each (rows, ...)."""
        if observations.shape[-1] != self.observation_size:
            raise ValueError(
                f"the network takes observations of {self.observation_size} numbers, "
                f"got {observations.shape[-1]}"
            )
        flat = np.ascontiguousarray(observations.reshape(-1, self.observation_size), self._dtype)
        parts = [flat] if self._rows is None else np.split(flat, len(flat))
        results = [self._session.run(names, {self._input: part}) for part in parts]
        return [np.concatenate(column) for column in zip(*results, strict=True)]

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_session"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._session = _session(self._content)


def _session(content: bytes) -> Any:  # noqa: ANN401  (onnxruntime has no types)
    """A session on one thread; ValueError for bytes that are no model."""
    try:
        import onnxruntime
    except ImportError as error:
        raise ImportError(INSTALL_HINT, name="onnxruntime") from error
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 3  # errors
    try:
        return onnxruntime.InferenceSession(content, options, ["CPUExecutionProvider"])
    except Exception as error:  # it raises classes of its own, which are not public
        text = " ".join(str(error).split())
        raise ValueError(f"onnxruntime cannot load it: {text}") from error


def _input(session: Any) -> tuple[str, Any, int | None, int]:  # noqa: ANN401
    """Name, type, rows (None for any number) and size of the one input."""
    inputs = session.get_inputs()
    described = ", ".join(f"{x.name} {x.type} {x.shape}" for x in inputs)
    expected = "input: expected one of float32 (n, o), with n of any size or 1"
    if len(inputs) != 1 or inputs[0].type not in _TYPES or len(inputs[0].shape) != 2:
        raise ValueError(f"{expected}, got {described}")
    rows, size = inputs[0].shape
    if not isinstance(size, int) or (isinstance(rows, int) and rows != 1):
        raise ValueError(f"{expected}, got {described}")
    return inputs[0].name, _TYPES[inputs[0].type], rows if isinstance(rows, int) else None, size
