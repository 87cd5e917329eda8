"""Greatest speeds of robots and kicks, whatever a policy asks for."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rsoccer import checks
from rsoccer._core import RobotModel
from rsoccer.arrays import Floats
from rsoccer.protocols.commands import CommandRow, motion


@dataclass(frozen=True)
class Limits:
    """Greatest speeds of robots and kicks, whatever a policy asks for.

    Attributes:
        speed: speed of a robot, m/s.
        angular_velocity: angular velocity of a robot, rad/s.
        kick_speed: speed of a kick in space, m/s; 0 for no kicks.
        stop_speed: speed of a robot while the referee has play stopped, m/s. The rules of the SSL
            have 1.5 m/s.
    """

    speed: float = math.inf
    angular_velocity: float = math.inf
    kick_speed: float = math.inf
    stop_speed: float = 1.5

    def __post_init__(self) -> None:
        """Check the numbers.

        Raises:
            TypeError: no number.
            ValueError: a number below 0 or NaN.
        """
        for name in ("speed", "angular_velocity", "kick_speed", "stop_speed"):
            value = getattr(self, name)
            if value != math.inf:
                checks.number_in_range(f"limits: {name}", value, 0.0, 1e6)


def limited(model: RobotModel, command: Floats, limits: Limits) -> Floats:
    """Return a command within limits.

    Directions are kept: of a velocity, and of a kick.

    Args:
        model: the robot.
        command: (command,) the command, finite.
        limits: the limits.

    Returns:
        (command,) the command itself if it is within the limits.
    """
    asked = motion(model, command)
    forward, left, turn = asked.velocity
    speed, kick = math.hypot(forward, left), math.hypot(*asked.kick)
    by_speed = min(1.0, limits.speed / speed) if speed else 1.0
    by_turn = min(1.0, limits.angular_velocity / abs(turn)) if turn else 1.0
    by_kick = min(1.0, limits.kick_speed / kick) if kick else 1.0
    if by_speed == by_turn == by_kick == 1.0:
        return command
    row = np.array(command, np.float32)
    made = CommandRow(model, row)
    if by_speed < 1.0 or by_turn < 1.0:
        made.drive(by_speed * forward, by_speed * left, by_turn * turn)
    made.kick(by_kick * asked.kick[0], by_kick * asked.kick[1])
    return row


def stopped(command: Floats) -> Floats:
    """Return the command of a robot that stops, neither kicks nor dribbles.

    Args:
        command: (..., command) any commands.
    """
    return np.zeros_like(command)
