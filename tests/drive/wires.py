"""A network in process: our own server at the other end, and time that the test controls."""

from __future__ import annotations

from collections.abc import Iterable

from rsoccer import SimConfig
from rsoccer.bridge.match_tasks import TICK
from rsoccer.bridge.server import Server
from rsoccer.bridge.settings import Settings as ServerSettings
from rsoccer.bridge.team import Address
from rsoccer.drive.connection import Connection
from rsoccer.drive.link import Received
from rsoccer.drive.peers import Message
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame

CLIENT: Address = ("127.0.0.1", 5101)


class ServerLink:
    """A link to a server; `clock` is the wall of both."""

    def __init__(self, **settings: object) -> None:
        self.server = Server(ServerSettings(**settings))  # type: ignore[arg-type]
        self.now = 100.0
        self.heard = {"vision", "tracker", "referee"}
        self.messages: list[Message] = []
        self.is_closed = False
        self._waiting: list[Received] = []

    def clock(self) -> float:
        return self.now

    def poll(self, seconds: float) -> list[Received]:
        end = self.now + seconds
        while not self._waiting and self.now < end - 1e-9:
            self.tick()
        found, self._waiting = self._waiting, []
        return found

    def tick(self) -> None:
        self.now += TICK
        for sent in self.server.advance(self.now):
            if sent.address is None and sent.port in self.heard:
                self._waiting.append(Received(sent.port, sent.data))

    def give(self, port: str, data: bytes) -> None:
        """Let a datagram of somebody else come in."""
        self._waiting.append(Received(port, data))

    def send(self, messages: Iterable[Message]) -> None:
        for message in messages:
            self.messages.append(message)
            for sent in self.server.receive(message.port, message.data, CLIENT, self.now):
                if sent.address is not None and sent.port == message.port:
                    self._waiting.append(Received(message.port, sent.data))

    def close(self) -> None:
        self.is_closed = True

    @property
    def frame(self) -> Frame:
        """True state."""
        return self.server.session.arena.frame


def connected(config: SimConfig, link: ServerLink, peer: str, **settings: object) -> Connection:
    """Return a connection over a link."""
    drives = settings.pop("drives", (0,))
    made = Settings(peer, **settings)  # type: ignore[arg-type]
    link.heard = set(made.heard)
    return Connection(config, made, drives=drives, link=link, clock=link.clock)  # type: ignore[arg-type]
