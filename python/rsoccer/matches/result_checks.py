"""Validation of what tasks and simulators return, and of saved states."""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Final, TypeGuard

import numpy as np

from rsoccer import task_checks
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.task_definition import TaskDefinition

RESERVED_METRICS: Final = frozenset({"steps"})
"""Names in the info of an episode that are no metrics, see `Episodes.info`."""

SIMULATOR: Final = "simulator"
"""Name of the simulator's snapshot in a saved state."""
STEPS: Final = "steps"
"""Name of the control steps since episodes began in a saved state."""
_ARGUMENTS: Final = {
    "history": ("past_",),
    "sensing": ("senses.", "rng.senses"),
    "randomization": ("rng.randomization",),
}
"""Beginnings of names in a saved state by the argument of matches on which they depend."""


def commands(task: TaskDefinition, value: object, shape: tuple[int, ...]) -> Floats:
    """Validate the shape of a task's commands; the simulator validates the numbers.

    Args:
        task: the task.
        value: result of `Task.get_commands`.
        shape: required shape (n, robots, command).

    Returns:
        A float32 copy.

    Raises:
        TypeError: no array.
        ValueError: another shape.
    """
    if not isinstance(value, np.ndarray) or value.shape != shape:
        name = task_checks.label(task, "get_commands")
        got = task_checks.array(name, value, str(shape)).shape
        raise ValueError(f"{name}: expected shape {shape}, got {got}")
    return np.array(value, np.float32, order="C")  # a copy, because `Play` keeps and clears it


def rewards_and_ends(task: TaskDefinition, value: object, n: int) -> tuple[dict[str, Floats], Mask]:
    """Validate the parts of rewards and ends; `term` validates the terms.

    Args:
        task: the task.
        value: result of `Task.calculate_reward_and_done`.
        n: number of worlds.

    Returns:
        The terms by name, and the terminations (n,) bool.

    Raises:
        TypeError: other parts.
        ValueError: terminations of another shape or type.
    """
    if not isinstance(value, tuple) or len(value) != 2 or not _is_mapping(value[0]):
        name = task_checks.label(task, "calculate_reward_and_done")
        got = f"({', '.join(map(_kind, value))})" if isinstance(value, tuple) else _kind(value)
        raise TypeError(f"{name}: expected (reward terms by name, ends of episodes), got {got}")
    terms, ended = value
    if not isinstance(ended, np.ndarray) or ended.shape != (n,) or ended.dtype != np.bool_:
        name = task_checks.label(task, "calculate_reward_and_done")
        got = f"{ended.dtype} {ended.shape}" if isinstance(ended, np.ndarray) else _kind(ended)
        raise ValueError(f"{name}: expected bool ({n},) for the end of episodes, got {got}")
    return terms, ended


def _is_mapping(value: object) -> TypeGuard[Mapping[str, Any]]:
    """Whether a value is a mapping; a `dict`, as it mostly is, is known faster by its type."""
    return type(value) is dict or isinstance(value, Mapping)


def _kind(value: object) -> str:
    """Name of the type of a value."""
    return type(value).__name__


def term(task: TaskDefinition, name: str, value: object, shape: tuple[int, int]) -> None:
    """Validate the shape of a reward term.

    Args:
        task: the task.
        name: name of the term, for the error.
        value: (n, observers) or (n, 1).
        shape: (n, observers).

    Raises:
        TypeError: no array.
        ValueError: another shape.
    """
    method, expected = "calculate_reward_and_done", f"{shape} or {(shape[0], 1)}"
    source = task_checks.label(task, method)
    found = task_checks.array(f"{source}: {name!r}", value, expected)
    if found.shape not in (shape, (shape[0], 1)):
        raise ValueError(f"{source}: expected {expected} for {name!r}, got {found.shape}")


