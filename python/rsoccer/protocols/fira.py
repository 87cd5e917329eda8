"""FIRASim's packets: wheels, replacements and the state of the field."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.commands import Collector, RobotCommands, motion
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import TEAMS, WireLayout
from rsoccer.protocols.placing import Placement
from rsoccer.protocols.schemas import fira_pb2
from rsoccer.protocols.tracked import Tracked

MILLISECONDS: Final = 1000.0
"""Milliseconds in a second: the unit of `step`."""


def read_commands(
    layout: WireLayout, message: fira_pb2.Packet, previous: Floats | None = None
) -> RobotCommands:
    """Return the commands of a packet. It may have robots of both teams.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        previous: (robots, command) commands that hold for robots that the packet lacks; None for
            zeros.

    Returns:
        The commands of all robots: speeds of the wheels in rad/s, which positive is forward.

    Raises:
        ValueError: `previous` has another shape.
    """
    collector = Collector(layout, previous)
    for command in message.cmd.robot_commands:
        row = collector.row(YELLOW if command.yellowteam else BLUE, command.id)
        if row is None:
            continue
        try:
            row.turn_wheels((command.wheel_left, command.wheel_right))
        except MessageError as error:
            collector.add(error)
    return collector.result()


def to_commands(
    layout: WireLayout, commands: Floats, team: int, robots: Mask | None = None
) -> fira_pb2.Packet:
    """Return the packet that gives a team's robots their commands.

    Args:
        layout: the match, of robots on two wheels.
        commands: (robots, command) commands of all robots, finite.
        team: `BLUE` or `YELLOW`.
        robots: (robots,) robots to command; None for all of the team.

    Raises:
        MessageError: a robot with other wheels.
    """
    message, models = fira_pb2.Packet(), layout.config.robots
    for slot in layout.slots(team):
        if robots is not None and not robots[slot]:
            continue
        if models[slot].drive != "differential":
            raise MessageError(
                Code.UNSUPPORTED_MOVE, f"drive: expected differential, got {models[slot].drive}"
            )
        left, right = motion(models[slot], commands[slot]).wheels
        message.cmd.robot_commands.add(
            id=layout.identity(slot)[1],
            yellowteam=team == YELLOW,
            wheel_left=left,
            wheel_right=right,
        )
    return message


def read_replacement(
    layout: WireLayout, message: fira_pb2.Packet, frame: Frame, world: int = 0
) -> Placement:
    """Return the state that a packet asks for.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        frame: states.
        world: index of the world.

    Returns:
        The state with the bodies that are put somewhere. Zeros are not on the wire, so all numbers
        count; a robot without `turnon` leaves the field, as in FIRASim.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    placement = Placement(layout, frame, world)
    for robot in message.replace.robots:
        place = robot.position
        try:
            slot = placement.slot(YELLOW if robot.yellowteam else BLUE, place.robot_id)
            placement.put_robot(
                slot,
                (place.x, place.y),
                math.radians(place.orientation),
                (place.vx, place.vy, place.vorientation),
                robot.turnon,
            )
        except MessageError as error:
            placement.add(error)
    if message.replace.HasField("ball"):
        ball = message.replace.ball
        try:
            placement.put_ball((ball.x, ball.y, 0.0), (ball.vx, ball.vy, 0.0))
        except MessageError as error:
            placement.add(error)
    return placement


