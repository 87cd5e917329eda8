"""Validation of options that tasks share: models, policies, reward weights."""

import os
from collections.abc import Mapping
from numbers import Real
from typing import Any, TypeVar

import numpy as np

from rsoccer import checks, option_values
from rsoccer._core import BallModel, Field, RobotModel, SimConfig
from rsoccer.task import Task

M = TypeVar("M", Field, BallModel, RobotModel)


def model(name: str, value: object, kind: type[M]) -> str | M:
    """Validate a preset's name, with or without numbers that differ, a file or a model.

    Args:
        name: name of the argument, for the error.
        value: the argument.
        kind: class of the model, such as `RobotModel`.

    Returns:
        The preset's name, the model, or the model that the file or the text with numbers holds.

    Raises:
        FileNotFoundError: no such file.
        TypeError: neither text nor a `kind`.
        ValueError: an unknown preset or number, or a file without such a model.
    """
    if isinstance(value, kind):
        return value
    text = _path_as_text(value)
    if not isinstance(text, str):
        raise TypeError(
            f"{name}: expected a preset's name, the path of a {option_values.SUFFIX} file or a "
            f"{kind.__name__}, got {value!r}"
        )
    if option_values.is_file(text):
        return option_values.read_model(name, text, kind)
    if "=" in text:
        try:
            return kind(text)
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from error
    if text not in kind.PRESETS:
        raise ValueError(
            f"{name}: expected one of {list(kind.PRESETS)}, or the path of a "
            f"{option_values.SUFFIX} file, got {text!r}"
        )
    return text


def robot_models(value: object) -> Any:  # noqa: ANN401  (of the option's types)
    """Validate the option `robot`.

    Args:
        value: one robot model, preset's name or file for all robots, or a list with one for each.

    Returns:
        The value, with the models of files in place of their paths.

    Raises:
        FileNotFoundError: no such file.
        TypeError: an entry is neither text nor a `RobotModel`.
        ValueError: an unknown preset, or a file without such a model.
    """
    if isinstance(value, list | tuple):
        return [model("robot", entry, RobotModel) for entry in value]
    return model("robot", value, RobotModel)


def set_policies(task: Task, *names: str) -> None:
    """Validate the type of options that name policies, and set them to text.

    Matches refuse an unknown policy.

    Args:
        task: the task.
        *names: names of the options.

    Raises:
        TypeError: neither text nor a path.
    """
    for name in names:
        object.__setattr__(task, name, _policy(name, getattr(task, name)))


def _policy(name: str, value: object) -> str:
    """A policy's name, or the path of its file as text."""
    text = _path_as_text(value)
    if not isinstance(text, str):
        raise TypeError(
            f"{name}: expected a policy's name or the path of its file, got {value!r}; "
            "a Policy object is given as controllers={'yellow': policy}"
        )
    return text


def plain(value: object) -> Any:  # noqa: ANN401  (of the option's types)
    """Return the value of an option with Python's numbers in place of NumPy's.

    Equal options are then equal in files and in hashes, too.

    Args:
        value: the value; lists, tuples and mappings are searched and copied.
    """
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, list):
        return [plain(part) for part in value]
    if isinstance(value, tuple):
        return tuple(plain(part) for part in value)
    if isinstance(value, Mapping):
        return {name: plain(part) for name, part in value.items()}
    return value


def _path_as_text(value: object) -> object:
    """A path as text; any other value as it is."""
    return os.fspath(value) if isinstance(value, os.PathLike) else value


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
        if not abs(checks.number("reward_weights", weight)) <= np.finfo(np.float32).max:
            raise ValueError(f"reward_weights: expected a finite number for {name!r}, got {weight}")
    return {**default, **value}
