"""Robots as the simulation protocol describes them."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any, Final

from rsoccer._core import MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_SPEED, RobotModel
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.schemas import simulation_pb2

_NUMBERS: Final = {
    "radius": "radius",
    "height": "height",
    "mass": "mass",
    "max_linear_kick_speed": "max_kick_speed",
    "max_chip_kick_speed": "max_chip_speed",
    "center_to_dribbler": "front_distance",
}
"""Numbers of a model by field of the message."""
_LIMITS: Final = {
    "vel_absolute_max": "max_speed",
    "vel_angular_max": "max_angular_velocity",
    "acc_speedup_absolute_max": "max_acceleration",
    "acc_speedup_angular_max": "max_angular_acceleration",
    "acc_brake_absolute_max": "max_deceleration",
    "acc_brake_angular_max": "max_angular_deceleration",
}
"""The same of its limits."""
_RANGES: Final = {
    "radius": (0.05, 0.09),
    "height": (0.05, 0.15),
    "mass": (0.1, 10.0),
    "max_linear_kick_speed": (0.0, MAX_PLACED_SPEED),
    "max_chip_kick_speed": (0.0, MAX_PLACED_SPEED),
    "vel_absolute_max": (0.0, MAX_PLACED_SPEED),
    "vel_angular_max": (0.0, MAX_PLACED_ANGULAR_VELOCITY),
}
"""Least and greatest numbers of a robot by field of the message.

The greatest size is that of the league's rules; the least one has room for a mouth and is higher
than the ball. A robot that pushes two of 2.7 kg against the wall overlaps them by 1.3 mm with a
mass of 10 kg, by 16 mm with 100 kg, and passes through them with 1000 kg. Speeds are those with
which bodies can be placed.
"""
_ROUNDING: Final = 1e-6
"""Share by which single precision may exceed the ends of a range: .09 on the wire is above it."""


def to_robot_model(model: RobotModel, specs: simulation_pb2.RobotSpecs) -> RobotModel:
    """Return a robot with the numbers of a message.

    Args:
        model: the robot as it is, which has what the message lacks.
        specs: the message. Angles of wheels are clockwise from the front, rad.

    Returns:
        The new model.

    Raises:
        MessageError: numbers that no robot of this kind can have.
    """
    numbers: dict[str, float | list[float]] = {}
    for part, names in ((specs, _NUMBERS), (specs.limits, _LIMITS)):
        given = {field.name for field, _ in part.ListFields()} & set(names)
        for name in sorted(given):
            _check_range(name, getattr(part, name))
        numbers |= {names[name]: getattr(part, name) for name in given}
    if specs.HasField("wheel_angles"):
        wheels = specs.wheel_angles
        clockwise = (wheels.front_left, wheels.back_left, wheels.back_right, wheels.front_right)
        numbers["wheel_angles"] = [-math.degrees(angle) % 360.0 for angle in clockwise]
    data = json.loads(model.to_json())
    missing = set(numbers) - _replace(data, numbers)
    if missing:
        text = f"robot_specs: expected a robot that has {', '.join(sorted(missing))}"
        raise MessageError(Code.INVALID_SPEC, f"{text}, got {model.name}")
    try:
        return RobotModel.from_json(json.dumps(data))
    except (ValueError, OverflowError) as error:
        raise MessageError(Code.INVALID_SPEC, f"robot_specs: {error}") from None


def _check_range(name: str, value: float) -> None:
    """Refuse a number that no robot of the league has, or with which contacts are not exact."""
    low, high = _RANGES.get(name, (-math.inf, math.inf))
    if not low * (1 - _ROUNDING) <= value <= high * (1 + _ROUNDING):
        raise MessageError(
            Code.INVALID_SPEC, f"robot_specs.{name}: expected {low:g} to {high:g}, got {value:g}"
        )


def _replace(data: dict[str, Any], numbers: Mapping[str, float | list[float]]) -> set[str]:
    """Replace numbers of a model, at any depth, and return the names of those that it has."""
    found = set()
    for key, value in data.items():
        if isinstance(value, dict):
            found |= _replace(value, numbers)
        elif key in numbers:
            data[key] = numbers[key]
            found.add(key)
    return found


def to_robot_specs(
    model: RobotModel, identity: simulation_pb2.RobotId
) -> simulation_pb2.RobotSpecs:
    """Return the description of a round robot.

    Args:
        model: the robot.
        identity: its team and uniform number.
    """
    specs = simulation_pb2.RobotSpecs(id=identity)
    for name, number in _NUMBERS.items():
        setattr(specs, name, getattr(model, number))
    for name, number in _LIMITS.items():
        setattr(specs.limits, name, getattr(model, number))
    angles = [math.radians(360.0 - angle) for angle in model.wheel_angles]
    wheels = specs.wheel_angles
    wheels.front_left, wheels.back_left, wheels.back_right, wheels.front_right = angles
    return specs
