"""Control of a team's robots in the simulation protocol of the SSL."""

from __future__ import annotations

import math

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.protocols.commands import (
    FULL_DRIBBLER_RPM,
    Collector,
    CommandRow,
    RobotCommands,
    motion,
)
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import simulation_pb2


def read_robot_control(
    layout: WireLayout,
    message: simulation_pb2.RobotControl,
    team: int,
    frame: Frame,
    world: int = 0,
    previous: Floats | None = None,
) -> RobotCommands:
    """Return the commands of a message to a team's port.

    Args:
        layout: the match.
        message: the message, from `rsoccer.protocols.parsing.parse`.
        team: `BLUE` or `YELLOW`: the port.
        frame: states, for the directions of robots that are driven along the field's axes.
        world: index of the world.
        previous: (robots, command) commands that hold where the message has no movement or
            dribbler; None for zeros. Kicks of robots in the message do not hold on.

    Returns:
        The commands of all robots; only those of the team change.

    Raises:
        ValueError: a frame of other teams, no such world, or `previous` of another shape.
    """
    layout.check_frame(frame, world)
    collector = Collector(layout, previous)
    for command in message.robot_commands:
        row = collector.row(team, command.id)
        if row is None:
            continue
        heading = frame.robots.heading[world, layout.slot(team, command.id)] * layout.sign
        for part in (_move, _kick, _dribble):
            try:
                part(row, command, heading)
            except MessageError as error:
                collector.add(error)
    return collector.result()


def _move(row: CommandRow, command: simulation_pb2.RobotCommand, heading: Floats) -> None:
    move = command.move_command
    kind = move.WhichOneof("command")
    if kind == "wheel_velocity":
        wheels, radius = move.wheel_velocity, row.model.wheel_radius
        speeds = (wheels.front_left, wheels.back_left, wheels.back_right, wheels.front_right)
        row.turn_wheels(speed / radius for speed in speeds)
    elif kind == "local_velocity":
        local = move.local_velocity
        row.drive(local.forward, local.left, local.angular)
    elif kind == "global_velocity":
        moved = move.global_velocity
        cos, sin = heading.tolist()
        row.drive(cos * moved.x + sin * moved.y, cos * moved.y - sin * moved.x, moved.angular)
    elif command.HasField("move_command"):
        raise MessageError(Code.UNSUPPORTED_MOVE, "move_command: expected a velocity, got none")


def _kick(row: CommandRow, command: simulation_pb2.RobotCommand, _: Floats) -> None:
    if command.kick_speed:
        row.kick_at(command.kick_speed, command.kick_angle)


def _dribble(row: CommandRow, command: simulation_pb2.RobotCommand, _: Floats) -> None:
    if command.HasField("dribbler_speed"):
        speed = command.dribbler_speed
        if speed < 0:
            message = f"dribbler_speed: expected 0 or above, got {speed:g}"
            raise MessageError(Code.OUT_OF_RANGE, message)
        row.dribble(speed / FULL_DRIBBLER_RPM)


def to_robot_control(
    layout: WireLayout, commands: Floats, team: int, robots: Mask | None = None
) -> simulation_pb2.RobotControl:
    """Return the message that gives a team's robots their commands.

    Args:
        layout: the match.
        commands: (robots, command) commands of all robots, finite.
        team: `BLUE` or `YELLOW`.
        robots: (robots,) robots to command; None for all of the team.

    Returns:
        The message, with local velocities.
    """
    message, models = simulation_pb2.RobotControl(), layout.config.robots
    for slot in layout.slots(team):
        if robots is not None and not robots[slot]:
            continue
        asked = motion(models[slot], commands[slot])
        command = message.robot_commands.add(id=layout.identity(slot)[1])
        local = command.move_command.local_velocity
        local.forward, local.left, local.angular = asked.velocity
        speed = math.hypot(*asked.kick)
        command.kick_speed = speed
        if asked.kick[1]:
            command.kick_angle = math.degrees(math.atan2(asked.kick[1], asked.kick[0]))
        if models[slot].has_mouth:
            command.dribbler_speed = FULL_DRIBBLER_RPM * asked.dribbler
    return message
