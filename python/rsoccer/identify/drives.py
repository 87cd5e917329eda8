"""Parameters of the two kinds of drive: their robot models, and the commands that they obey."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles
from rsoccer.identify.replaced import with_numbers

LATENCY: Final = "latency"
"""Name of the time from a command to the pose that shows it."""
_MARGIN: Final = 1.02  # of limits of a model beyond those that were fitted


@dataclass(frozen=True)
class Parameter:
    """A number to be identified."""

    name: str
    """Name, such as "latency"."""
    unit: str
    """Unit, such as "m/s"."""
    step: float
    """Change over which slopes are measured; of the logarithm for limits."""
    tolerance: float
    """Greatest standard error with which it counts as identified, as `step`."""
    is_limit: bool = False
    """Whether it is positive, and fitted by its logarithm."""
    is_shown: bool = True
    """Whether it is reported: couplings of an inexact robot are not."""
    excited_by: str = ""
    """Commands that would show it."""


class Drive(ABC):
    """A kind of drive: parameters, and the simulated robot that has them."""

    parameters: tuple[Parameter, ...]
    """Its parameters; the first is the latency."""

    def __init__(self, base: RobotModel) -> None:
        """Describe robots by the numbers of a model that stand in where nothing is identified.

        Args:
            base: the model.
        """
        self.base = base

    @property
    def names(self) -> list[str]:
        """Names of the parameters."""
        return [parameter.name for parameter in self.parameters]

    def values(self, encoded: Doubles) -> dict[str, float]:
        """Return parameters by name.

        Args:
            encoded: (p,) parameters as they are fitted.
        """
        pairs = zip(self.parameters, encoded.tolist(), strict=True)
        return {each.name: float(np.exp(x)) if each.is_limit else x for each, x in pairs}

    def encoded(self, values: Mapping[str, float]) -> Doubles:
        """Return parameters as they are fitted.

        Args:
            values: their values by name.
        """
        numbers = [(each, values[each.name]) for each in self.parameters]
        return np.array([np.log(value) if each.is_limit else value for each, value in numbers])

    @abstractmethod
    def start(self, observed: Mapping[str, float]) -> dict[str, float]:
        """Return parameters to start from.

        Args:
            observed: the robot's greatest `speed` (m/s) and `angular_velocity` (rad/s).
        """

    def model(self, values: Mapping[str, float]) -> RobotModel:
        """Return the robot with some parameters.

        Args:
            values: parameters by name; those that are missing are those of the base.
        """
        return with_numbers(self.base, self.numbers(values))

    @abstractmethod
    def numbers(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return the numbers of the base that some parameters replace.

        Args:
            values: parameters by name.
        """

    @abstractmethod
    def obeyed(self, values: Mapping[str, float], commands: Doubles) -> Doubles:
        """Return the commands that the model gets.

        Args:
            values: parameters by name.
            commands: (..., columns) commands of the log.
        """

    @abstractmethod
    def tops(self) -> tuple[str, ...]:
        """Return the names of the top speeds, which gains alone explain where nothing is faster."""

    @abstractmethod
    def demanded(self, values: Mapping[str, float], commands: Doubles) -> list[Doubles]:
        """Return the speeds that each top speed limits, as they would be without it.

        Args:
            values: parameters by name.
            commands: (..., columns) commands of the log.
        """

    @abstractmethod
    def accelerations(self) -> tuple[str, ...]:
        """Return the names of the limits whose scale is searched first."""


def drive_of(base: RobotModel) -> Drive:
    """Return the drive of a robot.

    Args:
        base: the robot.
    """
    return OmniDrive(base) if base.drive == "omni" else WheelDrive(base)


_AXES: Final = ("forward", "sideways", "turning")
_COUPLINGS: Final = [(to, by) for to in range(3) for by in range(3) if to != by]


