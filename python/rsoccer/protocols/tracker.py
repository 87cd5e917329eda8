"""Packets of trackers: from a state to filtered positions and velocities, and back."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, Problem
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import tracker_pb2
from rsoccer.protocols.tracked import Tracked

_COLORS: Final = {BLUE: tracker_pb2.TEAM_COLOR_BLUE, YELLOW: tracker_pb2.TEAM_COLOR_YELLOW}
_TEAMS: Final = {color: team for team, color in _COLORS.items()}


def to_packet(
    layout: WireLayout,
    frame: Frame,
    world: int = 0,
    *,
    frame_number: int,
    timestamp: float,
    uuid: str,
    source_name: str = "rSoccer",
) -> tracker_pb2.Packet:
    """Return the packet of a tracker.

    Args:
        layout: the match.
        frame: states, or what senses made of them.
        world: index of the world.
        frame_number: number of the frame; taken modulo 2**32.
        timestamp: time of the state, s.
        uuid: identity of the running sender.
        source_name: name of the sender.

    Returns:
        The packet; robots that are absent are left out.

    Raises:
        ValueError: a frame of other teams, or no such world.
    """
    layout.check_frame(frame, world)
    message = tracker_pb2.Packet(uuid=uuid, source_name=source_name)
    tracked = message.tracked_frame
    tracked.frame_number = frame_number % 2**32
    tracked.timestamp = timestamp
    tracked.capabilities.append(tracker_pb2.CAPABILITY_DETECT_FLYING_BALLS)
    ball = tracked.balls.add(visibility=1.0)
    ball.pos.x, ball.pos.y = layout.rotated(frame.ball.position[world]).tolist()
    ball.pos.z = float(frame.ball.height[world])
    ball.vel.x, ball.vel.y = layout.rotated(frame.ball.velocity[world]).tolist()
    ball.vel.z = float(frame.ball.vertical_velocity[world])
    positions = layout.rotated(frame.robots.position[world]).tolist()
    velocities = layout.rotated(frame.robots.velocity[world]).tolist()
    angles = layout.angle_to_wire(frame.robots.heading[world]).tolist()
    turning = frame.robots.angular_velocity[world].tolist()
    for slot in np.flatnonzero(frame.robots.absent[world] == 0).tolist():
        team, number = layout.identity(slot)
        robot = tracked.robots.add(
            orientation=angles[slot], vel_angular=turning[slot], visibility=1.0
        )
        robot.robot_id.id, robot.robot_id.team_color = number, _COLORS[team]
        robot.pos.x, robot.pos.y = positions[slot]
        robot.vel.x, robot.vel.y = velocities[slot]
    return message


def to_frame(
    layout: WireLayout, message: tracker_pb2.TrackedFrame, last: Frame | None = None
) -> Tracked:
    """Return the state of a tracked frame.

    Args:
        layout: the match.
        message: the frame, from `rsoccer.protocols.parsing.parse`.
        last: frame of one world with what the message lacks; None for `Frame.empty`, with robots
            that are absent.

    Returns:
        The state. Velocities that the message lacks are 0.

    Raises:
        ValueError: `last` is a frame of other teams.
    """
    tracked = Tracked.begin(layout, last, message.timestamp)
    for robot in message.robots:
        team = _TEAMS.get(robot.robot_id.team_color)
        if team is None:
            color = tracker_pb2.TeamColor.Name(robot.robot_id.team_color)
            text = f"team_color: expected blue or yellow, got {color}"
            tracked.problems.append(Problem(Code.UNKNOWN_TEAM, text))
            continue
        tracked.put_robot(
            layout,
            (team, robot.robot_id.id),
            (robot.pos.x, robot.pos.y, robot.orientation),
            (robot.vel.x, robot.vel.y, robot.vel_angular),
        )
    if message.balls:
        position, velocity = message.balls[0].pos, message.balls[0].vel
        tracked.put_ball(
            layout, (position.x, position.y, position.z), (velocity.x, velocity.y, velocity.z)
        )
    return tracked
