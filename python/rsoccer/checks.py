"""Validation of arguments: each function raises an error that names the argument.

Validation happens before any state changes.
"""

import math
from collections.abc import Mapping
from numbers import Real

import numpy as np

from rsoccer import _core
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame


def integer(name: str, value: object, low: int) -> int:
    """Validate an integer of at least `low`.

    Args:
        name: name of the argument, for the error.
        value: the argument.
        low: least valid value.

    Returns:
        The value as an int.

    Raises:
        TypeError: not an integer; bools are refused too.
        ValueError: below `low`.
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name}: expected a whole number, got {value!r}")
    if value < low:
        raise ValueError(f"{name}: expected at least {low}, got {value}")
    return int(value)


def integer_in_range(name: str, value: object, low: int, high: int) -> int:
    """Validate an integer from `low` to `high`, both included.

    Args:
        name: name of the argument, for the error.
        value: the argument.
        low: least valid value.
        high: greatest valid value.

    Returns:
        The value as an int.

    Raises:
        TypeError: not an integer; bools are refused too.
        ValueError: outside the range.
    """
    if (number := integer(name, value, low)) > high:
        raise ValueError(f"{name}: expected at most {high}, got {number}")
    return number


def number(name: str, value: object) -> float:
    """Validate a number, which may be infinite or NaN.

    Args:
        name: name of the argument, for the error.
        value: the argument.

    Returns:
        The value as a float; infinity for one beyond the range of floats.

    Raises:
        TypeError: not a number; bools are refused too.
    """
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name}: expected a number, got {value!r}")
    try:
        return float(value)
    except OverflowError:
        return -math.inf if value < 0 else math.inf


def number_in_range(name: str, value: object, low: float, high: float) -> float:
    """Validate a finite number from `low` to `high`, both included.

    Args:
        name: name of the argument, for the error.
        value: the argument.
        low: least valid value.
        high: greatest valid value.

    Returns:
        The value as a float.

    Raises:
        TypeError: not a number; bools are refused too.
        ValueError: outside the range, or NaN.
    """
    real = number(name, value)
    if not low <= real <= high:  # refuses NaN too
        raise ValueError(f"{name}: expected {low:g} to {high:g}, got {value}")
    return real


def positive_number(name: str, value: object) -> float:
    """Validate a finite number above 0.

    Args:
        name: name of the argument, for the error.
        value: the argument.

    Returns:
        The value as a float.

    Raises:
        TypeError: not a number; bools are refused too.
        ValueError: 0 or less, infinite, or NaN.
    """
    real = number(name, value)
    if not 0.0 < real < math.inf:
        raise ValueError(f"{name}: expected a positive number, got {value}")
    return real


def boolean(name: str, value: object) -> bool:
    """Validate True or False; other values with a truth value are refused.

    Args:
        name: name of the argument, for the error.
        value: the argument.

    Returns:
        The value as a bool.

    Raises:
        TypeError: neither True nor False.
    """
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name}: expected True or False, got {value!r}")
    return bool(value)


def seeds(value: object, n: int) -> list[int | None] | None:
    """Validate the seeds of n worlds.

    Args:
        value: the seed of the first world, from which those of the others count up; or a sequence
            of n seeds, of which None lets the random streams of its world continue; or None for
            all worlds.
        n: number of worlds.

    Returns:
        A seed or None for each world, or None for all.

    Raises:
        TypeError: a seed that is not an integer.
        ValueError: a negative seed, or a sequence of another length.
    """
    if value is None:
        return None
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if not isinstance(value, list | tuple | np.ndarray):
        first = integer("seed", value, 0)
        return list(range(first, first + n))
    if len(value) != n:
        raise ValueError(f"seed: expected a number or {n} of them, got {len(value)}")
    return [None if seed is None else integer("seed", seed, 0) for seed in value]


def floats(name: str, value: object, shape: tuple[int, ...]) -> Floats:
    """Validate an array of finite floating-point numbers.

    Args:
        name: name of the argument, for the error.
        value: the argument; other floating-point types are cast to float32.
        shape: required shape.

    Returns:
        A C-contiguous float32 array, the argument itself where it is one.

    Raises:
        TypeError: not an array of a floating-point type.
        ValueError: another shape, rows of different lengths, NaN or infinity.
    """
    array = as_array(name, value)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: expected a floating-point array, got {_kind(array)}")
    if array.shape != shape:
        raise ValueError(f"{name}: expected shape {shape}, got {array.shape}")
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{name}: expected finite numbers, got {array[index]} at {index}")
    return np.ascontiguousarray(array, np.float32)


def as_array(name: str, value: object) -> Array:
    """Return an array of any type and shape.

    Args:
        name: name of the argument, for the error.
        value: the argument.

    Raises:
        ValueError: lists whose parts differ in length.
    """
    try:
        return np.asarray(value)
    except ValueError:
        got = f"a {type(value).__name__} whose parts differ in length"
        raise ValueError(f"{name}: expected an array, got {got}") from None


def _kind(array: Array) -> str:
    """Type of the numbers of an array, or of the objects in it."""
    return type(array.flat[0]).__name__ if array.dtype.kind == "O" else str(array.dtype)


def actions(value: object, shape: tuple[int, ...], name: str = "actions") -> Floats:
    """Validate actions and clip them to [-1, 1].

    Args:
        value: the argument.
        shape: required shape (n, agents, action).
        name: name of the argument, for the error.

    Returns:
        Clipped float32 array.

    Raises:
        TypeError: not an array of a floating-point type.
        ValueError: another shape, rows of different lengths, NaN or infinity.
    """
    if (clipped := _core.clip_actions(value, shape)) is not None:
        return clipped
    array = as_array(name, value)
    if array.dtype == np.float64:  # before the cast, which would turn the largest to infinity
        array = np.where(np.isfinite(array), np.clip(array, -1.0, 1.0), array)
    return np.minimum(np.maximum(floats(name, array, shape), -1.0), 1.0)


def team_names(value: object) -> tuple[str, str]:
    """Return the names of blue and of yellow.

    Args:
        value: the argument `names`.

    Raises:
        TypeError: not a list or tuple of texts.
        ValueError: more or fewer than two.
    """
    if not isinstance(value, list | tuple) or not all(isinstance(name, str) for name in value):
        raise TypeError(f"names: expected the names of blue and of yellow, got {value!r}")
    if len(value) != 2:
        raise ValueError(f"names: expected two, got {value!r}")
    blue, yellow = value
    return blue, yellow


def mask(value: object, n: int) -> Mask:
    """Validate a mask of worlds.

    Args:
        value: the argument; None selects all worlds.
        n: number of worlds.

    Returns:
        (n,) bool.

    Raises:
        ValueError: another shape or type.
    """
    if value is None:
        return np.ones(n, np.bool_)
    array = np.asarray(value)
    if array.dtype != np.bool_ or array.shape != (n,):
        raise ValueError(f"mask: expected bool ({n},), got {array.dtype} {array.shape}")
    return array


def rows(source: str, frame: Frame) -> None:
    """Validate the state rows that a simulator or a sensor model wrote.

    Args:
        source: name of the method that wrote them, for the error.
        frame: the rows, n worlds.

    Raises:
        ValueError: a number that is not finite, or a robot or a line that does not exist.
    """
    finite = np.isfinite(frame.rows).all(axis=1)
    if not finite.all():
        worlds = np.flatnonzero(~finite).tolist()
        raise ValueError(f"{source}: expected finite numbers, got others in worlds {worlds}")
    robots = frame.n_blue + frame.n_yellow
    for name, values, low, high in (
        ("last_touch", frame.ball.last_touch, -1, robots - 1),
        ("crossed", frame.ball.crossed, 0, len(_core.CROSSINGS) - 1),
        ("absent", frame.robots.absent, 0, 1),
    ):
        valid = (values >= low) & (values <= high) & (values == np.round(values))
        if not valid.all():
            got = float(values[~valid].flat[0])
            raise ValueError(
                f"{source}: expected whole numbers from {low} to {high} for {name!r}, got {got:g}"
            )


def memory(source: str, arrays: dict[str, Array], n: int) -> dict[str, Array]:
    """Validate arrays that are kept per world.

    Args:
        source: name of the method that returned them, for the error.
        arrays: arrays by name.
        n: number of worlds.

    Returns:
        Copies by name, each (n, ...).

    Raises:
        TypeError: no mapping.
        ValueError: the first axis of an array is not n.
    """
    if not isinstance(arrays, Mapping):
        raise TypeError(f"{source}: expected arrays by name, got {arrays!r}")
    for name, array in arrays.items():
        if np.shape(array)[:1] != (n,):
            raise ValueError(
                f"{source}: expected ({n}, ...) for {name!r}, got {np.shape(array)}: "
                "the first axis is worlds"
            )
    return {name: np.array(array) for name, array in arrays.items()}
