"""Fast reading of common messages to a team's port, and fast answers.

Messages that command known robots with local velocities are most of all. `read` takes these, with
a check of all numbers at once, and leaves every other one, and all errors, to
`rsoccer.protocols.robot_control`. Both give the same commands; a test compares them.
"""

from __future__ import annotations

import contextlib
import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rsoccer.arrays import Floats, Mask
from rsoccer.bridge.message_template import MessageTemplate
from rsoccer.frame import Frame
from rsoccer.protocols.commands import FULL_DRIBBLER_RPM, MAX_KICK_ANGLE
from rsoccer.protocols.layout import TEAMS, WireLayout
from rsoccer.protocols.parsing import MAX_MAGNITUDE
from rsoccer.protocols.protobuf import DecodeError
from rsoccer.protocols.schemas import simulation_pb2

_COLUMNS = ("v_x", "v_y", "v_theta", "kick_v_x", "kick_v_z", "dribbler")
_MAX_ANSWERS = 4096
_MAX_KINDS = 256
_MAX_FAILURES = 16
_HEAD = 4  # bytes of a message up to the number of its first robot


class CommonCommands(NamedTuple):
    """Commands of a common message."""

    commands: Floats
    """(robots, command) commands of all robots, in the order of a state row."""
    given: Mask
    """(robots,) robots that the message has."""
    moved: Mask
    """(robots,) robots whose velocity it has."""


@dataclass
class _Kind:
    """Messages of a team with the same length and the same first robot."""

    template: MessageTemplate | None = None
    uses: int = 0
    """messages that the template has read"""
    failures: int = 0
    """messages after the first that were read field by field"""


class ControlReader:
    """Reads messages to the teams' ports of a match."""

    def __init__(self, layout: WireLayout) -> None:
        """Prepare what does not change.

        Args:
            layout: the match.
        """
        config = layout.config
        self._layout = layout
        self._is_usable = config.command_columns == _COLUMNS and all(
            model.drive == "omni" and model.command_columns == _COLUMNS for model in config.robots
        )
        self._slots = [
            {layout.identity(slot)[1]: slot for slot in layout.slots(team)} for team in TEAMS
        ]
        self._robots = config.n_robots
        self._answers: dict[tuple[int, bytes, bytes], bytes] = {}
        self._kinds: dict[tuple[int, int, bytes], _Kind] = {}

    def read(self, data: bytes, team: int, previous: Floats) -> CommonCommands | None:
        """Return what a message has; None if it is not a common one.

        Args:
            data: the bytes.
            team: `BLUE` or `YELLOW`.
            previous: (robots, command) commands that hold where the message has no field.
        """
        if not self._is_usable:
            return None
        kind = self._kinds.get(_kind(data, team))
        template = None if kind is None else kind.template
        commands = None if template is None else template.read(data, previous)
        if kind is not None and template is not None and commands is not None:
            kind.uses += 1
            return CommonCommands(commands, template.given, template.moved)
        return self._read_fields(data, team, previous)

    def _read_fields(self, data: bytes, team: int, previous: Floats) -> CommonCommands | None:
        """Read a message field by field."""
        message = _parsed(data)
        if message is None:
            return None
        rows: list[list[float]] = previous.tolist()
        slots, known = [], self._slots[team]
        moved = np.zeros(self._robots, np.bool_)
        for command in message.robot_commands:
            slot = known.get(command.id)
            if slot is None or not _put(command, rows[slot]):
                return None
            slots.append(slot)
            moved[slot] = command.HasField("move_command")
        if len(set(slots)) != len(slots):
            return None
        numbers = np.array(rows)
        if not (np.abs(numbers) < MAX_MAGNITUDE).all():  # refuses NaN too
            return None
        given = np.zeros(self._robots, np.bool_)
        given[slots] = True
        self._learn(message, data, team)
        return CommonCommands(numbers.astype(np.float32), given, moved)

    def _learn(self, message: simulation_pb2.RobotControl, data: bytes, team: int) -> None:
        """Keep the template of a message whose kind comes again, as clients repeat theirs.

        Kinds that templates do not fit, as of other encoders and of messages that differ in more
        than numbers, are read field by field from then on.
        """
        kind = _kind(data, team)
        if kind not in self._kinds:
            if len(self._kinds) >= _MAX_KINDS:
                self._kinds.clear()
            self._kinds[kind] = _Kind()
            return
        known = self._kinds[kind]
        if known.template is None and known.failures < _MAX_FAILURES:
            with contextlib.suppress(ValueError):
                known.template = MessageTemplate(message, data, self._slots[team], self._robots)
        known.failures += 1
        if known.failures >= _MAX_FAILURES and known.failures > known.uses:
            known.template = None

    def answer(self, frame: Frame, team: int, given: Mask) -> bytes:
        """Return the answer to a message without errors.

        Args:
            frame: what robots report, frame of one world.
            team: `BLUE` or `YELLOW`.
            given: (robots,) robots to tell about; if none, all of the team on the field.
        """
        reported = given if np.count_nonzero(given) else frame.robots.absent[0] == 0
        contact = frame.robots.infrared[0] > 0
        key = team, reported.tobytes(), contact.tobytes()
        answer = self._answers.get(key)
        if answer is None:
            message = simulation_pb2.RobotControlResponse()
            for slot in self._layout.slots(team):
                if reported[slot]:
                    message.feedback.add(
                        id=self._layout.identity(slot)[1],
                        dribbler_ball_contact=bool(contact[slot]),
                    )
            answer = message.SerializeToString()
            if len(self._answers) >= _MAX_ANSWERS:
                self._answers.clear()
            self._answers[key] = answer
        return answer


def _kind(data: bytes, team: int) -> tuple[int, int, bytes]:
    """Kind of a message, the same for those of a client that differ in numbers alone."""
    return team, len(data), data[:_HEAD]


def _parsed(data: bytes) -> simulation_pb2.RobotControl | None:
    """The message in some bytes; None if they are none, or lack a field."""
    message = simulation_pb2.RobotControl()
    try:
        message.ParseFromString(data)
    except (DecodeError, RecursionError, UnicodeDecodeError, ValueError):
        return None
    return message if message.IsInitialized() else None


def _put(command: simulation_pb2.RobotCommand, row: list[float]) -> bool:
    """Put a command into its columns. Return whether it is a common one."""
    row[3] = row[4] = 0.0  # a kick holds until the robot's next command
    if command.HasField("move_command"):
        move = command.move_command
        if not move.HasField("local_velocity"):
            return False
        local = move.local_velocity
        row[:3] = local.forward, local.left, local.angular
    if command.HasField("kick_speed") or command.HasField("kick_angle"):
        speed, angle = command.kick_speed, command.kick_angle
        # Of a message whose numbers are not finite, nothing is used: `not` refuses NaN too.
        if not (0.0 <= speed < MAX_MAGNITUDE and 0.0 <= angle <= MAX_KICK_ANGLE):
            return False
        row[3] = speed * math.cos(math.radians(angle)) if angle else speed
        row[4] = speed * math.sin(math.radians(angle)) if angle else 0.0
    if command.HasField("dribbler_speed"):
        share = command.dribbler_speed / FULL_DRIBBLER_RPM
        if not 0.0 <= share < MAX_MAGNITUDE / FULL_DRIBBLER_RPM:
            return False
        row[5] = min(share, 1.0)
    return True
