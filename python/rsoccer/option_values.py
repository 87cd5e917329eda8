"""Options of tasks as JSON values, for settings, policy files and replays.

A model of a field, a ball or a robot becomes an object with the name of its class and its numbers,
such as `{"RobotModel": {...}}`. Tuples become lists.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any, Final, TypeVar, cast

import numpy as np

from rsoccer._core import BallModel, Field, RobotModel, Sensing

Model = Field | BallModel | RobotModel | Sensing
SUFFIX: Final = ".json"
"""End of the names of files that hold a model."""
_PARTS: Final[dict[str, type[Model]]] = {
    "ball": BallModel,
    "field": Field,
    "robot": RobotModel,
    "sensing": Sensing,
}
"""Classes by the names of options, which are those of the parts of a file with several models."""
_MODELS: Final[dict[str, type[Model]]] = {
    "BallModel": BallModel,
    "Field": Field,
    "RobotModel": RobotModel,
    "Sensing": Sensing,
}


def is_file(value: object) -> bool:
    """Return whether an option names the file of a model.

    Args:
        value: value of the option.
    """
    return isinstance(value, str) and value.endswith(SUFFIX)


M = TypeVar("M", bound=Model)


def read_model(name: str, path: str, kind: type[M] | None = None) -> M:
    """Read the model in a file: JSON of `to_json`, or a preset with the numbers that differ.

    A file with several models has each as a part with the name of its option, such as `robot`.

    Args:
        name: name of the option, for the error.
        path: the file, such as one with `{"preset": "vss_440rpm", "mass": 0.21}`.
        kind: class of the model; None for any.

    Returns:
        The model.

    Raises:
        FileNotFoundError: no such file.
        ValueError: a file without such a model.
    """
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except FileNotFoundError:
        raise FileNotFoundError(f"{name}: the file {path} does not exist") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ValueError(f"{name}: cannot read {path}: {error}") from error
    refusals = []
    kinds = [kind] if kind is not None else _kinds(name)
    for each in kinds:
        try:
            return cast(M, each.from_json(text))
        except (TypeError, ValueError) as error:
            refusals.append(f"{each.__name__}: {error}")
    raise ValueError(f"{name}: {path} holds no model ({'; '.join(refusals)})")


def _kinds(name: str) -> list[type[Model]]:
    """Classes of models, that of an option of this name first: a file may hold several models."""
    own = _PARTS.get(name.rpartition(".")[2])
    return sorted(_MODELS.values(), key=lambda kind: kind is not own)


def encoded(name: str, value: object) -> Any:  # noqa: ANN401  (JSON)
    """Return a value of an option as a JSON value, with the content of files.

    Args:
        name: name of the option, for errors.
        value: its value.

    Raises:
        TypeError: an object of another kind, or a key that is not text.
        ValueError: a number that is not finite, or the file of a model that cannot be read.
    """
    if is_file(value):
        value = read_model(name, str(value), None)
    if isinstance(value, Model):
        return {type(value).__name__: json.loads(value.to_json())}
    if isinstance(value, tuple | list):
        return [encoded(name, part) for part in value]
    if isinstance(value, Mapping) and all(isinstance(key, str) for key in value):
        return {key: encoded(name, part) for key, part in value.items()}
    return _plain(name, value.item() if isinstance(value, np.generic) else value)


def _plain(name: str, value: object) -> Any:  # noqa: ANN401  (JSON)
    """A number, a text or None."""
    if value is not None and not isinstance(value, bool | int | float | str):
        expected = "a number, a text, a model, or a list or mapping of them"
        raise TypeError(f"{name}: expected {expected}, got {value!r}")
    if isinstance(value, float) and not math.isfinite(value):
        raise ValueError(f"{name}: expected a finite number, got {value}")
    return value


def decoded(name: str, value: Any) -> Any:  # noqa: ANN401  (JSON)
    """Return the value of an option from `encoded`; other values are returned as they are.

    Args:
        name: name of the option, for errors.
        value: its value.

    Raises:
        ValueError: a model that is damaged.
    """
    if isinstance(value, list):
        return [decoded(name, part) for part in value]
    if not isinstance(value, Mapping):
        return value
    if len(value) == 1 and (kind := next(iter(value))) in _MODELS:
        try:
            return _MODELS[kind].from_json(json.dumps(value[kind]))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{name}: {error}") from error
    return {key: decoded(name, part) for key, part in value.items()}
