"""Validation of what tasks and simulators return, and of saved states."""

from collections.abc import Mapping

import numpy as np

from rsoccer.arrays import Array, Doubles, Floats, Mask


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


def state(saved: Mapping[str, Array], expected: Mapping[str, Array]) -> None:
    """Validate the names, shapes and types of a saved state.

    Args:
        saved: arrays of the saved state by name.
        expected: arrays of the same names, shapes and types; of "simulator" only the name counts.

    Raises:
        ValueError: a missing or unknown name, or an array of another shape or type.
    """
    mismatched = sorted(set(saved) ^ set(expected))
    if mismatched:
        raise ValueError(f"state: missing or unknown {mismatched}")
    for name, array in expected.items():
        found = saved[name]
        if name != "simulator" and (found.shape, found.dtype) != (array.shape, array.dtype):
            raise ValueError(
                f"state: expected {array.dtype} {array.shape} for {name!r}, "
                f"got {found.dtype} {found.shape}"
            )
