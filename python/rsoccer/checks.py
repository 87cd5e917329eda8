"""Checks of what comes from outside: each raises before anything has changed."""

import math
from collections.abc import Mapping
from numbers import Real

import numpy as np

from rsoccer import _core
from rsoccer._core import RobotModel, SimConfig
from rsoccer.frame import Array, Floats, Mask


def whole(name: str, value: object, least: int) -> int:
    """An integer, at least `least`."""
    if isinstance(value, bool) or not isinstance(value, int | np.integer):
        raise TypeError(f"{name}: expected a whole number, got {value!r}")
    if value < least:
        raise ValueError(f"{name}: expected at least {least}, got {value}")
    return int(value)


def within(name: str, value: object, least: int, most: int) -> int:
    """An integer from `least` to `most`."""
    if (number := whole(name, value, least)) > most:
        raise ValueError(f"{name}: expected at most {most}, got {number}")
    return number


def number(name: str, value: object, least: float, most: float) -> float:
    """A finite number from `least` to `most`."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise TypeError(f"{name}: expected a number, got {value!r}")
    if not least <= float(value) <= most:  # nor is NaN
        raise ValueError(f"{name}: expected {least:g} to {most:g}, got {value}")
    return float(value)


def flag(name: str, value: object) -> bool:
    """True or False, and nothing else that counts as either."""
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name}: expected True or False, got {value!r}")
    return bool(value)


def preset(name: str, value: object, kind: type) -> None:
    """A preset's name or what it stands for; the simulator says which names there are."""
    if not isinstance(value, str | kind):
        raise TypeError(f"{name}: expected a preset's name or a {kind.__name__}, got {value!r}")


def robots(value: object) -> None:
    """A robot of a preset or by numbers, or a list of them; None is the simulator's own."""
    each = value if isinstance(value, list | tuple) else [] if value is None else [value]
    for robot in each:
        preset("robot", robot, RobotModel)


def drive(config: SimConfig, kind: str, needed: str) -> None:
    """Robots of one model that has a drive of this kind; `needed` says it in words."""
    names = sorted({robot.name for robot in config.robots})
    if len(names) > 1:
        raise ValueError(f"robot: expected one model for all, got {names}")
    if config.robot.drive != kind:
        raise ValueError(f"robot: expected one {needed}, got {names[0]!r}")


def seeds(value: object, n: int) -> list[int | None] | None:
    """A seed for each of n worlds, None where its streams shall go on; None if all shall.

    A whole number is the first world's seed and the others' count up from it.
    """
    if value is None:
        return None
    if not isinstance(value, list | tuple | np.ndarray):
        first = whole("seed", value, 0)
        return list(range(first, first + n))
    if len(value) != n:
        raise ValueError(f"seed: expected a number or {n} of them, got {len(value)}")
    return [None if seed is None else whole("seed", seed, 0) for seed in value]


def floats(name: str, value: object, shape: tuple[int, ...]) -> Floats:
    """A finite, C-contiguous float32 array of this shape; other floating types are cast."""
    array = np.asarray(value)
    if array.dtype.kind != "f":
        raise TypeError(f"{name}: expected float32, got {array.dtype}")
    if array.shape != shape:
        raise ValueError(f"{name}: expected shape {shape}, got {array.shape}")
    if not np.isfinite(array).all():
        where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise ValueError(f"{name}: expected finite numbers, got {array[where]} at {where}")
    return np.ascontiguousarray(array, np.float32)


def actions(value: object, shape: tuple[int, ...]) -> Floats:
    """Actions (n, agents, action), clipped to [-1, 1]."""
    if (clipped := _core.clipped(value, shape)) is not None:
        return clipped
    array = np.asarray(value)
    if array.dtype == np.float64:  # before the cast, which would turn the largest to infinity
        array = np.where(np.isfinite(array), np.clip(array, -1.0, 1.0), array)
    return np.minimum(np.maximum(floats("actions", array, shape), -1.0), 1.0)


