"""Validation of options that tasks share: presets, robots, reward weights."""

import math
from collections.abc import Mapping
from numbers import Real

from rsoccer._core import RobotModel, SimConfig


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
