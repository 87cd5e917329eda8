"""Packets of a tracker from what senses estimate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from rsoccer._core import ROBOT_COLUMNS
from rsoccer.bridge.message_rows import MessageRows, field_of
from rsoccer.frame import Frame
from rsoccer.game import BLUE
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import tracker_pb2

SOURCE_NAME: Final = "rSoccer"
"""Name of the sender."""
_ABSENT: Final = ROBOT_COLUMNS.index("absent")
_NUMBERS: Final = np.array([0, 1, 2, 4, 5, 6])
"""Columns of a robot that are numbers of its message; the third is replaced by the angle."""
_FRAME: Final = tracker_pb2.Packet.TRACKED_FRAME_FIELD_NUMBER


class TrackerPackets:
    """Makes the packets of the tracker of a match."""

    def __init__(self, layout: WireLayout, epoch: float, uuid: str) -> None:
        """Prepare what does not change.

        Args:
            layout: the match.
            epoch: time of the start of the simulation, Unix time, s.
            uuid: identity of the sender.
        """
        self._layout, self._epoch = layout, epoch
        self._rows = MessageRows(layout.config.n_robots, 6, self._template)
        # `tracked_frame` is required: that of the packet is appended.
        wrapper = tracker_pb2.Packet(uuid=uuid, source_name=SOURCE_NAME)
        self._wrapper = wrapper.SerializePartialToString()

    def _template(self, slot: int, numbers: Sequence[float]) -> tracker_pb2.TrackedFrame:
        """The message of a robot with numbers x, y, angle and their rates."""
        team, number = self._layout.identity(slot)
        frame = tracker_pb2.TrackedFrame()
        x, y, angle, v_x, v_y, turning = numbers
        robot = frame.robots.add(orientation=angle, vel_angular=turning, visibility=1.0)
        robot.robot_id.id = number
        robot.robot_id.team_color = (
            tracker_pb2.TEAM_COLOR_BLUE if team == BLUE else tracker_pb2.TEAM_COLOR_YELLOW
        )
        robot.pos.x, robot.pos.y = x, y
        robot.vel.x, robot.vel.y = v_x, v_y
        return frame

    def of(self, frame: Frame, number: int, seconds: float) -> bytes:
        """Return the packet of a state.

        Args:
            frame: what the tracker estimates, frame of one world.
            number: number of the frame.
            seconds: simulated time of the state, s.
        """
        sign = self._layout.sign
        message = tracker_pb2.TrackedFrame(
            frame_number=number % 2**32, timestamp=self._epoch + seconds
        )
        message.capabilities.append(tracker_pb2.CAPABILITY_DETECT_FLYING_BALLS)
        seen = message.balls.add(visibility=1.0)
        x, y, z, v_x, v_y, v_z = frame.ball.data[0, :6].tolist()
        place, velocity = seen.pos, seen.vel
        place.x, place.y, place.z = sign * x, sign * y, z
        velocity.x, velocity.y, velocity.z = sign * v_x, sign * v_y, v_z
        # Position, heading, velocity and angular velocity are the first columns of a robot.
        robots = frame.robots.data[0]
        (slots,) = (robots[:, _ABSENT] == 0).nonzero()
        columns = robots[:, :7].take(slots, axis=0).astype(np.float64)
        columns[:, :6] *= sign
        numbers = columns.take(_NUMBERS, axis=1)
        np.arctan2(columns[:, 3], columns[:, 2], out=numbers[:, 2])
        content = message.SerializeToString() + self._rows.write(slots, numbers)
        packet: bytes = self._wrapper + field_of(_FRAME, content)
        return packet
