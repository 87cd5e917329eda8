"""The ports of an SSL match: simulation protocol, grSim's packets, vision, tracker, referee."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from rsoccer.arrays import Mask
from rsoccer.bridge.arena import CameraFrame
from rsoccer.bridge.control_reader import ControlReader
from rsoccer.bridge.officials import GameController
from rsoccer.bridge.refusals import Reason, Refusal, to_response, to_team_response
from rsoccer.bridge.session import Datagram, Session, remote_control_refused, taken
from rsoccer.bridge.settings import SSL_PORTS
from rsoccer.bridge.team import Address, Team
from rsoccer.bridge.tracker_packets import TrackerPackets
from rsoccer.bridge.vision_packets import VisionPackets
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import grsim
from rsoccer.protocols.answers import to_robot_control_response
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.robot_control import read_robot_control
from rsoccer.protocols.schemas import grsim_pb2, simulation_pb2
from rsoccer.protocols.simulator_control import ControlResult, read_command

GEOMETRY_SECONDS: Final = 1.0
"""Simulated time between packets with the geometry, s."""
STATUS_PORTS: Final = (SSL_PORTS["status_blue"], SSL_PORTS["status_yellow"])
"""Ports of clients to which grSim's status of blue and of yellow goes."""
MAX_COMMON_SIZE: Final = 4096
"""Greatest length of a message that is read the fast way, in bytes: `parse` refuses long lists."""
_TEAM_PORTS: Final = {"blue": BLUE, "yellow": YELLOW}


