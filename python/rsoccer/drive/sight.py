"""From frames of vision to the state and its time."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Final

import numpy as np

from rsoccer._core import VisionTracker
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.drive.peers import Identity
from rsoccer.drive.vision_clock import VisionClock
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import vision
from rsoccer.protocols.layout import MILLIMETERS, WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import vision_pb2

Named = tuple[Identity, tuple[float, float]]
"""A robot as a message names it, and its place on the wire, m."""
CAMERAS: Final = 256
"""Number of cameras that a tracker tells apart."""
ABSENT_SECONDS: Final = 0.5
"""Time without a sight after which a robot counts as absent, s."""
AROUND: Final = 3.0
"""Distance from the lines up to which bodies are believed, m."""
FAR_ROBOTS: Final = "robots: far off the field"
"""Reason to ignore robots, by which they are counted."""
FAR_BALLS: Final = "balls: far off the field"
"""Reason to ignore balls, by which they are counted."""
OLDER_FRAMES: Final = "frames: older than the last one"
"""Reason to ignore frames, by which they are counted."""
UNCONFIRMED_FRAMES: Final = "frames: of another time"
"""Reason to ignore frames whose stamps no others confirm, by which they are counted."""


class Sight(ABC):
    """Sight of a match.

    Attributes:
        layout: sides and numbers on the wire.
        clock: time by the stamps of the frames.
        frames: frames so far, copies and those of no use too: a simulator that waits for its
            clients sends a frame again until it is answered.
        field_size: length and width of the field by the sender, m; None before they are known.
        has_ball: whether the ball was seen.
        cut: indices in a state row of the robots whose break beam is cut, as they report; None
            where they report nothing.
        counts: numbers of bodies and frames that are ignored, by the reason, such as
            "robots: far off the field".
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
        self.cut: list[int] | None = None
        self.counts: Counter[str] = Counter()
        self._stamp: float | None = None
        self._senders: set[int] = set()
        self._seen: dict[Identity, float] = {}
        self._places: dict[Identity, tuple[float, float]] = {}  # of strangers, on the wire, m

    @abstractmethod
    def take(self, data: bytes) -> bool:
        """Take in a datagram.

        Args:
            data: the bytes.

        Returns:
            True if the state is a newer one.

        Raises:
            ValueError: no message of the port, a `MessageError`.
        """

    @abstractmethod
    def read(self, out: Floats, robots: Sequence[int] | None = None) -> None:
        """Write the newest state; robots out of sight are absent.

        Args:
            out: (1, row) output; touches, crossings and beams are those of a match that begins.
            robots: robots whose commands tell where they are between frames; None for all whose
                commands were noted.
        """

    @abstractmethod
    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides.

        Args:
            layout: the match.
        """

    @abstractmethod
    def suppose_ball(self, position: tuple[float, float]) -> None:
        """Take the ball to lie at a place until it is seen.

        Args:
            position: the place in the package, m.
        """

    @abstractmethod
    def note_commands(self, time: float, commands: Floats, driven: Mask) -> None:
        """Take note of commands, which tell where robots are between frames.

        Args:
            time: time at which they were sent, by the clock of the frames, s.
            commands: (robots, command) commands.
            driven: (robots,) robots to which they were sent.
        """

    @property
    def in_sight(self) -> Mask:
        """(robots,) robots that were seen, and believed, not long before the newest frame."""
        return np.array([identity in self._recent for identity in self._identities], np.bool_)

    @property
    def strangers(self) -> list[Identity]:
        """Team and number, on the wire, of robots in sight that the match does not have."""
        return sorted(self._recent - set(self._identities))

    @property
    def stranger_places(self) -> Doubles:
        """(k, 2) places of the `strangers` in the package, m."""
        places = [self._places[identity] for identity in self.strangers]
        return self.layout.rotated(np.array(places, np.float64).reshape(-1, 2))

    @property
    def _identities(self) -> list[Identity]:
        """Team and number, on the wire, of the robots of the match, by slot."""
        return [self.layout.identity(slot) for slot in range(self.layout.config.n_robots)]

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
        near: Mask = np.all(np.abs(places) <= limits, axis=1)
        return near

    def _time(self, stamp: float, sender: int = 0) -> tuple[float, bool] | None:
        """Time of a frame, and whether it has jumped; None for a frame that is of no use."""
        if stamp != self._stamp or sender in self._senders:
            self.frames += 1  # another frame, or a copy of this one
            self._senders.clear()
        self._stamp = stamp
        self._senders.add(sender)
        older = self.clock.older
        found = self.clock.at(stamp, sender)
        if found is None:
            self._count(OLDER_FRAMES if self.clock.older > older else UNCONFIRMED_FRAMES, 1)
        return found

    def _note(self, named: Iterable[Named], slots: Iterable[int], time: float) -> None:
        """Note robots of others as they are named, and those of the match that are believed."""
        known = self._identities
        strangers = {identity: place for identity, place in named if identity not in known}
        self._places.update(strangers)
        believed = [self.layout.identity(slot) for slot in slots]
        self._seen.update(dict.fromkeys([*strangers, *believed], time))

    def _count(self, reason: str, number: int) -> None:
        if number:
            self.counts[reason] += number


class DetectionSight(Sight):
    """Detections of SSL-Vision, filtered by the tracker of the senses."""

    def __init__(self, layout: WireLayout) -> None:
        """Begin before the first frame.

        Args:
            layout: sides and numbers on the wire.
        """
        super().__init__(layout)
        self._tracker = VisionTracker(layout.config)

    def take(self, data: bytes) -> bool:
        """Take in a packet of a camera; see `Sight.take`."""
        message = parse(vision_pb2.Packet, data)
        if message.HasField("geometry"):
            size = message.geometry.field
            if min(size.field_length, size.field_width) > 0:
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
        self._count("robots: without orientation", int((~seen.has_heading).sum()))
        self._count(FAR_ROBOTS, int((~near[1]).sum()))
        self._count(FAR_BALLS, int((~near[0]).sum()))
        balls, robots = balls[near[0]], robots[near[1]]
        self._tracker.take(time, balls, robots, self.cut, detection.camera_id % CAMERAS)
        self.has_ball = self._tracker.has_ball
        groups = ((BLUE, detection.robots_blue), (YELLOW, detection.robots_yellow))
        self._note(
            (
                ((team, robot.robot_id), (robot.x / MILLIMETERS, robot.y / MILLIMETERS))
                for team, group in groups
                for robot in group
                if robot.HasField("robot_id")
            ),
            robots[:, 0].astype(np.intp).tolist(),
            time,
        )
        return time > before or self.frames == 1

    def read(self, out: Floats, robots: Sequence[int] | None = None) -> None:
        """Write the newest state; see `Sight.read`."""
        self._tracker.read(out, None if robots is None else list(robots))

    def note_commands(self, time: float, commands: Floats, driven: Mask) -> None:
        """Take note of commands; see `Sight.note_commands`."""
        self._tracker.send(time, commands, np.flatnonzero(driven).tolist())

    def turn(self, layout: WireLayout) -> None:
        """Go on with other sides; see `Sight.turn`."""
        self.layout, self._tracker = layout, VisionTracker(layout.config)
        self.has_ball = False

    def suppose_ball(self, position: tuple[float, float]) -> None:
        """Take the ball to lie at a place until it is seen; see `Sight.suppose_ball`."""
        nothing = np.empty((0, 5), np.float32)
        self._tracker.take(self.clock.now, np.array([position], np.float32), nothing)
        self.has_ball = self._tracker.has_ball