def to_replacement(layout: WireLayout, frame: Frame, world: int = 0) -> fira_pb2.Packet:
    """Return the packet that puts ball and robots where a state has them.

    Args:
        layout: the match.
        frame: states.
        world: index of the world.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = fira_pb2.Packet()
    ball = message.replace.ball
    ball.x, ball.y = layout.rotated(frame.ball.position[world]).tolist()
    ball.vx, ball.vy = layout.rotated(frame.ball.velocity[world]).tolist()
    for slot in range(layout.config.n_robots):
        robot = message.replace.robots.add(
            yellowteam=layout.identity(slot)[0] == YELLOW,
            turnon=bool(frame.robots.absent[world, slot] == 0),
        )
        robot.position.CopyFrom(_robot(layout, frame, world, slot))
        robot.position.orientation = math.degrees(robot.position.orientation)
    return message


def to_environment(
    layout: WireLayout, frame: Frame, world: int = 0, *, seconds: float, score: tuple[int, int]
) -> fira_pb2.Environment:
    """Return the packet of the simulator.

    Args:
        layout: the match. FIRASim itself has blue at +x.
        frame: states, or what senses made of them.
        world: index of the world.
        seconds: simulated time, s.
        score: goals of blue and of yellow.

    Returns:
        The packet; robots that are absent are left out.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = fira_pb2.Environment(
        step=round(MILLISECONDS * seconds) % 2**32, goals_blue=score[0], goals_yellow=score[1]
    )
    ball = message.frame.ball
    ball.x, ball.y = layout.rotated(frame.ball.position[world]).tolist()
    ball.vx, ball.vy = layout.rotated(frame.ball.velocity[world]).tolist()
    ball.z, ball.vz = float(frame.ball.height[world]), float(frame.ball.vertical_velocity[world])
    groups = (message.frame.robots_blue, message.frame.robots_yellow)
    for slot in np.flatnonzero(frame.robots.absent[world] == 0).tolist():
        groups[layout.identity(slot)[0]].append(_robot(layout, frame, world, slot))
    field = layout.config.field
    message.field.width, message.field.length = field.width, field.length
    message.field.goal_width, message.field.goal_depth = field.goal_width, field.goal_depth
    message.field.center_radius = field.center_circle_radius
    message.field.penalty_width = field.goal_area_width
    message.field.penalty_depth = field.goal_area_depth
    message.field.penalty_point = field.penalty_mark_distance
    return message


def _robot(layout: WireLayout, frame: Frame, world: int, slot: int) -> fira_pb2.Robot:
    robots = frame.robots
    x, y = layout.rotated(robots.position[world, slot]).tolist()
    v_x, v_y = layout.rotated(robots.velocity[world, slot]).tolist()
    return fira_pb2.Robot(
        robot_id=layout.identity(slot)[1],
        x=x,
        y=y,
        orientation=float(layout.angle_to_wire(robots.heading[world, slot])),
        vx=v_x,
        vy=v_y,
        vorientation=float(robots.angular_velocity[world, slot]),
    )


def read_environment(
    layout: WireLayout, message: fira_pb2.Environment, last: Frame | None = None
) -> Tracked:
    """Return the state in a packet of the simulator.

    Args:
        layout: the match.
        message: the packet, from `rsoccer.protocols.parsing.parse`.
        last: frame of one world with what the packet lacks; None for `Frame.empty`, with robots
            that are absent.

    Returns:
        The state; its time is the simulated one.

    Raises:
        ValueError: `last` is a frame of other teams.
    """
    placed = Tracked.begin(layout, last, message.step / MILLISECONDS)
    groups = (message.frame.robots_blue, message.frame.robots_yellow)
    for team, group in zip(TEAMS, groups, strict=True):
        for robot in group:
            placed.put_robot(
                layout,
                (team, robot.robot_id),
                (robot.x, robot.y, robot.orientation),
                (robot.vx, robot.vy, robot.vorientation),
            )
    if message.frame.HasField("ball"):
        ball = message.frame.ball
        placed.put_ball(layout, (ball.x, ball.y, ball.z), (ball.vx, ball.vy, ball.vz))
    return placed


def read_score(message: fira_pb2.Environment) -> tuple[int, int]:
    """Return the goals of blue and of yellow in a packet of the simulator.

    Args:
        message: the packet, from `rsoccer.protocols.parsing.parse`. FIRASim itself counts none.
    """
    return message.goals_blue, message.goals_yellow
