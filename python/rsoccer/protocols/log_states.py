"""States in the course of a log, from tracked frames or from what cameras saw last."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Floats
from rsoccer.frame import Frame
from rsoccer.protocols import tracker, vision
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.protobuf import Message
from rsoccer.protocols.schemas import tracker_pb2, vision_pb2

ABSENT_SECONDS: Final = 0.5
"""Time without a sight after which a robot counts as absent, s."""


class LogStates:
    """The newest state, which packets of a log bring up to date."""

    def __init__(self, layout: WireLayout, source: str | None) -> None:
        """Begin without any body in sight.

        Args:
            layout: the match; its side may change with the packets of the referee.
            source: identity of the tracker to follow; None for what cameras saw.
        """
        config = layout.config
        self._source = source
        self._frame = Frame.empty(1, config.n_blue, config.n_yellow)
        self._seen_at = np.full(config.n_robots, -np.inf)

    def add(self, layout: WireLayout, message: Message, seconds: float) -> None:
        """Bring the state up to date.

        Args:
            layout: the match, with the present side.
            message: a packet; others than those of the source are ignored.
            seconds: time at which it was received, s.
        """
        if self._source is None:
            if isinstance(message, vision_pb2.Packet | vision_pb2.Packet2010):
                self._add_detections(layout, message.detection, seconds)
        elif isinstance(message, tracker_pb2.Packet) and message.uuid == self._source:
            tracked = tracker.to_frame(layout, message.tracked_frame, self._frame)
            self._frame = tracked.frame
            self._seen_at[tracked.seen] = seconds

    def _add_detections(
        self, layout: WireLayout, message: vision_pb2.DetectionFrame, seconds: float
    ) -> None:
        seen, robots = vision.to_detections(layout, message), self._frame.robots
        slots = list(seen.slots)
        robots.position[0, slots] = seen.robots[:, :2]
        with_heading = [slot for slot, has in zip(slots, seen.has_heading, strict=True) if has]
        robots.heading[0, with_heading] = seen.robots[seen.has_heading, 2:]
        self._seen_at[slots] = seconds
        if len(seen.balls):
            ball = seen.balls[int(np.argmax(seen.ball_confidence))]
            self._frame.ball.position[0] = ball[:2]
            self._frame.ball.height[0] = max(0.0, float(ball[2]))

    def row(self, seconds: float) -> Floats:
        """Return the state at a time, with robots that were not seen for long as absent.

        Args:
            seconds: the time, s.
        """
        frame = self._frame.copy()
        absent = seconds - self._seen_at > ABSENT_SECONDS
        frame.robots.data[0, absent] = 0.0
        frame.robots.heading[0, absent] = (1.0, 0.0)
        frame.robots.absent[0, absent] = 1.0
        frame.robots.absent[0, ~absent] = 0.0
        row: Floats = frame.rows[0]
        return row


def add_velocities(frame: Frame, time_step: float) -> None:
    """Set velocities from the positions of successive frames, as detections have none.

    Args:
        frame: frame of successive states, changed in place. A body that has just come into sight
            rests.
        time_step: time between them, s.
    """
    ball, robots = frame.ball, frame.robots
    ball.velocity[1:] = np.diff(ball.position, axis=0) / time_step
    ball.vertical_velocity[1:] = np.diff(ball.height) / time_step
    there = (robots.absent[1:] == 0) & (robots.absent[:-1] == 0)
    robots.velocity[1:] = there[..., None] * np.diff(robots.position, axis=0) / time_step
    angles: Doubles = np.arctan2(robots.heading[..., 1], robots.heading[..., 0])
    turned = (np.diff(angles, axis=0) + np.pi) % (2 * np.pi) - np.pi
    robots.angular_velocity[1:] = there * turned / time_step
