"""Greatest speeds of robots and kicks, whatever a policy asks for."""

from __future__ import annotations

import math

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Floats
from rsoccer.drive.settings import Limits
from rsoccer.protocols.commands import CommandRow, motion


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
