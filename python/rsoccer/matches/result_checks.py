"""Validation of the results of a task's methods, and of saved states."""

from collections.abc import Mapping

import numpy as np

from rsoccer import _core
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.checks import floats


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


def repositioned(moves: object, n: int) -> tuple[Mask, Floats]:
    """Validate the result of `Task.reposition_ball` other than None.

    Args:
        moves: (k,) worlds in any order, and (k, ball column) their balls.
        n: number of worlds.

    Returns:
        Mask (n,) of the worlds; and (k, ball column) their balls in the order of the mask.

    Raises:
        TypeError: not a pair, worlds that are not integers, or balls that are not floats.
        ValueError: a world out of range or given twice, or balls of another shape or not finite.
    """
    return _moves("reposition_ball", "balls", moves, n, len(_core.BALL_COLUMNS))


def restarted(moves: object, n: int, row_size: int) -> tuple[Mask, Floats]:
    """Validate the result of `Task.restart_play` other than None.

    Args:
        moves: (k,) worlds in any order, and (k, row) their states.
        n: number of worlds.
        row_size: number of columns of a row.

    Returns:
        Mask (n,) of the worlds; and (k, row) their states in the order of the mask.

    Raises:
        TypeError: not a pair, worlds that are not integers, or rows that are not floats.
        ValueError: a world out of range or given twice, or rows of another shape or not finite.
    """
    return _moves("restart_play", "rows", moves, n, row_size)


def _moves(method: str, content: str, moves: object, n: int, columns: int) -> tuple[Mask, Floats]:
    """Mask (n,) of worlds, and (k, columns) their numbers in the order of the mask, checked."""
    if not isinstance(moves, tuple) or len(moves) != 2:
        raise TypeError(f"{method}: expected worlds and {content}, or None, got {moves!r}")
    worlds = np.asarray(moves[0])
    if worlds.shape == (0,):
        worlds = worlds.astype(np.intp)  # an empty list becomes floats
    if worlds.ndim != 1 or worlds.dtype.kind not in "iu":
        raise TypeError(
            f"{method}: expected whole numbers (k,) for worlds, got {worlds.dtype} {worlds.shape}"
        )
    if len(worlds) and not (worlds.min() >= 0 and worlds.max() < n):
        raise ValueError(f"{method}: expected worlds 0 to {n - 1}, got {worlds.tolist()}")
    mask = np.zeros(n, np.bool_)
    mask[worlds] = True
    if np.count_nonzero(mask) != len(worlds):
        raise ValueError(f"{method}: expected each world once, got {worlds.tolist()}")
    shape = (len(worlds), columns)
    numbers = np.zeros(shape) if not len(worlds) and np.size(moves[1]) == 0 else moves[1]
    numbers = floats(f"{method}: {content}", numbers, shape)
    return mask, numbers[np.argsort(worlds)]


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