class SslPorts:
    """The SSL's ports.

    Attributes:
        inputs: names of the ports that receive.
        vision_port: port of vision, if a client asked for another one; else None.
        officials: packets of the referee.
    """

    inputs: Final = ("control", "blue", "yellow", "grsim")

    def __init__(self, session: Session, status_ports: tuple[int, int] = STATUS_PORTS) -> None:
        """Open the ports of a match.

        Args:
            session: the match.
            status_ports: ports of clients to which grSim's status of blue and of yellow goes.
        """
        self._status = status_ports
        self._session = session
        self._prepare()
        self.officials = GameController(session)
        self._geometry_due = 0.0
        self.vision_port: int | None = None

    def _prepare(self) -> None:
        """Prepare packets for the robots as they are."""
        session = self._session
        self._vision = VisionPackets(session.layout, session.arena.sensing, session.epoch)
        self._tracker = TrackerPackets(session.layout, session.epoch, session.identity)
        self._reader = ControlReader(session.layout)

    # -- What is sent ----------------------------------------------------------------------------

    def frames(self, frame: CameraFrame) -> Iterator[Datagram]:
        """Return what cameras and tracker tell when a frame has arrived, each as it is known.

        Args:
            frame: the frame.
        """
        arena = self._session.arena
        seconds = arena.seconds
        geometry = seconds >= self._geometry_due
        if geometry:
            self._geometry_due = seconds + GEOMETRY_SECONDS - 1e-9
        for packet in self._vision.of(frame, seconds, geometry=geometry):
            yield Datagram("vision", packet)
        yield Datagram("tracker", self._tracker.of(arena.sense(), frame.number, frame.seconds))

    # -- What is received ------------------------------------------------------------------------

    def receive(self, port: str, data: bytes, address: Address, now: float) -> list[Datagram]:
        """Return the answers to a message, which is obeyed.

        Args:
            port: name of the port.
            data: the bytes.
            address: address of the sender.
            now: time on the wall, s.

        Raises:
            MessageError: the bytes are no message of the port.
        """
        if port == "control":
            return [Datagram(port, self._control(data, address, now), address)]
        if port == "grsim":
            return self._grsim(data, address, now)
        team = self._session.teams[_TEAM_PORTS[port]]
        return [Datagram(port, self._team(team, data, address, now), address)]

    def refuse(self, port: str, error: MessageError, address: Address) -> list[Datagram]:
        """Return the answers to bytes that are no message; none where the protocol has none.

        Args:
            port: name of the port.
            error: the reason.
            address: address of the sender.
        """
        reason = Reason(str(error.code), str(error))
        if port == "control":
            return [Datagram(port, to_response([reason]), address)]
        if port in _TEAM_PORTS:
            return [Datagram(port, to_team_response([reason]), address)]
        return []

    def _team(self, team: Team, data: bytes, address: Address, now: float) -> bytes:
        """Obey a message to a team's port, and return the answer."""
        session, arena = self._session, self._session.arena
        seconds = arena.seconds
        session.release_silent(team, now)  # a new client inherits no commands
        if len(data) <= MAX_COMMON_SIZE:
            common = self._reader.read(data, team.index, team.previous(seconds))
            if common is not None:
                if not team.accept(address, now):
                    return to_team_response([taken(team)])
                team.hold(common.commands, common.given, seconds, moved=common.moved)
                return self._reader.answer(arena.sense(), team.index, common.given)
        message = parse(simulation_pb2.RobotControl, data)
        if not team.accept(address, now):
            return to_team_response([taken(team)])
        read = read_robot_control(
            session.layout, message, team.index, arena.frame, 0, team.previous(seconds)
        )
        fixed, moved = self._movement(team, message)
        team.hold(read.commands, read.given, seconds, fixed, moved)
        given = read.given if read.given.any() else None
        answer = to_robot_control_response(
            session.layout, arena.sense(), 0, team.index, given, read.problems
        )
        reply: bytes = answer.SerializeToString()
        return reply

    def _movement(
        self, team: Team, message: simulation_pb2.RobotControl
    ) -> tuple[dict[int, tuple[float, float]], Mask]:
        """Velocities along the field's axes by index of the robot, and robots with any velocity."""
        layout = self._session.layout
        fixed: dict[int, tuple[float, float]] = {}
        known = {layout.identity(slot)[1]: slot for slot in team.slots}
        models = layout.config.robots
        moved = np.zeros(len(models), np.bool_)
        for command in reversed(message.robot_commands):  # of two of a robot the first counts
            slot = known.get(command.id, -1)
            if slot < 0:
                continue
            moved[slot] = command.move_command.WhichOneof("command") is not None
            fixed.pop(slot, None)
            if models[slot].drive != "omni":
                continue
            if command.move_command.HasField("global_velocity"):
                velocity = command.move_command.global_velocity
                fixed[slot] = (layout.sign * velocity.x, layout.sign * velocity.y)
        return fixed, moved

    def _control(self, data: bytes, address: Address, now: float) -> bytes:
        """Obey a message to the control port, and return the answer."""
        session = self._session
        message = parse(simulation_pb2.Command, data)
        if not session.may_control(address):
            return to_response([remote_control_refused(address)])
        result = read_command(session.layout, message, session.arena.frame)
        reasons = session.place(result.placement)
        reasons += self._configure(result, now)
        return to_response(reasons)

    def _configure(self, result: ControlResult, now: float) -> list[Reason]:
        """Change speed, robots and ports. Return what was refused."""
        session, reasons = self._session, []
        if result.simulation_speed is not None:
            if session.clock is None:
                text = "simulation_speed: expected none while a step waits for clients, got one"
                reasons.append(Reason(Refusal.UNSUPPORTED_SPEED, text))
            else:
                session.clock.set_speed(result.simulation_speed, now)
        if result.robot_models and session.recorders:
            text = "robot_specs: expected none while a replay is recorded, got some"
            reasons.append(Reason(Refusal.RECORDING, text))
        elif result.robot_models:
            try:
                session.arena.exchange_robots(result.robot_models)
            except ValueError as error:
                reasons.append(Reason(Refusal.BLOCKED, f"robot_specs: {error}"))
            else:
                session.refresh_layout()
                self._prepare()
        if result.vision_port is not None:
            self.vision_port = result.vision_port
        return reasons

    def _grsim(self, data: bytes, address: Address, now: float) -> list[Datagram]:
        """Obey a packet of grSim, and return the status of the robots that it commands."""
        session, arena = self._session, self._session.arena
        message = parse(grsim_pb2.Packet, data)
        if message.HasField("replacement"):
            if session.may_control(address):
                refused = session.place(
                    grsim.read_replacement(session.layout, message, arena.frame)
                )
                session.counts["grsim: parts refused"] += len(refused)
            else:
                session.counts["grsim: remote control refused"] += 1
        if not message.HasField("commands"):
            return []
        index = YELLOW if message.commands.isteamyellow else BLUE
        team = session.teams[index]
        session.release_silent(team, now)
        if not team.accept(address, now):
            session.counts["grsim: team taken"] += 1
            return []
        seconds = arena.seconds
        read = grsim.read_commands(session.layout, message, team.previous(seconds))
        session.counts["grsim: parts refused"] += len(read.problems)
        team.hold(read.commands, read.given, seconds)
        slots = [slot for slot in team.slots if read.given[slot]]
        known = arena.sense().take(np.zeros(1, np.intp))
        known.robots.touched_ball[:] = arena.frame.robots.touched_ball
        status = grsim.to_status(session.layout, known, 0, index, session.commands, slots)
        return [Datagram("grsim", status.SerializeToString(), (address[0], self._status[index]))]
