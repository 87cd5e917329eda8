"""From frames of vision or of a tracker to the state and its time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Final

import numpy as np

from rsoccer._core import ROBOT_COLUMNS, VisionTracker
from rsoccer.arrays import Floats, Mask
from rsoccer.drive.peers import Identity
from rsoccer.drive.vision_clock import VisionClock
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import fira, tracker, vision
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import MILLIMETERS, TEAMS, WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import fira_pb2, tracker_pb2, vision_pb2
from rsoccer.protocols.tracked import Tracked

ABSENT_SECONDS: Final = 0.5
"""Time without a sight after which a robot counts as absent, s."""
AROUND: Final = 3.0
"""Distance from the lines up to which bodies are believed, m."""
_ABSENT: Final = ROBOT_COLUMNS.index("absent")


class Sight(ABC):
    """What is seen of a match.

    Attributes:
        layout: sides and numbers on the wire.
        clock: time by the stamps of the frames.
        frames: frames so far, copies and those of no use too: a simulator that waits for its
            clients sends a frame again until it is answered.
        field_size: length and width of the field by the sender, m; None before it told them.
        has_ball: whether the ball was seen.
    """

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first frame.

        Args:
            layout: sides and numbers on the wire.
        """
        self.layout = layout
        self.clock = VisionClock()
        self.frames = 0
        self.field_size: tuple[float, float] | None = None
        self.has_ball = False
        self._stamp: float | None = None
        self._senders: set[int] = set()
        self._seen: dict[Identity, float] = {}

    @abstractmethod
    def take(self, data: bytes) -> bool:
        """Take in a datagram, and return whether the state is a newer one.

        Args:
            data: the bytes.

        Raises:
            MessageError: no message of the port.
        """

    @abstractmethod
    def read(self, out: Floats) -> None:
        """Write the newest state; robots out of sight are absent.

        Args:
            out: (1, row) output; touches, crossings and beams are those of a match that begins.
        """

    @abstractmethod
    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides.

        Args:
            layout: the match.
        """

    @property
    def in_sight(self) -> Mask:
        """(robots,) robots that were seen not long before the newest frame."""
        identities = (self.layout.identity(slot) for slot in range(self.layout.config.n_robots))
        return np.array([identity in self._recent for identity in identities], np.bool_)

    @property
    def strangers(self) -> list[Identity]:
        """Team and number, on the wire, of robots in sight that the match does not have."""
        known = {self.layout.identity(slot) for slot in range(self.layout.config.n_robots)}
        return sorted(self._recent - known)

    def numbers(self, team: int) -> list[int]:
        """Return the uniform numbers that are in sight.

        Args:
            team: `BLUE` or `YELLOW`, on the wire.
        """
        return sorted(number for color, number in self._recent if color == team)

    @property
    def _recent(self) -> set[Identity]:
        now = self.clock.now
        return {key for key, seen in self._seen.items() if now - seen <= ABSENT_SECONDS}

    def _is_near(self, places: Floats) -> Mask:
        """Places (k, 2) on the field or around it; others are mistakes of the sender."""
        field = self.layout.config.field
        limits = (field.length / 2 + AROUND, field.width / 2 + AROUND)
        near: Mask = (np.abs(places) <= limits).all(axis=1)
        return near

    def _time(self, stamp: float, sender: int = 0) -> tuple[float, bool] | None:
        """Time of a frame, and whether it has jumped; None for a frame that is of no use."""
        if stamp != self._stamp or sender in self._senders:
            self.frames += 1  # another frame, or a copy of this one
            self._senders.clear()
        self._stamp = stamp
        self._senders.add(sender)
        return self.clock.at(stamp)

    def _note(self, identities: Iterable[Identity], time: float) -> None:
        self._seen.update(dict.fromkeys(identities, time))


class DetectionSight(Sight):
    """Detections of SSL-Vision, filtered by the tracker of the senses."""

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first frame."""
        super().__init__(layout)
        self._tracker = VisionTracker(layout.config)

    def take(self, data: bytes) -> bool:
        """Take in a packet of a camera; see `Sight.take`."""
        message = parse(vision_pb2.Packet, data)
        if message.HasField("geometry"):
            size = message.geometry.field
            self.field_size = size.field_length / MILLIMETERS, size.field_width / MILLIMETERS
        if not message.HasField("detection"):
            return False
        detection = message.detection
        before = self.clock.now
        found = self._time(detection.t_capture, detection.camera_id)
        if found is None:
            return False
        time, jumped = found
        if jumped:
            self._tracker = VisionTracker(self.layout.config)
        seen = vision.to_detections(self.layout, detection)
        order = np.argsort(-seen.ball_confidence, kind="stable")
        with_heading = np.flatnonzero(seen.has_heading)
        robots = np.empty((len(with_heading), 5), np.float32)
        robots[:, 0] = np.array(seen.slots, np.float32)[with_heading]
        robots[:, 1:] = seen.robots[with_heading]
        balls = seen.balls[order, :2].astype(np.float32)
        near = [self._is_near(places) for places in (balls, robots[:, 1:3])]
        self._tracker.take(time, balls[near[0]], robots[near[1]])
        self.has_ball = self._tracker.has_ball
        groups = ((BLUE, detection.robots_blue), (YELLOW, detection.robots_yellow))
        self._note(
            ((team, r.robot_id) for team, group in groups for r in group if r.HasField("robot_id")),
            time,
        )
        return time > before or self.frames == 1

    def read(self, out: Floats) -> None:
        """Write the newest state; see `Sight.read`."""
        self._tracker.read(out)

    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides; see `Sight.turn`."""
        self.layout, self._tracker = layout, VisionTracker(layout.config)
        self.has_ball = False


class _StateSight(Sight):
    """Messages with positions and velocities."""

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first frame."""
        super().__init__(layout)
        self._frame = self._nothing()

    def _nothing(self) -> Frame:
        return Tracked.begin(self.layout, None, 0.0).frame

    def _keep(self, tracked: Tracked, identities: Iterable[Identity], time: float) -> None:
        self._frame = tracked.frame
        self.has_ball |= tracked.ball
        self._note(identities, time)

    def read(self, out: Floats) -> None:
        """Write the newest state; see `Sight.read`."""
        out[:] = self._frame.rows
        lost = ~self.in_sight
        robots = Frame(out, self._frame.n_blue, self._frame.n_yellow).robots.data
        robots[0, lost] = 0.0
        robots[0, lost, 2] = 1.0
        robots[0, lost, _ABSENT] = 1.0

    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides; see `Sight.turn`."""
        self.layout, self.has_ball = layout, False
        self._frame = self._nothing()


class TrackerSight(_StateSight):
    """Frames of the tracker that is heard first."""

    _source: str | None = None

    def take(self, data: bytes) -> bool:
        """Take in a packet of a tracker; see `Sight.take`."""
        message = parse(tracker_pb2.Packet, data)
        if not message.HasField("tracked_frame"):
            return False
        if self._source is None:
            self._source = message.uuid
        if message.uuid != self._source:
            name = message.source_name or message.uuid
            raise MessageError(Code.UNREADABLE, f"tracker: expected one source, got {name} too")
        before, frame = self.clock.now, message.tracked_frame
        found = self._time(frame.timestamp)
        if found is None:
            return False
        colors = {tracker_pb2.TEAM_COLOR_BLUE: BLUE, tracker_pb2.TEAM_COLOR_YELLOW: YELLOW}
        identities = [
            (colors[robot.robot_id.team_color], robot.robot_id.id)
            for robot in frame.robots
            if robot.robot_id.team_color in colors
        ]
        self._keep(tracker.to_frame(self.layout, frame, self._frame), identities, found[0])
        return found[0] > before or self.frames == 1


class FiraSight(_StateSight):
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
        identities = [
            (team, robot.robot_id)
            for team, group in zip(TEAMS, groups, strict=True)
            for robot in group
        ]
        self._keep(fira.read_environment(self.layout, message, self._frame), identities, found[0])
        return found[0] > before or self.frames == 1


def make_sight(layout: WireLayout, league: str, source: str) -> Sight:
    """Return what reads the frames of a connection.

    Args:
        layout: the match.
        league: "ssl" or "vsss".
        source: "vision" or "tracker".
    """
    if league == "vsss":
        return FiraSight(layout)
    return DetectionSight(layout) if source == "vision" else TrackerSight(layout)