class OmniDrive(Drive):
    """Robots commanded by velocities: a matrix of gains, and limits of the body."""

    parameters = (
        Parameter(LATENCY, "s", 0.0005, 0.01, excited_by="commands that change"),
        *(
            Parameter(f"gain_{axis}", "1", 0.003, 0.05, excited_by=f"commands {axis}")
            for axis in _AXES
        ),
        *(
            Parameter(f"coupling_{_AXES[to]}_{_AXES[by]}", "", 0.003, 0.5, is_shown=False)
            for to, by in _COUPLINGS
        ),
        *(
            Parameter(name, unit, 0.01, 0.12, is_limit=True, excited_by=excited)
            for name, unit, excited in (
                ("max_acceleration", "m/s²", "steps to faster velocities"),
                ("max_deceleration", "m/s²", "steps to slower velocities"),
                ("max_angular_acceleration", "rad/s²", "steps to faster turns"),
                ("max_angular_deceleration", "rad/s²", "steps to slower turns"),
                ("max_speed", "m/s", "speeds beyond the top speed"),
                ("max_angular_velocity", "rad/s", "turns beyond the top angular velocity"),
            )
        ),
    )

    def start(self, observed: Mapping[str, float]) -> dict[str, float]:
        """Return the base's limits and gains of 1; see `Drive.start`."""
        values = {each.name: 0.0 for each in self.parameters}
        values |= {f"gain_{axis}": 1.0 for axis in _AXES}
        values |= {each.name: getattr(self.base, each.name) for each in self.parameters[10:]}
        values["max_speed"] = max(observed["speed"], 0.05)
        values["max_angular_velocity"] = max(observed["angular_velocity"], 0.2)
        return values

    def numbers(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return limits, and those that would be in their way; see `Drive.numbers`."""
        limits = [each.name for each in self.parameters if each.is_limit]
        numbers = {name: values[name] for name in limits if name in values}
        base = self.base
        fastest = max(numbers.get(name, getattr(base, name)) for name in limits[:2])
        if fastest * _MARGIN > base.max_traction:
            numbers["max_traction"] = fastest * _MARGIN
        faster = max(
            numbers.get(name, getattr(base, name)) / getattr(base, name) for name in limits[-2:]
        )
        if faster > 1.0:  # else the wheels would limit it
            numbers["max_wheel_speed"] = base.max_wheel_speed * faster * _MARGIN
        return numbers

    def obeyed(self, values: Mapping[str, float], commands: Doubles) -> Doubles:
        """Return commands times the matrix of gains; see `Drive.obeyed`."""
        gains = np.diag([values[f"gain_{axis}"] for axis in _AXES])
        for to, by in _COUPLINGS:
            gains[to, by] = values[f"coupling_{_AXES[to]}_{_AXES[by]}"]
        product: Doubles = commands @ gains.T
        return product

    def tops(self) -> tuple[str, ...]:
        """Return the top speeds; see `Drive.tops`."""
        return ("max_speed", "max_angular_velocity")

    def demanded(self, values: Mapping[str, float], commands: Doubles) -> list[Doubles]:
        """Return speeds and angular velocities; see `Drive.demanded`."""
        obeyed = self.obeyed(values, commands)
        return [np.hypot(obeyed[..., 0], obeyed[..., 1]), np.abs(obeyed[..., 2])]

    def accelerations(self) -> tuple[str, ...]:
        """Return the four limits; see `Drive.accelerations`."""
        return tuple(each.name for each in self.parameters[10:14])


class WheelDrive(Drive):
    """Robots commanded by two wheel speeds: wheels, track and tires."""

    parameters = (
        Parameter(LATENCY, "s", 0.0005, 0.01, excited_by="commands that change"),
        Parameter("wheel_difference", "1", 0.002, 0.05, excited_by="driving straight"),
        *(
            Parameter(name, unit, 0.01, tolerance, is_limit=True, excited_by=excited)
            for name, unit, tolerance, excited in (
                ("wheel_radius", "m", 0.05, "driving straight"),
                ("track_width", "m", 0.05, "turning"),
                ("longitudinal_grip", "m/s²", 0.12, "steps of the wheels' speeds"),
                ("lateral_grip", "m/s²", 0.12, "fast arcs in which the tires slip sideways"),
                ("max_wheel_speed", "rad/s", 0.12, "wheel speeds beyond the maximum"),
            )
        ),
    )

    def start(self, observed: Mapping[str, float]) -> dict[str, float]:
        """Return the base's numbers and equal wheels; see `Drive.start`."""
        values = {LATENCY: 0.0, "wheel_difference": 0.0}
        values |= {each.name: getattr(self.base, each.name) for each in self.parameters[2:]}
        values["max_wheel_speed"] = max(observed["speed"], 0.05) / self.base.wheel_radius
        return values

    def numbers(self, values: Mapping[str, float]) -> dict[str, float]:
        """Return those of the wheels, and of motors as strong as before; see `Drive.numbers`."""
        limits = [each.name for each in self.parameters if each.is_limit]
        numbers = {name: values[name] for name in limits if name in values}
        # The fitted radius is distance by angle; it leaves the force of the motors as it is.
        if "wheel_radius" in numbers:
            ratio = numbers["wheel_radius"] / self.base.wheel_radius
            numbers["motor_torque"] = self.base.motor_torque * ratio
        return numbers

    def obeyed(self, values: Mapping[str, float], commands: Doubles) -> Doubles:
        """Return commands of unequal wheels; see `Drive.obeyed`."""
        half = values["wheel_difference"] / 2.0
        unequal: Doubles = commands * np.array([1.0 - half, 1.0 + half])
        return unequal

    def tops(self) -> tuple[str, ...]:
        """Return the maximum wheel speed; see `Drive.tops`."""
        return ("max_wheel_speed",)

    def demanded(self, values: Mapping[str, float], commands: Doubles) -> list[Doubles]:
        """Return the speeds of the faster wheels; see `Drive.demanded`."""
        return [np.abs(self.obeyed(values, commands)).max(axis=-1)]

    def accelerations(self) -> tuple[str, ...]:
        """Return the grip; see `Drive.accelerations`."""
        return ("longitudinal_grip",)
