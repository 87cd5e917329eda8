"""Models with numbers replaced, and as JSON that says which."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, TypeVar

from rsoccer._core import BallModel, RobotModel, Sensing

M = TypeVar("M", BallModel, RobotModel, Sensing)


def with_numbers(model: M, numbers: Mapping[str, float]) -> M:
    """Return a model with some numbers replaced.

    Args:
        model: the model.
        numbers: numbers by the names of its properties.

    Raises:
        ValueError: the model has no such number, or one is out of its range.
    """
    content = json.loads(model.to_json())
    left = dict(numbers)
    _replace(content, left)
    if left:
        raise ValueError(f"{model.name} has no {', '.join(left)}")
    return model.from_json(json.dumps(content))


def _replace(part: dict[str, Any], numbers: dict[str, float]) -> None:
    """Replace numbers in a part of a model, and drop those that were replaced."""
    for key, value in part.items():
        if isinstance(value, dict):
            _replace(value, numbers)
        elif key in numbers:
            part[key] = numbers.pop(key)


def as_json(model: M, numbers: Mapping[str, float]) -> dict[str, Any]:
    """Return a model with some numbers replaced as its files hold it.

    Args:
        model: the model before.
        numbers: numbers by the names of its properties.

    Returns:
        A preset's name with the numbers that differ, or all numbers of another model.

    Raises:
        ValueError: see `with_numbers`.
    """
    changed = with_numbers(model, numbers)
    if model.name in model.PRESETS and type(model)(model.name) == model:
        rounded = {name: float(f"{value:.6g}") for name, value in numbers.items()}
        return {"preset": model.name, **rounded}
    content: dict[str, Any] = json.loads(changed.to_json())
    return content
