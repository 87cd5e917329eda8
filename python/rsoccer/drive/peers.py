"""Simulators and robots on the network: messages that command robots and put bodies."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from typing import Final, NamedTuple

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import answers, fira, grsim, robot_control, simulator_control
from rsoccer.protocols.layout import TEAM_NAMES, WireLayout
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import simulation_pb2

Identity = tuple[int, int]
"""Team and uniform number on the wire."""
OUTSIDE: Final[Mapping[str, float]] = {"grsim": 2.0, "firasim": 0.5}
"""Distance from the side line to robots that do not play, m, by the protocol. grSim and FIRASim
turn them off, which leaves them where they are, in the way of the others."""
_FIRST, _APART = 0.3, 0.25  # distances from the middle line and from each other, m


class Message(NamedTuple):
    """Bytes for a port."""

    port: str
    """Name of the port."""
    data: bytes
    """The bytes."""


class Answer(NamedTuple):
    """Answer of a simulator to commands."""

    errors: list[tuple[str, str]]
    """Codes and texts of errors."""
    reported: Mask
    """(robots,) robots whose break beam is known."""
    contact: Mask
    """(robots,) robots whose break beam is cut."""


class Peer(ABC):
    """A simulator or robots.

    Attributes:
        kick_pause: least time between two commands of a robot that kick, s.
    """

    kick_pause = 0.0

    @abstractmethod
    def commands(self, layout: WireLayout, commands: Floats, team: int) -> list[Message]:
        """Return the messages that give a team's robots their commands.

        Args:
            layout: the match.
            commands: (robots, command) commands of all robots, finite.
            team: `BLUE` or `YELLOW`, on the wire.
        """

    @abstractmethod
    def placement(
        self, layout: WireLayout, frame: Frame, strangers: Iterable[Identity]
    ) -> list[Message]:
        """Return the messages that put all bodies.

        Args:
            layout: the match.
            frame: frame of one world.
            strangers: robots that vision shows and the match does not have; taken away.
        """

    @abstractmethod
    def ball_placement(self, layout: WireLayout, frame: Frame) -> list[Message]:
        """Return the messages that put the ball alone.

        Args:
            layout: the match.
            frame: frame of one world.
        """

    def answer(self, layout: WireLayout, port: str, data: bytes) -> Answer | None:
        """Return what an answer tells; None for a port without answers.

        Args:
            layout: the match.
            port: name of the port to which the message went.
            data: the bytes.

        Raises:
            ValueError: the bytes are no answer, a `MessageError`.
        """
        return None


class GrSim(Peer):
    """grSim's own packets.

    It kicks with every packet, also a ball that it has kicked since its last tick of 1/60 s: .2 of
    the speed of this one is taken off (`KickerDampFactor`).
    """

    kick_pause = 0.02  # between one and two ticks

    def commands(self, layout: WireLayout, commands: Floats, team: int) -> list[Message]:
        """Return the messages that give a team's robots their commands; see `Peer.commands`."""
        packet = grsim.to_commands(layout, commands, team)
        return [Message("grsim", packet.SerializeToString())]

    def placement(
        self, layout: WireLayout, frame: Frame, strangers: Iterable[Identity]
    ) -> list[Message]:
        """Return the messages that put all bodies; see `Peer.placement`."""
        packet = grsim.to_replacement(layout, frame)
        for team, number in strangers:
            packet.replacement.robots.add(id=number, yellowteam=team == YELLOW, turnon=False)
        for robot in packet.replacement.robots:
            if not robot.turnon:
                robot.x, robot.y = _outside(layout, "grsim", robot.yellowteam, robot.id)
                robot.dir = 90.0
        return [Message("grsim", packet.SerializeToString())]

    def ball_placement(self, layout: WireLayout, frame: Frame) -> list[Message]:
        """Return the messages that put the ball alone; see `Peer.ball_placement`."""
        nobody = np.zeros(layout.config.n_robots, np.bool_)
        packet = grsim.to_replacement(layout, frame, robots=nobody)
        return [Message("grsim", packet.SerializeToString())]