def mask(value: object, n: int) -> Mask:
    """A bool (n,); None is all."""
    if value is None:
        return np.ones(n, np.bool_)
    array = np.asarray(value)
    if array.dtype != np.bool_ or array.shape != (n,):
        raise ValueError(f"mask: expected bool ({n},), got {array.dtype} {array.shape}")
    return array


def memory(source: str, arrays: dict[str, Array], n: int) -> dict[str, Array]:
    """Copies of arrays that are kept per world, each (n, ...)."""
    for name, array in arrays.items():
        if np.shape(array)[:1] != (n,):
            raise ValueError(
                f"{source}: expected ({n}, ...) for {name!r}, got {np.shape(array)}: "
                "the first axis is worlds"
            )
    return {name: np.array(array) for name, array in arrays.items()}


def commands(value: Array, shape: tuple[int, ...]) -> Floats:
    """What a task tells the robots (n, robots, command); the simulator checks the numbers."""
    if value.shape != shape:
        raise ValueError(f"get_commands: expected shape {shape}, got {value.shape}")
    return np.array(value, np.float32, order="C")  # a copy: it is kept, and cleared at restarts


def repositioned(found: object, n: int) -> tuple[Mask, Floats]:
    """Of n worlds those whose balls a task moves, as a mask (n,), and their balls (k, columns).

    The task may name worlds in any order; the balls are in that of the mask.
    """
    if not isinstance(found, tuple) or len(found) != 2:
        raise TypeError(f"reposition_ball: expected worlds and balls, or None, got {found!r}")
    worlds = np.asarray(found[0])
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
    balls = np.zeros(shape) if not len(worlds) and np.size(found[1]) == 0 else found[1]
    balls = floats("reposition_ball: balls", balls, shape)
    return mask, balls[np.argsort(worlds)]


def reward_weights(
    given: object, default: Mapping[str, float], paper: Mapping[str, float]
) -> dict[str, float]:
    """The default weights with those given in their place, or the paper's."""
    if isinstance(given, str):
        if given != "paper":
            raise ValueError(f"reward_weights: expected a mapping or 'paper', got {given!r}")
        given = paper
    if not isinstance(given, Mapping):
        raise TypeError(f"reward_weights: expected a mapping or 'paper', got {given!r}")
    unknown = sorted(set(given) - set(default), key=str)
    if unknown:
        raise ValueError(f"reward_weights: unknown {unknown}; valid are {list(default)}")
    for name, weight in given.items():
        if isinstance(weight, bool) or not isinstance(weight, Real):
            raise TypeError(f"reward_weights: expected a number for {name!r}, got {weight!r}")
        if not math.isfinite(weight):
            raise ValueError(f"reward_weights: expected a finite number for {name!r}, got {weight}")
    return {**default, **given}


def term(name: str, value: Floats, shape: tuple[int, int]) -> Floats:
    """A term of the reward, given as (n, observers) or (n, 1)."""
    if value.shape not in (shape, (shape[0], 1)):
        raise ValueError(
            f"calculate_reward_and_done: expected {shape} or {(shape[0], 1)} for {name!r}, "
            f"got {value.shape}"
        )
    term = np.asarray(value, np.float32)
    return term if term.shape == shape else np.broadcast_to(term, shape)


def done(value: Mask, n: int) -> Mask:
    """Whether the task ended each episode, (n,)."""
    if value.shape != (n,) or value.dtype != np.bool_:
        raise ValueError(
            f"calculate_reward_and_done: expected bool ({n},) for the end of episodes, "
            f"got {value.dtype} {value.shape}"
        )
    return value


def state(given: Mapping[str, Array], expected: Mapping[str, Array]) -> None:
    """A saved state with the same names, shapes and types."""
    odd = sorted(set(given) ^ set(expected))
    if odd:
        raise ValueError(f"state: missing or unknown {odd}")
    for name, array in expected.items():
        got = given[name]
        if name != "simulator" and (got.shape, got.dtype) != (array.shape, array.dtype):
            raise ValueError(
                f"state: expected {array.dtype} {array.shape} for {name!r}, "
                f"got {got.dtype} {got.shape}"
            )
