"""Commands of robots: velocities, wheels, kicks and dribblers as columns of a command, and back.

All protocols share these conversions, so that a field means the same in each of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.compat.wheel_kinematics import WheelKinematics
from rsoccer.protocols.errors import Code, MessageError, Problem, Problems
from rsoccer.protocols.layout import TEAM_NAMES, WireLayout

FULL_DRIBBLER_RPM: Final = 1432.0
"""Revolutions a minute at which a dribbler runs at its full speed: ER-Force's simulator, 150 rad/s
(framework 9814d057)."""
MAX_KICK_ANGLE: Final = 90.0
"""Greatest angle of a kick over the floor, degrees."""


class RobotCommands(NamedTuple):
    """Commands of a message, in SI units and the columns of the simulator."""

    commands: Floats
    """(robots, command) commands of all robots, in the order of a state row."""
    given: Mask
    """(robots,) robots that the message has."""
    problems: tuple[Problem, ...]
    """Parts of the message that are not honored."""


class CommandRow:
    """The command of one robot, which parts of messages change."""

    def __init__(self, model: RobotModel, columns: Floats) -> None:
        """Begin with a command; its kick is cleared, since it holds until the robot's next one.

        Args:
            model: the robot.
            columns: (command,) the command, changed in place.
        """
        self.model = model
        self._columns = columns
        self._places = {name: place for place, name in enumerate(model.command_columns)}
        for name in ("kick_v_x", "kick_v_z"):
            if name in self._places:
                columns[self._places[name]] = 0.0

    def drive(self, forward: float, left: float, angular: float) -> None:
        """Set the velocity.

        Args:
            forward: m/s.
            left: m/s.
            angular: rad/s, counterclockwise.

        Raises:
            MessageError: a robot on two wheels cannot drive to its left.
        """
        drive, velocity = self.model.drive, np.array([[forward, left, angular]])
        if drive == "omni":
            self._columns[:3] = velocity[0]
        elif drive == "omni_wheels":
            self._columns[:4] = _kinematics(self.model).wheel_speeds(velocity)[0]
        elif left:
            raise MessageError(
                Code.UNSUPPORTED_MOVE, f"left: expected 0 for a robot on two wheels, got {left:g}"
            )
        else:
            half, radius = self.model.track_width / 2, self.model.wheel_radius
            self._columns[0] = (forward - angular * half) / radius
            self._columns[1] = (forward + angular * half) / radius

    def turn_wheels(self, speeds: Iterable[float]) -> None:
        """Set the speeds of the wheels.

        Args:
            speeds: four speeds in rad/s in the order of `RobotModel.wheel_angles`, which begins at
                the front left one; positive turns the robot counterclockwise. Two of a robot on two
                wheels, left and right; positive is forward.

        Raises:
            MessageError: a robot with another number of wheels.
        """
        wheels = np.array([tuple(speeds)], np.float64)
        expected = 2 if self.model.drive == "differential" else 4
        if wheels.shape[1] != expected:
            raise MessageError(
                Code.UNSUPPORTED_MOVE,
                f"wheels: expected speeds of {expected} wheels, got {wheels.shape[1]}",
            )
        if self.model.drive == "omni":
            self._columns[:3] = _kinematics(self.model).body_velocities(wheels)[0]
        else:
            self._columns[:expected] = wheels[0]

    def kick(self, forward: float, upward: float) -> None:
        """Set the kick.

        Args:
            forward: velocity of the ball along the floor, m/s; 0 or above.
            upward: velocity upward, m/s; 0 or above.

        Raises:
            MessageError: a velocity below 0, or a robot without a kicker.
        """
        if forward < 0 or upward < 0:
            raise MessageError(
                Code.OUT_OF_RANGE, f"kick: expected 0 or above, got {forward:g}, {upward:g} m/s"
            )
        if not (forward or upward):
            return
        if "kick_v_x" not in self._places:
            raise MessageError(Code.UNSUPPORTED_KICK, "kick: expected none, got one")
        self._columns[self._places["kick_v_x"]] = forward
        self._columns[self._places["kick_v_z"]] = upward

    def kick_at(self, speed: float, degrees: float) -> None:
        """Set the kick by its speed and angle.

        Args:
            speed: speed of the ball in space, m/s; 0 or above.
            degrees: angle over the floor, 0 to 90.

        Raises:
            MessageError: a value out of range, or a robot without a kicker.
        """
        if not 0.0 <= degrees <= MAX_KICK_ANGLE:
            raise MessageError(
                Code.OUT_OF_RANGE,
                f"kick_angle: expected 0 to {MAX_KICK_ANGLE:g} degrees, got {degrees:g}",
            )
        if degrees:
            angle = math.radians(degrees)
            self.kick(speed * math.cos(angle), speed * math.sin(angle))
        else:
            self.kick(speed, 0.0)

    def dribble(self, share: float) -> None:
        """Set the dribbler.

        Args:
            share: share of its full speed; above 1 counts as 1.

        Raises:
            MessageError: a share below 0, or a robot without a dribbler that is to run.
        """
        if share < 0:
            raise MessageError(Code.OUT_OF_RANGE, f"dribbler: expected 0 or above, got {share:g}")
        if "dribbler" in self._places:
            self._columns[self._places["dribbler"]] = min(share, 1.0)
        elif share:
            raise MessageError(Code.UNSUPPORTED_DRIBBLER, "dribbler: expected 0, got more")


class Collector:
    """Commands of a message while it is read: a row for each robot, and problems."""

    def __init__(self, layout: WireLayout, previous: Floats | None) -> None:
        """Begin with the previous commands.

        Args:
            layout: the match.
            previous: (robots, command) commands that hold where a message has no field; None for
                zeros.

        Raises:
            ValueError: `previous` has another shape.
        """
        config = layout.config
        shape = (config.n_robots, len(config.command_columns))
        self.commands = np.zeros(shape, np.float32)
        if previous is not None:
            if np.shape(previous) != shape:
                raise ValueError(f"previous: expected shape {shape}, got {np.shape(previous)}")
            self.commands[:] = previous
        self._layout = layout
        self._given = np.zeros(config.n_robots, np.bool_)
        self._problems = Problems()
        self._models = config.robots

    def row(self, team: int, robot_id: int) -> CommandRow | None:
        """Return the command of a robot; None, and a problem, if it is unknown or named twice.

        Args:
            team: `BLUE` or `YELLOW`.
            robot_id: uniform number.
        """
        try:
            slot = self._layout.slot(team, robot_id)
        except MessageError as error:
            self.add(error)
            return None
        if self._given[slot]:
            name = f"{TEAM_NAMES[team]} robot {robot_id}"
            self.add(MessageError(Code.DUPLICATE_ROBOT, f"id: expected {name} once, got it twice"))
            return None
        self._given[slot] = True
        return CommandRow(self._models[slot], self.commands[slot])

    def add(self, error: MessageError) -> None:
        """List a part of the message that is not honored.

        Args:
            error: the reason.
        """
        self._problems.add(error)

    def result(self) -> RobotCommands:
        """Return what has been read. Robots without an entry keep their commands and kicks."""
        return RobotCommands(self.commands, self._given, tuple(self._problems.listed()))


class Motion(NamedTuple):
    """Demands of a command on a robot, whatever its drive."""

    velocity: tuple[float, float, float]
    """Forward and to the left, m/s; counterclockwise, rad/s."""
    wheels: tuple[float, ...]
    """Speeds of two or four wheels as in `CommandRow.turn_wheels`, rad/s."""
    kick: tuple[float, float]
    """Velocity of the ball forward and upward, m/s."""
    dribbler: float
    """Share of the full speed, 0 to 1."""


def motion(model: RobotModel, command: Floats) -> Motion:
    """Return what a command asks of a robot.

    Args:
        model: the robot.
        command: (command,) its command.
    """
    numbers = [float(value) for value in command]
    values = dict(zip(model.command_columns, numbers, strict=False))
    kick = (values.get("kick_v_x", 0.0), values.get("kick_v_z", 0.0))
    dribbler = values.get("dribbler", 0.0)
    if model.drive == "differential":
        left, right = (model.wheel_radius * speed for speed in numbers[:2])
        velocity = ((left + right) / 2, 0.0, (right - left) / model.track_width)
        return Motion(velocity, tuple(numbers[:2]), kick, dribbler)
    if model.drive == "omni":
        forward, sideways, angular = numbers[:3]
        wheels = _kinematics(model).wheel_speeds(np.array([numbers[:3]]))[0]
        return Motion((forward, sideways, angular), tuple(wheels.tolist()), kick, dribbler)
    speeds: Doubles = np.array([numbers[:4]])
    forward, sideways, angular = _kinematics(model).body_velocities(speeds)[0].tolist()
    return Motion((forward, sideways, angular), tuple(numbers[:4]), kick, dribbler)


@lru_cache(maxsize=64)
def _kinematics(model: RobotModel) -> WheelKinematics:
    return WheelKinematics(model)
