"""Validation of what tasks and simulators return, and of saved states."""

from collections.abc import Collection, Mapping, Sequence
from typing import Final

import numpy as np

from rsoccer.arrays import Array, Doubles, Floats, Mask

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


def commands(value: Array, shape: tuple[int, ...]) -> Floats:
    """Validate the shape of a task's commands; the simulator validates the numbers.

    Args:
        value: result of `Task.get_commands`.
        shape: required shape (n, robots, command).

    Returns:
        A float32 copy.

    Raises:
        ValueError: another shape.
    """
    if value.shape != shape:
        raise ValueError(f"get_commands: expected shape {shape}, got {value.shape}")
    return np.array(value, np.float32, order="C")  # a copy, because `Play` keeps and clears it


def term(name: str, value: Floats, shape: tuple[int, int]) -> None:
    """Validate the shape of a reward term.

    Args:
        name: name of the term, for the error.
        value: (n, observers) or (n, 1).
        shape: (n, observers).

    Raises:
        ValueError: another shape.
    """
    if value.shape not in (shape, (shape[0], 1)):
        raise ValueError(
            f"calculate_reward_and_done: expected {shape} or {(shape[0], 1)} for {name!r}, "
            f"got {value.shape}"
        )


def done(value: Mask, n: int) -> Mask:
    """Validate the terminations of a task.

    Args:
        value: the second result of `Task.calculate_reward_and_done`.
        n: number of worlds.

    Returns:
        The value, (n,) bool.

    Raises:
        ValueError: another shape or type.
    """
    if value.shape != (n,) or value.dtype != np.bool_:
        raise ValueError(
            f"calculate_reward_and_done: expected bool ({n},) for the end of episodes, "
            f"got {value.dtype} {value.shape}"
        )
    return value


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
