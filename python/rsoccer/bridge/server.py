"""The server without sockets: datagrams in, ticks, datagrams out.

Everything is a function of what arrives, from whom and when, so tests need neither a network nor
time.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from typing import Final

from rsoccer import checks
from rsoccer.bridge.awaited_answers import AwaitedAnswers
from rsoccer.bridge.external_referee import ExternalReferee
from rsoccer.bridge.session import IDENTITY, Datagram, Session
from rsoccer.bridge.settings import Settings
from rsoccer.bridge.ssl_ports import STATUS_PORTS, SslPorts
from rsoccer.bridge.team import Address
from rsoccer.bridge.vsss_ports import VsssPorts
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import TEAM_NAMES

MAX_TICKS: Final = 50
"""Ticks in one call, so that messages are read in between."""
MAX_HEARD: Final = 1000
"""Packets of a referee on the network that are kept for the listeners between two ticks."""

MAX_SIZES: Final = {
    **{"blue": 8192, "yellow": 8192, "control": 16384, "grsim": 16384},
    **{"command": 16384, "replacer": 16384, "referee": 16384},
}
"""Greatest length of a message by the port, in bytes: more than `MAX_ROBOTS` robots with all fields
need. A datagram may have 65507, which take longer to read than a tick."""


class Server:
    """A match that teams' software plays.

    Attributes:
        session: the match and its clients.
        ports: the ports of the league.
        listeners: called after each tick with what a referee on the network has sent since the
            last one, and then what is sent here.
        is_local: whether only a referee on this machine is heard; `SocketLoop` sets it.
    """

    def __init__(
        self,
        settings: Settings | None = None,
        epoch: float = 0.0,
        status_ports: tuple[int, int] = STATUS_PORTS,
        identity: str = IDENTITY,
    ) -> None:
        """Begin a match.

        Args:
            settings: the settings; None for the defaults.
            epoch: Unix time of the simulated time 0, s.
            status_ports: ports of clients to which grSim's status of blue and of yellow goes, 1 to
                65535. VSSS has none.
            identity: identity of tracker and referee, by which clients tell servers on one network
                apart; `rsoccer serve` has a random one.

        Raises:
            TypeError: an unknown option of the match.
            ValueError: an option of the match, or a policy that does not fit; or no port.
        """
        for name, port in zip(TEAM_NAMES, status_ports, strict=True):
            checks.integer_in_range(f"ports: status_{name}", port, 1, 65535)
        settings = Settings() if settings is None else settings
        self.session = Session(settings, epoch, identity)
        self.ports: SslPorts | VsssPorts
        if settings.league == "ssl":
            self.ports = SslPorts(self.session, status_ports)
        else:
            self.ports = VsssPorts(self.session)
        self._referee = ExternalReferee(self.session) if settings.referee == "external" else None
        self.is_local = False
        self.listeners: list[Callable[[Server, list[Datagram]], None]] = []
        # From the referee on the network, since the last tick.
        self._heard: deque[Datagram] = deque(maxlen=MAX_HEARD)
        self._waits = False
        self._awaited = AwaitedAnswers(self.session.teams, settings.client_timeout)
        self._has_had = [False, False]

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the ports that receive."""
        return (*self.ports.inputs, *(("referee",) if self._referee else ()))

    @property
    def listening_groups(self) -> tuple[str, ...]:
        """Names of the ports that receive what is sent to a group."""
        return tuple(name for name in self.inputs if name in ("referee", "replacer"))

    @property
    def awaits_referee(self) -> bool:
        """True until the first packet of a referee on the network, if there is to be one."""
        return self._referee is not None and not self._referee.is_heard

    def receive(self, port: str, data: bytes, address: Address, now: float) -> list[Datagram]:
        """Take in a datagram.

        Args:
            port: name of the port, one of `inputs`.
            data: its bytes; any.
            address: address of the sender.
            now: time on the wall, s, on any clock that runs evenly.

        Returns:
            The answers.
        """
        counts = self.session.counts
        counts[f"{port}: received"] += 1
        if port == "referee" and self.is_local and not self.session.is_of_this_machine(address):
            counts["referee: not of this machine"] += 1
            return []
        answered = [] if self.session.clock else self._awaited.before_message()
        try:
            _check_size(port, data)
            if port == "referee" and self._referee is not None:
                self._referee.receive(data)
                if self.listeners:
                    self._heard.append(Datagram("referee", data))
                return []
            return self.ports.receive(port, data, address, now)
        except MessageError as error:
            counts[f"{port}: unreadable"] += 1
            return self.ports.refuse(port, error, address)
        finally:
            if answered:
                self._awaited.after_message(answered, now)

    def advance(self, now: float) -> list[Datagram]:
        """Play the ticks that are due.

        Args:
            now: time on the wall, s.

        Returns:
            What cameras, tracker and referee tell.
        """
        return list(self.play(now))

    def play(self, now: float) -> Iterator[Datagram]:
        """Play the ticks that are due, as `advance` does, while the result is iterated to its end.

        Args:
            now: time on the wall, s.

        Returns:
            What cameras, tracker and referee tell, each as soon as it is known: clients read what
            the cameras saw while the packets of tracker and referee are made.
        """
        clock = self.session.clock
        if clock is None:
            yield from self._play_with_clients(now)
            return
        for _ in range(min(clock.due(now), MAX_TICKS)):
            clock.step()
            yield from self._tick(now, [])

    def next_due(self, now: float) -> float:
        """Return the time on the wall at which `advance` has something to do.

        Args:
            now: time on the wall, s.
        """
        clock = self.session.clock
        if clock is not None:
            return clock.next_due(now)
        if not self._is_waiting(now):
            return now
        return self._awaited.due

    def _tick(self, now: float, sent: list[Datagram]) -> Iterator[Datagram]:
        """Play a tick; what is sent is put into a list, too."""
        session, ports = self.session, self.ports
        session.tick(now)
        if self._referee is not None:
            self._referee.advance()
        for frame in session.arena.camera_frames:
            for datagram in ports.frames(frame):
                sent.append(datagram)
                yield datagram
        for datagram in ports.officials.datagrams():
            sent.append(datagram)
            yield datagram
        if self.listeners:
            heard = [*self._heard, *sent]
            self._heard.clear()
            for listener in self.listeners:
                listener(self, heard)

    # -- As fast as clients answer ---------------------------------------------------------------

    def _play_with_clients(self, now: float) -> Iterator[Datagram]:
        self._awaited.settle(now)
        if self._is_waiting(now):
            copy = self._awaited.copy(now)
            self.session.counts["frames: sent again"] += bool(copy)
            yield from copy
            return
        for _ in range(MAX_TICKS):
            sent: list[Datagram] = []
            yield from self._tick(now, sent)
            if self.session.arena.camera_frames:
                self._waits = True
                self._awaited.ask([each for each in sent if each.port != "referee"], now)
                break

    def _is_waiting(self, now: float) -> bool:
        """Whether a client has not answered the last frame, or has not come yet."""
        session = self.session
        for team in session.teams:
            session.release_silent(team, now)
            self._has_had[team.index] |= team.address is not None
        if not self._waits:
            return False
        expected = [
            team
            for team in session.teams
            if team.address is not None
            or not (self._has_had[team.index] or session.stand_ins.plays(team.index))
        ]
        if expected:
            self._waits = not all(team.answered for team in expected)
        else:
            # Policies play on by themselves; without them, nobody is there.
            self._waits = not any(session.stand_ins.plays(team.index) for team in session.teams)
        return self._waits


def _check_size(port: str, data: bytes) -> None:
    """Refuse a message that no client sends, before it is read."""
    if len(data) > MAX_SIZES[port]:
        raise MessageError(
            Code.TOO_LARGE,
            f"message: expected at most {MAX_SIZES[port]} bytes at the port {port}, "
            f"got {len(data)}",
        )
