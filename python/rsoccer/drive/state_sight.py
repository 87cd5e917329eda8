"""Sight by messages that have positions and velocities: those of trackers and of FIRASim."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from typing import Final

import numpy as np

from rsoccer._core import ROBOT_COLUMNS
from rsoccer.arrays import Floats, Mask
from rsoccer.drive.sight import FAR_BALLS, FAR_ROBOTS, DetectionSight, Named, Sight
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import fira, tracker
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import TEAMS, WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import fira_pb2, tracker_pb2
from rsoccer.protocols.tracked import Tracked

SILENT_SECONDS: Final = 0.5
"""Time without a packet of a tracker after which another one is taken, s, as trackers that start
again have another name."""
_ABSENT: Final = ROBOT_COLUMNS.index("absent")


class StateSight(Sight):
    """Messages with positions and velocities."""

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first frame.

        Args:
            layout: sides and numbers on the wire.
        """
        super().__init__(layout)
        self._frame = self._nothing()

    def note_commands(self, time: float, commands: Floats, driven: Mask) -> None:
        """Ignore commands: messages have velocities; see `Sight.note_commands`."""

    def _nothing(self) -> Frame:
        return Tracked.begin(self.layout, None, 0.0).frame

    def _keep(self, tracked: Tracked, named: Iterable[Named], time: float) -> None:
        """Keep a state; bodies that are not believed stay as they were."""
        frame, last = tracked.frame, self._frame
        near = self._is_near(frame.robots.position[0])
        far, ball = tracked.seen & ~near, tracked.ball
        frame.robots.data[0, far] = last.robots.data[0, far]
        self._count(FAR_ROBOTS, int(far.sum()))
        if ball and not self._is_near(frame.ball.position)[0]:
            frame.ball.data[:] = last.ball.data
            self._count(FAR_BALLS, 1)
            ball = False
        self._frame = frame
        self.has_ball |= ball
        self._note(named, np.flatnonzero(tracked.seen & near).tolist(), time)

    def read(self, out: Floats, robots: Sequence[int] | None = None) -> None:
        """Write the newest state; see `Sight.read`."""
        out[:] = self._frame.rows
        lost = ~self.in_sight
        columns = Frame(out, self._frame.n_blue, self._frame.n_yellow).robots.data
        columns[0, lost] = 0.0
        columns[0, lost, 2] = 1.0
        columns[0, lost, _ABSENT] = 1.0

    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides; see `Sight.turn`."""
        self.layout, self.has_ball = layout, False
        self._frame = self._nothing()

    def suppose_ball(self, position: tuple[float, float]) -> None:
        """Take the ball to lie at a place until it is seen; see `Sight.suppose_ball`."""
        self._frame.ball.position[0] = position
        self.has_ball = True


class TrackerSight(StateSight):
    """Frames of one tracker: the one that is heard first, and another once it is silent."""

    def __init__(self, layout: WireLayout, clock: Callable[[], float] = time.monotonic) -> None:
        """Begin before the first frame.

        Args:
            layout: sides and numbers on the wire.
            clock: time on the wall, s.
        """
        super().__init__(layout)
        self._clock = clock
        self._source: str | None = None
        self._heard_at = -math.inf

    def take(self, data: bytes) -> bool:
        """Take in a packet of a tracker; see `Sight.take`."""
        message = parse(tracker_pb2.Packet, data)
        if not message.HasField("tracked_frame"):
            return False
        wall = self._clock()
        if message.uuid != self._source:
            if wall - self._heard_at <= SILENT_SECONDS:
                name = message.source_name or message.uuid
                raise MessageError(Code.UNREADABLE, f"tracker: expected one source, got {name} too")
            self._count("tracker: another source", int(self._source is not None))
            self._source = message.uuid
        self._heard_at = wall
        before, frame = self.clock.now, message.tracked_frame
        found = self._time(frame.timestamp)
        if found is None:
            return False
        colors = {tracker_pb2.TEAM_COLOR_BLUE: BLUE, tracker_pb2.TEAM_COLOR_YELLOW: YELLOW}
        named = [
            ((colors[robot.robot_id.team_color], robot.robot_id.id), (robot.pos.x, robot.pos.y))
            for robot in frame.robots
            if robot.robot_id.team_color in colors
        ]
        self._keep(tracker.to_frame(self.layout, frame, self._frame), named, found[0])
        return found[0] > before or self.frames == 1


class FiraSight(StateSight):
    """FIRASim's environment."""

    def take(self, data: bytes) -> bool:
        """Take in a packet; see `Sight.take`."""
        message = parse(fira_pb2.Environment, data)
        if not message.HasField("frame"):
            return False
        if message.field.length > 0:
            self.field_size = message.field.length, message.field.width
        before = self.clock.now
        found = self._time(message.step / fira.MILLISECONDS)
        if found is None:
            return False
        groups = (message.frame.robots_blue, message.frame.robots_yellow)
        named = [
            ((team, robot.robot_id), (robot.x, robot.y))
            for team, group in zip(TEAMS, groups, strict=True)
            for robot in group
        ]
        self._keep(fira.read_environment(self.layout, message, self._frame), named, found[0])
        return found[0] > before or self.frames == 1


def make_sight(
    layout: WireLayout, league: str, source: str, clock: Callable[[], float] = time.monotonic
) -> Sight:
    """Return what reads the frames of a connection.

    Args:
        layout: the match.
        league: "ssl" or "vsss".
        source: "vision" or "tracker".
        clock: time on the wall, s.
    """
    if league == "vsss":
        return FiraSight(layout)
    return DetectionSight(layout) if source == "vision" else TrackerSight(layout, clock)