def metrics(task: TaskDefinition, value: object, n: int) -> dict[str, Floats]:
    """Validate the metrics of a task.

    Args:
        task: the task.
        value: result of `Task.metrics`.
        n: number of worlds.

    Returns:
        Float32 copies (n,) by name.

    Raises:
        TypeError: no mapping.
        ValueError: a metric of another type or shape, or with a name that infos use otherwise.
    """
    if not _is_mapping(value):
        name = task_checks.label(task, "metrics")
        raise TypeError(f"{name}: expected arrays ({n},) by name, got {_kind(value)}")
    found: dict[str, Floats] = {}
    for name, metric in value.items():
        try:
            found[name] = array = np.array(metric, np.float32)
        except (TypeError, ValueError):
            raise _wrong_metric(task, name, metric, n) from None
        if array.shape != (n,):
            raise _wrong_metric(task, name, metric, n)
    if not RESERVED_METRICS.isdisjoint(found):
        name = task_checks.label(task, "metrics")
        raise ValueError(f"{name}: expected another name than 'steps', the length of an episode")
    return found


def _wrong_metric(task: TaskDefinition, name: str, value: object, n: int) -> ValueError:
    got = value.shape if isinstance(value, np.ndarray) else _kind(value)
    source = task_checks.label(task, "metrics")
    return ValueError(f"{source}: expected numbers ({n},) for {name!r}, got {got}")


def times(value: Array, n: int) -> Doubles:
    """Validate the time stamps of a simulator's rows.

    Args:
        value: result of a method of the simulator.
        n: number of worlds.

    Returns:
        A copy (n,).

    Raises:
        ValueError: another shape or type, or a time that is not finite.
    """
    found = np.asarray(value)
    if found.shape != (n,) or found.dtype != np.float64 or not np.isfinite(found).all():
        raise ValueError(
            f"simulator: expected finite float64 ({n},) for the time stamps, got {value!r}"
        )
    return found.copy()


def state(saved: object, expected: Mapping[str, Array], free: Collection[str]) -> None:
    """Validate the names, shapes, types and numbers of a saved state.

    Args:
        saved: arrays of the saved state by name.
        expected: arrays of the same names, shapes and types; of "simulator" only the name counts.
        free: names of arrays whose numbers may be infinite or NaN.

    Raises:
        TypeError: no arrays by name.
        ValueError: a missing or unknown name, an array of another shape or type, a number that is
            not finite, or negative steps.
    """
    arrays = state_arrays(saved)
    mismatched = sorted(set(arrays) ^ set(expected), key=str)
    if mismatched:
        raise ValueError(f"state: missing or unknown {mismatched}{_reason(mismatched)}")
    for name, array in expected.items():
        found = arrays[name]
        if name == SIMULATOR:
            continue
        if (found.shape, found.dtype) != (array.shape, array.dtype):
            raise ValueError(
                f"state: expected {array.dtype} {array.shape} for {name!r}, "
                f"got {found.dtype} {found.shape}{_reason([name])}"
            )
        if name not in free and found.dtype.kind == "f" and not np.isfinite(found).all():
            got = found[~np.isfinite(found)][0]
            raise ValueError(f"state: expected finite numbers for {name!r}, got {got}")
        if name == STEPS and (found < 0).any():
            raise ValueError(f"state: expected at least 0 for {name!r}, got {found.min()}")


def state_arrays(saved: object) -> Mapping[str, Array]:
    """Validate that a saved state has arrays by name, as a snapshot of the simulator too.

    Args:
        saved: the saved state.

    Returns:
        The state.

    Raises:
        TypeError: no mapping, or a value that is no array.
    """
    if not isinstance(saved, Mapping):
        raise TypeError(f"state: expected arrays by name, got {saved!r}")
    for name, found in saved.items():
        if not isinstance(found, np.ndarray):
            raise TypeError(f"state: expected an array for {name!r}, got {found!r}")
        if name == SIMULATOR and (found.dtype != np.uint8 or found.ndim != 1):
            raise TypeError(
                f"state: expected uint8 (bytes,) for {name!r}, got {found.dtype} {found.shape}"
            )
    return saved


def _reason(names: Sequence[str]) -> str:
    """The arguments of matches on which arrays depend, as the end of an error."""
    arguments = [
        argument
        for argument, prefixes in _ARGUMENTS.items()
        if any(str(name).startswith(prefixes) for name in names)
    ]
    if not arguments:
        return ""
    return f"; expected a state of matches with the same {' and '.join(arguments)}"
