"""grSim's own packets: commands, replacements and status of robots."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.commands import Collector, CommandRow, RobotCommands, motion
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.placing import Placement
from rsoccer.protocols.schemas import grsim_pb2

MIN_KICK: Final = 1e-4
"""Speed up to which a kick is none, m/s (grSim fe2bd29)."""
MIN_CHIP: Final = 1.0
"""Upward speed from which a kick is reported as a chip, m/s (grSim fe2bd29)."""
_WHEELS: Final = ("wheel1", "wheel2", "wheel3", "wheel4")


def read_commands(
    layout: WireLayout, message: grsim_pb2.Packet, previous: Floats | None = None
) -> RobotCommands:
    """Return the commands of a packet.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        previous: (robots, command) commands that hold for robots that the packet lacks, and for
            wheels that it lacks; None for zeros. Kicks of robots in the packet do not hold on.

    Returns:
        The commands of all robots.

    Raises:
        ValueError: `previous` has another shape.
    """
    collector = Collector(layout, previous)
    commands = message.commands
    team = YELLOW if commands.isteamyellow else BLUE
    for command in commands.robot_commands:
        row = collector.row(team, command.id)
        if row is None:
            continue
        for part in (_move, _kick, _dribble):
            try:
                part(row, command)
            except MessageError as error:
                collector.add(error)
    return collector.result()


def _move(row: CommandRow, command: grsim_pb2.RobotCommand) -> None:
    if not command.wheelsspeed:
        row.drive(command.veltangent, command.velnormal, command.velangular)
        return
    missing = [name for name in _WHEELS if not command.HasField(name)]
    if missing:
        raise MessageError(
            Code.INCOMPLETE, f"wheelsspeed: expected speeds of four wheels, got no {missing}"
        )
    row.turn_wheels(getattr(command, name) for name in _WHEELS)


def _kick(row: CommandRow, command: grsim_pb2.RobotCommand) -> None:
    if command.kickspeedx > MIN_KICK or command.kickspeedz > MIN_KICK:
        row.kick(command.kickspeedx, command.kickspeedz)
    elif command.kickspeedx < 0 or command.kickspeedz < 0:
        row.kick(min(command.kickspeedx, 0.0), min(command.kickspeedz, 0.0))


def _dribble(row: CommandRow, command: grsim_pb2.RobotCommand) -> None:
    row.dribble(float(command.spinner))


def to_commands(
    layout: WireLayout,
    commands: Floats,
    team: int,
    *,
    timestamp: float = 0.0,
    robots: Mask | None = None,
) -> grsim_pb2.Packet:
    """Return the packet that gives a team's robots their commands.

    Args:
        layout: the match.
        commands: (robots, command) commands of all robots, finite.
        team: `BLUE` or `YELLOW`.
        timestamp: time of sending, s.
        robots: (robots,) robots to command; None for all of the team.

    Returns:
        The packet, with velocities. A dribbler runs if it has at least half of its speed.
    """
    message, models = grsim_pb2.Packet(), layout.config.robots
    message.commands.timestamp = timestamp
    message.commands.isteamyellow = team == YELLOW
    for slot in layout.slots(team):
        if robots is not None and not robots[slot]:
            continue
        asked = motion(models[slot], commands[slot])
        forward, left, angular = asked.velocity
        message.commands.robot_commands.add(
            id=layout.identity(slot)[1],
            kickspeedx=asked.kick[0],
            kickspeedz=asked.kick[1],
            veltangent=forward,
            velnormal=left,
            velangular=angular,
            spinner=asked.dribbler >= 0.5,
            wheelsspeed=False,
        )
    return message


def read_replacement(
    layout: WireLayout, message: grsim_pb2.Packet, frame: Frame, world: int = 0
) -> Placement:
    """Return the state that a packet asks for.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        frame: states.
        world: index of the world.

    Returns:
        The state with the bodies that are put somewhere. Robots that were put somewhere rest, and
        a robot without `turnon` stays on the field, as in grSim.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    placement = Placement(layout, frame, world)
    for robot in message.replacement.robots:
        try:
            slot = placement.slot(YELLOW if robot.yellowteam else BLUE, robot.id)
            present = robot.turnon if robot.HasField("turnon") else True
            angle = math.radians(robot.dir)
            placement.put_robot(slot, (robot.x, robot.y), angle, present=present)
        except MessageError as error:
            placement.add(error)
    if message.replacement.HasField("ball"):
        ball = message.replacement.ball
        x, y, v_x, v_y = given = tuple(
            getattr(ball, name) if ball.HasField(name) else None for name in ("x", "y", "vx", "vy")
        )
        try:
            if any(number is not None for number in given):
                placement.put_ball((x, y, 0.0), (v_x, v_y, 0.0))
        except MessageError as error:
            placement.add(error)
    return placement


def to_replacement(
    layout: WireLayout, frame: Frame, world: int = 0, *, robots: Mask | None = None
) -> grsim_pb2.Packet:
    """Return the packet that puts ball and robots where a state has them.

    Args:
        layout: the match.
        frame: states.
        world: index of the world.
        robots: (robots,) robots to put somewhere; None for all. Absent ones are turned off.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = grsim_pb2.Packet()
    ball = message.replacement.ball
    ball.x, ball.y = layout.rotated(frame.ball.position[world]).tolist()
    ball.vx, ball.vy = layout.rotated(frame.ball.velocity[world]).tolist()
    positions = layout.rotated(frame.robots.position[world]).tolist()
    angles = np.degrees(layout.angle_to_wire(frame.robots.heading[world])).tolist()
    for slot in range(layout.config.n_robots):
        if robots is not None and not robots[slot]:
            continue
        team, number = layout.identity(slot)
        message.replacement.robots.add(
            x=positions[slot][0],
            y=positions[slot][1],
            dir=angles[slot],
            id=number,
            yellowteam=team == YELLOW,
            turnon=bool(frame.robots.absent[world, slot] == 0),
        )
    return message


def to_status(
    layout: WireLayout,
    frame: Frame,
    world: int,
    team: int,
    commands: Floats,
    robots: Iterable[int] | None = None,
) -> grsim_pb2.StatusPacket:
    """Return the status of a team's robots.

    Args:
        layout: the match.
        frame: states after a step.
        world: index of the world.
        team: `BLUE` or `YELLOW`.
        commands: (robots, command) commands in the step: a robot that touched the ball on a kick
            has kicked it.
        robots: indices of robots in a state row to tell about, such as those whose status changed;
            None for all of the team.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message, models = grsim_pb2.StatusPacket(), layout.config.robots
    chosen = layout.slots(team) if robots is None else robots
    for slot in chosen:
        forward, upward = motion(models[slot], commands[slot]).kick
        kicked = bool(frame.robots.touched_ball[world, slot] > 0) and forward + upward > 0
        message.robots_status.add(
            robot_id=layout.identity(slot)[1],
            infrared=bool(frame.robots.infrared[world, slot] > 0),
            flat_kick=kicked and upward < MIN_CHIP,
            chip_kick=kicked and upward >= MIN_CHIP,
        )
    return message


def read_status(layout: WireLayout, message: grsim_pb2.StatusPacket, team: int) -> dict[int, bool]:
    """Return whether robots have the ball at their dribbler, by index in a state row.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        team: `BLUE` or `YELLOW`.
    """
    found = {}
    for status in message.robots_status:
        try:
            found[layout.slot(team, status.robot_id)] = status.infrared
        except MessageError:
            continue
    return found
