"""The ports of a VSSS match: FIRASim's packets, and VSSReferee's."""

from __future__ import annotations

from typing import Final

from rsoccer.bridge.arena import CameraFrame
from rsoccer.bridge.officials import VssReferee
from rsoccer.bridge.session import Datagram, Session
from rsoccer.bridge.team import Address
from rsoccer.game import Command
from rsoccer.protocols import fira, vssref
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.referee import RUNNING
from rsoccer.protocols.schemas import fira_pb2, vssref_pb2


class VsssPorts:
    """The ports of VSSS. Its protocols have no answers: what is refused is counted.

    Attributes:
        officials: packets of the referee.
    """

    inputs: Final = ("command", "replacer")
    vision_port: int | None = None

    def __init__(self, session: Session) -> None:
        """Open the ports of a match.

        Args:
            session: the match.
        """
        self._session = session
        self.officials = VssReferee(session)

    def frames(self, frame: CameraFrame) -> list[Datagram]:
        """Return what FIRASim's vision tells when a frame has arrived.

        Args:
            frame: the frame.
        """
        session, arena = self._session, self._session.arena
        blue, yellow = arena.play.game.score[0].tolist()
        packet = fira.to_environment(
            session.layout,
            arena.sense(),
            seconds=frame.seconds,
            score=(int(blue), int(yellow)),
        )
        return [Datagram("vision", packet.SerializeToString())]

    def receive(self, port: str, data: bytes, address: Address, now: float) -> list[Datagram]:
        """Return no answers to a message, which is obeyed: the protocols have none.

        Args:
            port: name of the port.
            data: the bytes.
            address: address of the sender.
            now: time on the wall, s.

        Raises:
            MessageError: the bytes are no message of the port.
        """
        if port == "replacer":
            self._replace(parse(vssref_pb2.Placement, data), address)
            return []
        session, arena = self._session, self._session.arena
        message = parse(fira_pb2.Packet, data)
        if message.HasField("replace"):
            if session.may_control(address):
                refused = session.place(fira.read_replacement(session.layout, message, arena.frame))
                session.counts["command: parts refused"] += len(refused)
            else:
                session.counts["command: remote control refused"] += 1
        if message.HasField("cmd"):
            self._command(message, address, now)
        return []

    def refuse(self, port: str, error: MessageError, address: Address) -> list[Datagram]:
        """Return no answers to bytes that are no message.

        Args:
            port: name of the port.
            error: the reason.
            address: address of the sender.
        """
        return []

    def _command(self, message: fira_pb2.Packet, address: Address, now: float) -> None:
        session, seconds = self._session, self._session.arena.seconds
        named = {command.yellowteam for command in message.cmd.robot_commands}
        refused = 0
        for index in TEAMS:
            if bool(index) not in named:
                continue
            team = session.teams[index]
            session.release_silent(team, now)
            if not team.accept(address, now):
                session.counts[f"command: {TEAM_NAMES[index]} taken"] += 1
                continue
            read = fira.read_commands(session.layout, message, team.previous(seconds))
            team.hold(read.commands, read.given, seconds)
            refused = len(read.problems)  # of the whole packet, for each team alike
        session.counts["command: parts refused"] += refused

    def _replace(self, message: vssref_pb2.Placement, address: Address) -> None:
        """Put the robots of a team where it wants them before a kick."""
        session = self._session
        command = Command(int(session.arena.play.game.command[0]))
        if session.settings.referee != "off" and command in RUNNING:
            session.counts["replacer: refused while play goes on"] += 1
            return
        placement = vssref.read_placement(session.layout, message, session.arena.frame)
        team = int(message.world.teamColor == vssref_pb2.YELLOW)
        holder = session.teams[team].address
        # A team that somebody drives is placed from there; another one as all bodies are.
        allowed = session.may_control(address) if holder is None else holder[0] == address[0]
        if not allowed:
            session.counts["replacer: remote control refused"] += 1
            return
        session.counts["replacer: parts refused"] += len(session.place(placement))
