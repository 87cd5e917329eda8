"""Packets of trackers: from a state to filtered positions and velocities, and back."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from rsoccer.arrays import Mask
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, MessageError, Problem
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import tracker_pb2

_COLORS: Final = {BLUE: tracker_pb2.TEAM_COLOR_BLUE, YELLOW: tracker_pb2.TEAM_COLOR_YELLOW}
_TEAMS: Final = {color: team for team, color in _COLORS.items()}


class Tracked(NamedTuple):
    """A tracked frame as a state."""

    frame: Frame
    """Frame of one world: bodies that the message lacks are as they were given."""
    timestamp: float
    """Time of the state, Unix time, s."""
    seen: Mask
    """(robots,) robots that the message has."""
    ball: bool
    """Whether the message has the ball."""
    problems: tuple[Problem, ...]
    """Robots that are left out."""


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
    config = layout.config
    if last is None:
        frame = Frame.empty(1, config.n_blue, config.n_yellow)
        frame.robots.absent[:] = 1.0
    else:
        layout.check_frame(last, 0)
        frame = last.take(np.zeros(1, np.intp))
    seen, problems = np.zeros(config.n_robots, np.bool_), []
    for robot in message.robots:
        try:
            slot = _slot(layout, robot.robot_id)
        except MessageError as error:
            problems.append(Problem(error.code, str(error)))
            continue
        _put_robot(layout, frame, slot, robot)
        seen[slot] = True
    if message.balls:
        _put_ball(layout, frame, message.balls[0])
    return Tracked(frame, message.timestamp, seen, bool(message.balls), tuple(problems))


def _slot(layout: WireLayout, identity: tracker_pb2.RobotId) -> int:
    team = _TEAMS.get(identity.team_color)
    if team is None:
        raise MessageError(
            Code.UNKNOWN_TEAM, f"team_color: expected blue or yellow, got {identity.team_color}"
        )
    return layout.slot(team, identity.id)


def _put_robot(
    layout: WireLayout, frame: Frame, slot: int, robot: tracker_pb2.TrackedRobot
) -> None:
    robots = frame.robots
    robots.data[0, slot] = 0.0
    robots.position[0, slot] = layout.rotated(np.array([robot.pos.x, robot.pos.y]))
    robots.heading[0, slot] = layout.heading_from_wire(robot.orientation)
    robots.velocity[0, slot] = layout.rotated(np.array([robot.vel.x, robot.vel.y]))
    robots.angular_velocity[0, slot] = robot.vel_angular


def _put_ball(layout: WireLayout, frame: Frame, ball: tracker_pb2.TrackedBall) -> None:
    frame.ball.position[0] = layout.rotated(np.array([ball.pos.x, ball.pos.y]))
    frame.ball.height[0] = max(0.0, ball.pos.z)
    frame.ball.velocity[0] = layout.rotated(np.array([ball.vel.x, ball.vel.y]))
    frame.ball.vertical_velocity[0] = ball.vel.z
