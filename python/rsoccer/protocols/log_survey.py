"""A first pass through a log: its time, teams, field and tracker."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import TEAMS
from rsoccer.protocols.logs import read_log
from rsoccer.protocols.protobuf import Message
from rsoccer.protocols.schemas import referee_pb2, tracker_pb2, vision_pb2

MIN_SHARE: Final = 0.01
"""Least share of the frames of a team's most seen robot in which a robot is: fewer are errors."""
_COLORS: Final = {tracker_pb2.TEAM_COLOR_BLUE: BLUE, tracker_pb2.TEAM_COLOR_YELLOW: YELLOW}


@dataclass
class Survey:
    """Contents of a log.

    Attributes:
        first: time of the first state, Unix time, s.
        last: time of the last one.
        trackers: tracked frames by identity of the tracker.
        detections: frames of cameras.
        unreadable: packets that could not be read.
        geometry: first geometry; None if there is none.
        names: last names of blue and of yellow; empty if there are none.
        is_cut_off: whether the file ends within a message.
        side: first side of the referee's packets, whether blue's goal is at +x; None without one.
    """

    first: float | None = None
    last: float = 0.0
    trackers: Counter[str] = field(default_factory=Counter)
    detections: int = 0
    unreadable: int = 0
    geometry: vision_pb2.Geometry | None = None
    names: tuple[str, str] = ("", "")
    side: bool | None = None
    is_cut_off: bool = False
    _tracked: Counter[tuple[str, int, int]] = field(default_factory=Counter)
    _detected: Counter[tuple[int, int]] = field(default_factory=Counter)

    @property
    def tracker(self) -> str | None:
        """Identity of the tracker that sent most; None if there is none."""
        return self.trackers.most_common(1)[0][0] if self.trackers else None

    def ids(self, team: int, most: int) -> tuple[int, ...]:
        """Return the uniform numbers of a team's robots, in their order.

        Args:
            team: `BLUE` or `YELLOW`.
            most: greatest number of robots; those that are seen most are taken.
        """
        seen: Counter[int] = Counter()
        if self.tracker is None:
            seen.update({number: n for (side, number), n in self._detected.items() if side == team})
        else:
            for (uuid, side, number), n in self._tracked.items():
                if uuid == self.tracker and side == team:
                    seen[number] = n
        ranked = sorted(seen.items(), key=lambda entry: (-entry[1], entry[0]))[:most]
        least = MIN_SHARE * ranked[0][1] if ranked else 0.0
        return tuple(sorted(number for number, n in ranked if n >= least))

    def add(self, message: Message, seconds: float) -> None:
        """Count a packet.

        Args:
            message: the packet.
            seconds: time at which it was received, s.
        """
        if isinstance(message, tracker_pb2.Packet) and message.HasField("tracked_frame"):
            self._extend(seconds)
            self.trackers[message.uuid] += 1
            for robot in message.tracked_frame.robots:
                team = _COLORS.get(robot.robot_id.team_color)
                if team is not None:
                    self._tracked[message.uuid, team, robot.robot_id.id] += 1
        elif isinstance(message, vision_pb2.Packet | vision_pb2.Packet2010):
            self._add_vision(message, seconds)
        elif isinstance(message, referee_pb2.Packet):
            self.names = (message.blue.name, message.yellow.name)
            if self.side is None and message.HasField("blue_team_on_positive_half"):
                self.side = message.blue_team_on_positive_half

    def _add_vision(
        self, message: vision_pb2.Packet | vision_pb2.Packet2010, seconds: float
    ) -> None:
        if isinstance(message, vision_pb2.Packet) and message.HasField("geometry"):
            self.geometry = self.geometry or message.geometry
        if not message.HasField("detection"):
            return
        self._extend(seconds)
        self.detections += 1
        groups = (message.detection.robots_blue, message.detection.robots_yellow)
        for team, group in zip(TEAMS, groups, strict=True):
            self._detected.update((team, robot.robot_id) for robot in group)

    def _extend(self, seconds: float) -> None:
        self.first = seconds if self.first is None else min(self.first, seconds)
        self.last = max(self.last, seconds)


def messages(path: Path | str, survey: Survey | None = None) -> Iterator[tuple[float, Message]]:
    """Yield the times and packets of a log that can be read.

    A log that is cut off ends where it is.

    Args:
        path: the log.
        survey: takes note of the others, and of a log that is cut off; None for nothing.

    Raises:
        FileNotFoundError: no such file.
        MessageError: the file is no log, or is damaged.
    """
    survey = Survey() if survey is None else survey
    try:
        for entry in read_log(path):
            try:
                message = entry.message()
            except MessageError:
                survey.unreadable += 1
                continue
            if message is not None:
                yield entry.seconds, message
    except MessageError as error:
        if error.code is not Code.CUT_OFF:
            raise
        survey.is_cut_off = True


def survey_log(path: Path | str) -> Survey:
    """Return what a log contains.

    Args:
        path: the log.

    Raises:
        FileNotFoundError: no such file.
        MessageError: the file is no log, is damaged, or has neither tracked frames nor detections.
    """
    survey = Survey()
    for seconds, message in messages(path, survey):
        survey.add(message, seconds)
    if survey.first is None:
        raise MessageError(Code.BAD_LOG, "log: expected tracked frames or detections, got none")
    return survey