class SslSimulation(Peer):
    """The simulation protocol of the SSL."""

    def commands(self, layout: WireLayout, commands: Floats, team: int) -> list[Message]:
        """Return the messages that give a team's robots their commands; see `Peer.commands`."""
        message = robot_control.to_robot_control(layout, commands, team)
        return [Message(TEAM_NAMES[team], message.SerializeToString())]

    def placement(
        self, layout: WireLayout, frame: Frame, strangers: Iterable[Identity]
    ) -> list[Message]:
        """Return the messages that put all bodies; see `Peer.placement`."""
        message = simulator_control.to_command(layout, frame, removed=strangers)
        return [Message("control", message.SerializeToString())]

    def ball_placement(self, layout: WireLayout, frame: Frame) -> list[Message]:
        """Return the messages that put the ball alone; see `Peer.ball_placement`."""
        message = simulator_control.to_command(layout, frame)
        message.control.ClearField("teleport_robot")
        return [Message("control", message.SerializeToString())]

    def answer(self, layout: WireLayout, port: str, data: bytes) -> Answer | None:
        """Return what an answer tells; see `Peer.answer`."""
        nobody = np.zeros(layout.config.n_robots, np.bool_)
        if port == "control":
            response = parse(simulation_pb2.Response, data)
            return Answer(answers.read_errors(response), nobody, nobody)
        message = parse(simulation_pb2.RobotControlResponse, data)
        team = BLUE if port == TEAM_NAMES[BLUE] else YELLOW
        reported, contact = answers.read_feedback(layout, message, team)
        return Answer(answers.read_errors(message), reported, contact)


class FiraSim(Peer):
    """FIRASim's packets."""

    def commands(self, layout: WireLayout, commands: Floats, team: int) -> list[Message]:
        """Return the messages that give a team's robots their commands; see `Peer.commands`."""
        packet = fira.to_commands(layout, commands, team)
        return [Message("command", packet.SerializeToString())]

    def placement(
        self, layout: WireLayout, frame: Frame, strangers: Iterable[Identity]
    ) -> list[Message]:
        """Return the messages that put all bodies; see `Peer.placement`."""
        packet = fira.to_replacement(layout, frame)
        for team, number in strangers:
            robot = packet.replace.robots.add(yellowteam=team == YELLOW, turnon=False)
            robot.position.robot_id = number
        for robot in packet.replace.robots:
            if not robot.turnon:
                place, number = robot.position, robot.position.robot_id
                place.x, place.y = _outside(layout, "firasim", robot.yellowteam, number)
        return [Message("command", packet.SerializeToString())]

    def ball_placement(self, layout: WireLayout, frame: Frame) -> list[Message]:
        """Return the messages that put the ball alone; see `Peer.ball_placement`."""
        packet = fira.to_replacement(layout, frame)
        packet.replace.ClearField("robots")
        return [Message("command", packet.SerializeToString())]


def _outside(
    layout: WireLayout, protocol: str, is_yellow: bool, number: int
) -> tuple[float, float]:
    """Place beside the field of a robot that does not play, m."""
    side = 1.0 if is_yellow else -1.0
    distance = layout.config.field.width / 2 + OUTSIDE[protocol]
    return side * (_FIRST + _APART * number), -distance


def make_peer(settings: Settings) -> Peer:
    """Return the peer of some settings.

    Args:
        settings: the settings.
    """
    kinds: dict[str, type[Peer]] = {
        "grsim": GrSim,
        "firasim": FiraSim,
        "ssl-simulation": SslSimulation,
    }
    return kinds[settings.peer]()


def make_layout(settings: Settings, config: SimConfig, *, positive: bool) -> WireLayout:
    """Return sides and numbers on the wire.

    Args:
        settings: the settings.
        config: the `SimConfig` of the match.
        positive: whether the goal of the robots that are blue on the wire is at +x.

    Raises:
        ValueError: uniform numbers that the match cannot have, or robots of another league.
    """
    names = {"blue_ids": "ids", "yellow_ids": "opponent_ids"}
    on_two_wheels = settings.league == "vsss"
    for model in config.robots:
        if (model.drive == "differential") != on_two_wheels:
            wanted = "on two wheels" if on_two_wheels else "of the SSL"
            raise ValueError(
                f"task: expected robots {wanted} with {settings.peer}, got some with the drive "
                f"{model.drive!r}"
            )
    try:
        return WireLayout(
            config,
            blue_ids=settings.ids,
            yellow_ids=settings.opponent_ids,
            blue_on_positive_half=positive,
            colors_exchanged=settings.team == TEAM_NAMES[YELLOW],
        )
    except ValueError as error:
        name, _, text = str(error).partition(":")
        raise ValueError(f"{names.get(name, name)}:{text}") from None
