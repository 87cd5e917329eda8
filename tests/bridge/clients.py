"""A team's software for tests: messages, and a server whose time the test controls."""

from __future__ import annotations

from collections.abc import Iterable

from rsoccer.bridge.match_tasks import TICK
from rsoccer.bridge.server import Server
from rsoccer.bridge.session import Datagram
from rsoccer.bridge.settings import Settings
from rsoccer.bridge.team import Address
from rsoccer.frame import RobotColumns
from rsoccer.protocols.schemas import simulation_pb2

Response = simulation_pb2.RobotControlResponse
BLUE: Address = ("127.0.0.1", 5001)
YELLOW: Address = ("127.0.0.1", 5002)
OTHER: Address = ("127.0.0.1", 5003)
REMOTE: Address = ("192.0.2.7", 5004)


def local_velocity(
    robots: Iterable[int], forward: float = 1.0, left: float = 0.0, angular: float = 0.0
) -> bytes:
    """Return a message that drives robots."""
    message = simulation_pb2.RobotControl()
    for number in robots:
        local = message.robot_commands.add(id=number).move_command.local_velocity
        local.forward, local.left, local.angular = forward, left, angular
    data: bytes = message.SerializeToString()
    return data


class Wall:
    """A server, and the time on its wall."""

    def __init__(self, **settings: object) -> None:
        self.server = Server(Settings(**settings))  # type: ignore[arg-type]
        self.now = 100.0
        self.sent: list[Datagram] = list(self.server.advance(self.now))

    def send(self, port: str, data: bytes, address: Address = BLUE) -> list[Datagram]:
        """Send a message and return the answers."""
        return self.server.receive(port, data, address, self.now)

    def team(self, data: bytes, port: str = "blue", address: Address = BLUE) -> Response:
        """Send a message to a team's port and return the answer."""
        (answer,) = self.send(port, data, address)
        assert (answer.port, answer.address) == (port, address)
        response: Response = simulation_pb2.RobotControlResponse.FromString(answer.data)
        return response

    def control(self, message: simulation_pb2.Command, address: Address = OTHER) -> list[str]:
        """Send a message to the control port and return the codes of errors."""
        (answer,) = self.send("control", message.SerializeToString(), address)
        response = simulation_pb2.Response.FromString(answer.data)
        return [error.code for error in response.errors]

    def tick(self, ticks: int = 1) -> list[Datagram]:
        """Let time pass, and return what was sent."""
        sent = []
        for _ in range(ticks):
            self.now += TICK
            sent += self.server.advance(self.now)
        self.sent += sent
        return sent

    @property
    def robots(self) -> RobotColumns:
        """True state of all robots."""
        return self.server.session.arena.frame.robots

    @property
    def seconds(self) -> float:
        """Simulated time."""
        return self.server.session.arena.seconds
