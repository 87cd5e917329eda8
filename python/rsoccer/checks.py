"""Validation of arguments: each function raises an error that names the argument.

Validation happens before any state changes.
"""

import math
from collections.abc import Mapping
from numbers import Real

import numpy as np

from rsoccer import _core
from rsoccer._core import RobotModel, SimConfig
from rsoccer.frame import Array, Floats, Mask


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
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name}: expected a number, got {value!r}")
    if not low <= float(value) <= high:  # refuses NaN too
        raise ValueError(f"{name}: expected {low:g} to {high:g}, got {value}")
    return float(value)


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


def preset(name: str, value: object, kind: type) -> None:
    """Validate the type of a preset's name or of a model; the simulator validates the name.

    Args:
        name: name of the argument, for the error.
        value: the argument.
        kind: class of the model, such as `RobotModel`.

    Raises:
        TypeError: neither text nor a `kind`.
    """
    if not isinstance(value, str | kind):
        raise TypeError(f"{name}: expected a preset's name or a {kind.__name__}, got {value!r}")


def robot_models(value: object) -> None:
    """Validate the types of the option `robot`.

    Args:
        value: one robot model or preset's name for all robots, or a list with one for each; None
            for the simulator's default.

    Raises:
        TypeError: an entry is neither text nor a `RobotModel`.
    """
    models = value if isinstance(value, list | tuple) else [] if value is None else [value]
    for model in models:
        preset("robot", model, RobotModel)


def drive(config: SimConfig, kind: str, description: str) -> None:
    """Validate that all robots are of one model with a kind of drive.

    Args:
        config: configuration with the robots.
        kind: "differential" or "omni".
        description: the required drive in words, for the error.

    Raises:
        ValueError: robots of different models, or of another drive.
    """
    names = sorted({robot.name for robot in config.robots})
    if len(names) > 1:
        raise ValueError(f"robot: expected one model for all, got {names}")
    if config.robot.drive != kind:
        raise ValueError(f"robot: expected one {description}, got {names[0]!r}")


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
        ValueError: another shape, NaN or infinity.
    """
    array = np.asarray(value)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: expected float32, got {array.dtype}")
    if array.shape != shape:
        raise ValueError(f"{name}: expected shape {shape}, got {array.shape}")
    if not np.isfinite(array).all():
        index = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{name}: expected finite numbers, got {array[index]} at {index}")
    return np.ascontiguousarray(array, np.float32)


def actions(value: object, shape: tuple[int, ...]) -> Floats:
    """Validate actions and clip them to [-1, 1].

    Args:
        value: the argument.
        shape: required shape (n, agents, action).

    Returns:
        Clipped float32 array.

    Raises:
        TypeError: not an array of a floating-point type.
        ValueError: another shape, NaN or infinity.
    """
    if (clipped := _core.clip_actions(value, shape)) is not None:
        return clipped
    array = np.asarray(value)
    if array.dtype == np.float64:  # before the cast, which would turn the largest to infinity
        array = np.where(np.isfinite(array), np.clip(array, -1.0, 1.0), array)
    return np.minimum(np.maximum(floats("actions", array, shape), -1.0), 1.0)


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


def memory(source: str, arrays: dict[str, Array], n: int) -> dict[str, Array]:
    """Validate arrays that are kept per world.

    Args:
        source: name of the method that returned them, for the error.
        arrays: arrays by name.
        n: number of worlds.

    Returns:
        Copies by name, each (n, ...).

    Raises:
        ValueError: the first axis of an array is not n.
    """
    for name, array in arrays.items():
        if np.shape(array)[:1] != (n,):
            raise ValueError(
                f"{source}: expected ({n}, ...) for {name!r}, got {np.shape(array)}: "
                "the first axis is worlds"
            )
    return {name: np.array(array) for name, array in arrays.items()}


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
    if not isinstance(moves, tuple) or len(moves) != 2:
        raise TypeError(f"reposition_ball: expected worlds and balls, or None, got {moves!r}")
    worlds = np.asarray(moves[0])
    if worlds.shape == (0,):
        worlds = worlds.astype(np.intp)  # an empty list becomes floats
    if worlds.ndim != 1 or worlds.dtype.kind not in "iu":
        raise TypeError(
            f"reposition_ball: expected whole numbers (k,) for worlds, got {worlds.dtype} "
            f"{worlds.shape}"
        )
    if len(worlds) and not (worlds.min() >= 0 and worlds.max() < n):
        raise ValueError(f"reposition_ball: expected worlds 0 to {n - 1}, got {worlds.tolist()}")
    mask = np.zeros(n, np.bool_)
    mask[worlds] = True
    if np.count_nonzero(mask) != len(worlds):
        raise ValueError(f"reposition_ball: expected each world once, got {worlds.tolist()}")
    shape = (len(worlds), len(_core.BALL_COLUMNS))
    balls = np.zeros(shape) if not len(worlds) and np.size(moves[1]) == 0 else moves[1]
    balls = floats("reposition_ball: balls", balls, shape)
    return mask, balls[np.argsort(worlds)]


def reward_weights(
    value: object, default: Mapping[str, float], paper: Mapping[str, float]
) -> dict[str, float]:
    """Validate the option `reward_weights`.

    Args:
        value: weights by name that replace default ones, or "paper".
        default: default weight of each reward term.
        paper: weights of the preset "paper".

    Returns:
        Weight of each reward term by name.

    Raises:
        TypeError: neither a mapping nor "paper", or a weight that is not a number.
        ValueError: other text, an unknown term, or a weight that is not finite.
    """
    if isinstance(value, str):
        if value != "paper":
            raise ValueError(f"reward_weights: expected a mapping or 'paper', got {value!r}")
        value = paper
    if not isinstance(value, Mapping):
        raise TypeError(f"reward_weights: expected a mapping or 'paper', got {value!r}")
    unknown = sorted(set(value) - set(default), key=str)
    if unknown:
        raise ValueError(f"reward_weights: unknown {unknown}; valid are {list(default)}")
    for name, weight in value.items():
        if isinstance(weight, bool) or not isinstance(weight, Real):
            raise TypeError(f"reward_weights: expected a number for {name!r}, got {weight!r}")
        if not math.isfinite(weight):
            raise ValueError(f"reward_weights: expected a finite number for {name!r}, got {weight}")
    return {**default, **value}


def term(name: str, value: Floats, shape: tuple[int, int]) -> Floats:
    """Validate a reward term and broadcast it to all observers.

    Args:
        name: name of the term, for the error.
        value: (n, observers) or (n, 1).
        shape: (n, observers).

    Returns:
        (n, observers) float32, perhaps a read-only view.

    Raises:
        ValueError: another shape.
    """
    if value.shape not in (shape, (shape[0], 1)):
        raise ValueError(
            f"calculate_reward_and_done: expected {shape} or {(shape[0], 1)} for {name!r}, "
            f"got {value.shape}"
        )
    term = np.asarray(value, np.float32)
    return term if term.shape == shape else np.broadcast_to(term, shape)


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
