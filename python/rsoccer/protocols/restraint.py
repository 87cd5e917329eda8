"""Robots under a referee on the network: commands that it allows."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from rsoccer._core import RobotModel, SimConfig
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW, Command
from rsoccer.protocols.ball_in_play import BallInPlay, team_of
from rsoccer.protocols.commands import CommandRow, motion
from rsoccer.protocols.limits import Limits, limited, stopped
from rsoccer.protocols.referee import RUNNING

KEEP_AWAY: Final = 0.55
"""Distance of a robot's center from the ball when the other team has the kick or play is stopped,
m: 0.5 m by the rules of the SSL, and the error of a tracker."""
GAP: Final = 0.05
"""Gap to the ball of a robot that waits for the start of its own team's kick, m."""
RETREAT: Final = 0.5
"""Greatest speed away from the ball of a robot that is too near, m/s."""
APPROACH: Final = 2.0
"""Greatest approach to the distance, 1/s: speed by what is left of the way."""


def must_stand(state: BallInPlay, *, is_vsss: bool) -> bool:
    """Return whether all robots must stand still.

    Args:
        state: what the referee says.
        is_vsss: whether its league is the VSSS, where people or the simulator place robots while no
            game is on.
    """
    return state.command not in RUNNING if is_vsss else state.command is Command.HALT


def restrained(
    config: SimConfig, state: BallInPlay, commands: Floats, frame: Frame, stop_speed: float
) -> Floats:
    """Return commands of SSL robots that a referee allows.

    Robots that may not touch the ball keep away from it, and neither kick nor dribble.

    Args:
        config: field, ball and robots.
        state: what the referee says.
        commands: (robots, command) commands of all robots.
        frame: frame of one world, what is known.
        stop_speed: greatest speed in a stop, m/s.

    Returns:
        (robots, command), the commands themselves where they may be.
    """
    command = state.command
    if command is None:
        return commands
    if must_stand(state, is_vsss=False):
        return stopped(commands)
    allowed = np.array(commands, np.float32)
    speed = stop_speed if command is Command.STOP else math.inf
    limits = Limits(speed=speed, kick_speed=0.0)
    kicking = team_of(state.kick if command is Command.NORMAL_START else command)
    for team in (BLUE, YELLOW):
        if state.may_touch(team):
            continue
        slots = range(config.n_blue) if team == BLUE else range(config.n_blue, config.n_robots)
        for slot in slots:
            model = config.robots[slot]
            touching = model.radius + config.ball.radius
            distance = touching + GAP if kicking == team else KEEP_AWAY
            allowed[slot] = _away(model, allowed[slot], frame, slot, distance)
            allowed[slot] = limited(model, allowed[slot], limits)
    return allowed


def _away(model: RobotModel, command: Floats, frame: Frame, slot: int, distance: float) -> Floats:
    """A command that keeps a robot at a distance from the ball, and does not dribble."""
    offset = frame.robots.position[0, slot] - frame.ball.position[0]
    gap = float(np.hypot(*offset))
    away = offset / gap if gap > 1e-6 else np.array([1.0, 0.0], np.float32)
    cos, sin = frame.robots.heading[0, slot].tolist()
    asked = motion(model, command)
    forward, left, turn = asked.velocity
    velocity = np.array([cos * forward - sin * left, sin * forward + cos * left])
    outward = float(velocity @ away)
    least = min(APPROACH * (distance - gap), RETREAT)
    row = np.array(command, np.float32)
    made = CommandRow(model, row)
    made.dribble(0.0)
    if outward < least and model.drive != "differential":
        x, y = (velocity + (least - outward) * away).tolist()
        made.drive(cos * x + sin * y, cos * y - sin * x, turn)
    return row
