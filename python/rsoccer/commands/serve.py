"""`rsoccer serve`: the simulator for teams' software."""

from __future__ import annotations

import math
import signal
import sys
import time
import uuid
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

from tyro.conf import Positional, arg

from rsoccer import checks
from rsoccer.commands.imports import Imports
from rsoccer.commands.task_options import TASK_OPTIONS
from rsoccer.option_words import check_entries
from rsoccer.sources import make_sensing

if TYPE_CHECKING:
    from rsoccer.bridge.settings import Settings
    from rsoccer.bridge.sockets import Network, SocketLoop

ENDING: Final = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
"""Signals that end a match: records are written, whatever comes meanwhile. Ctrl-C sends the first
one, and a terminal that is closed the last one, which Windows lacks."""
_SENSING = arg(metavar="PRESET|FILE", help_behavior_hint="(default: exact, 60 frames a second)")
_POLICY = arg(metavar="POLICY", help_behavior_hint="(default: its robots stand still)")
_USUAL = "(default: those of the league)"


@dataclass(frozen=True)
class Serve(Imports):
    """Simulate a match for teams' software, over the network protocols of its league."""

    league: Annotated[Literal["ssl", "vsss"], Positional, arg(metavar="LEAGUE")] = "ssl"
    """league, ssl or vsss: field, rules and protocols"""
    division: Literal["A", "B"] = "B"
    """division of the SSL"""
    robots: Annotated[int | None, arg(help_behavior_hint="(default: by the rules)")] = None
    """robots of a team"""
    task_options: Annotated[Mapping[str, Any], TASK_OPTIONS] = field(default_factory=dict)
    """further options of the match task, such as half_seconds=60"""
    blue: Annotated[str | None, _POLICY] = None
    """policy of blue's robots that no client drives"""
    yellow: Annotated[str | None, _POLICY] = None
    """policy of yellow's robots that no client drives"""
    sensing: Annotated[str | None, _SENSING] = None
    """senses: noise, delay and loss of vision, feedback and commands"""
    speed: str = "1"
    """speed: 1 is real time, 2 is twice as fast, 0 stands until a client sets another, max is as
    fast as the clients answer"""
    referee: Literal["own", "external", "off"] = "own"
    """own: the match has a referee, as game controller; external: obey one on the network"""
    host: str = "127.0.0.1"
    """address of the interface on which ports receive; 0.0.0.0 for all"""
    interface: Annotated[str | None, arg(help_behavior_hint="(default: that of host)")] = None
    """address of the interface of multicast"""
    ttl: int = 0
    """routers that multicast may pass, plus 1; 0 for this machine alone"""
    ports: Annotated[tuple[str, ...], arg(metavar="NAME=PORT", help_behavior_hint=_USUAL)] = ()
    """other ports, such as vision=10020"""
    groups: Annotated[tuple[str, ...], arg(metavar="NAME=HOST", help_behavior_hint=_USUAL)] = ()
    """other multicast groups or hosts to send to, such as vision=127.0.0.1"""
    allow_remote_control: bool = False
    """let other machines put robots and ball, and set the speed"""
    blue_on_positive_half: Annotated[
        bool | None, arg(help_behavior_hint="(default: as grSim and FIRASim have it)")
    ] = None
    """whether blue's goal is at +x on the network"""
    command_timeout: float = 0.2
    """time after which a robot without a command stops, simulated seconds"""
    client_timeout: float = 1.0
    """time after which a silent client has left its team, seconds"""
    record: Annotated[
        tuple[str, ...], arg(metavar="FILE", help_behavior_hint="(default: none)")
    ] = ()
    """files to record to: a replay (.rsr) or a log of the SSL (.log, .log.gz)"""
    page: Annotated[int | None, arg(metavar="PORT", help_behavior_hint="(default: none)")] = None
    """port of a page on this machine that shows the match in a browser, 0 for any that is free"""
    seconds: Annotated[float, arg(help_behavior_hint="(default: until Ctrl-C)")] = math.inf
    """longest duration, in real time"""
    seed: int = 0
    """random seed"""

    def run(self) -> None:
        """Serve until Ctrl-C.

        Raises:
            OSError: a port is taken, or an address is not one of this machine.
            ValueError: an option is refused.
        """
        from rsoccer.bridge.server import Server
        from rsoccer.bridge.sockets import SocketLoop
        from rsoccer.bridge.ssl_ports import STATUS_PORTS
        from rsoccer.protocols.layout import TEAM_NAMES

        if self.page is not None:
            checks.integer_in_range("page", self.page, 0, 65535)
        checks.number_in_range("seconds", self.seconds, 0.0, math.inf)
        settings, network = self.settings(), self.network()
        status_blue, status_yellow = (
            network.ports.get(f"status_{name}", port)
            for name, port in zip(TEAM_NAMES, STATUS_PORTS, strict=True)
        )
        ports = status_blue, status_yellow
        server = Server(settings, time.time(), ports, identity=str(uuid.uuid4()))
        for name, number in network.ports.items():
            if number == 0 and name not in server.inputs:
                raise ValueError(f"ports: expected 1 to 65535 for {name}, which is sent, got 0")
        with ExitStack() as stack:
            loop = stack.enter_context(SocketLoop(server, network))
            self._announce(loop, network)
            for name in ENDING:  # which go on to do nothing else until all records are written
                previous = signal.getsignal(name)
                if previous is not signal.SIG_IGN:  # as `nohup` has it
                    signal.signal(name, lambda *_: loop.stop())
                    stack.callback(signal.signal, name, previous)
            self._watch(server, stack)  # a port that is taken must leave the files as they are
            loop.run(None if math.isinf(self.seconds) else self.seconds)
            if loop.is_stopped:
                sys.stderr.write("stopped\n")
        self._report(server)

    def settings(self) -> Settings:
        """Return the settings of the server.

        Raises:
            ValueError: an option is refused.
        """
        from rsoccer._core import Sensing
        from rsoccer.bridge.settings import Settings

        sensing = make_sensing(self.sensing)
        if sensing is not None and not isinstance(sensing, Sensing):
            raise ValueError(f"sensing: expected a preset or a .json file, got {self.sensing!r}")
        return Settings(
            league=self.league,
            division=self.division,
            robots=self.robots,
            sensing=sensing,
            speed=self._speed(),
            blue=self.blue,
            yellow=self.yellow,
            referee=self.referee,
            blue_on_positive_half=self.blue_on_positive_half,
            command_timeout=self.command_timeout,
            client_timeout=self.client_timeout,
            allow_remote_control=self.allow_remote_control,
            seed=self.seed,
            options=dict(self.task_options),
        )

    def network(self) -> Network:
        """Return the places on the network.

        Raises:
            ValueError: an unknown port, or no address.
        """
        from rsoccer.bridge.settings import default_groups, default_ports
        from rsoccer.bridge.sockets import Network

        ports = dict(default_ports(self.league))
        for name, value in _entries("ports", self.ports, ports):
            if not value.isdecimal():
                raise ValueError(f"ports: expected a number for {name}, got {value!r}")
            ports[name] = int(value)
        groups = dict(default_groups(self.league))
        groups |= dict(_entries("groups", self.groups, groups))
        taken: dict[tuple[str, int], str] = {}
        for name, number in ports.items():
            other = taken.setdefault((groups.get(name, self.host), number), name)
            if number and other != name:
                raise ValueError(
                    f"ports: expected others for {other} and {name}, got {number} twice"
                )
        return Network(self.host, self.interface, ports, groups, self.ttl)

    def _speed(self) -> float | None:
        """Speed of the clock; None for as fast as clients answer."""
        if self.speed == "max":
            return None
        try:
            return float(self.speed)
        except ValueError:
            raise ValueError(f"speed: expected a number or max, got {self.speed!r}") from None

    def _watch(self, server: Any, stack: ExitStack) -> None:  # noqa: ANN401
        """Record, and show the page."""
        from rsoccer.bridge.recording import check_record, record

        # "a.rsr" and "./a.rsr" are one file, to which two writers must not write.
        if len({Path(path).resolve() for path in self.record}) < len(self.record):
            raise ValueError(f"record: expected each file once, got {' '.join(self.record)}")
        for path in self.record:
            check_record(server, path)
        if self.page is not None:
            from rsoccer.bridge.live_page import LivePage

            page = stack.enter_context(LivePage(server, self.page))
            sys.stderr.write(f"page: {page.url}\n")
        for path in self.record:
            stack.enter_context(record(server, path))

    def _announce(self, loop: SocketLoop, network: Network) -> None:
        for name, (host, port) in loop.addresses.items():
            sys.stderr.write(f"{name}: receives at {host}:{port}\n")
        for name, group in network.groups.items():
            if name not in loop.addresses:
                sys.stderr.write(f"{name}: sends to {group}:{network.ports[name]}\n")

    def _report(self, server: Any) -> None:  # noqa: ANN401
        session = server.session
        sys.stderr.write(f"{session.arena.seconds:.1f} s were simulated\n")
        if session.clock is not None and session.clock.skipped:
            sys.stderr.write(f"{session.clock.skipped:.2f} s were skipped: too slow\n")
        for name, count in sorted(session.counts.items()):
            if count:
                sys.stderr.write(f"{name} {count}\n")


def _entries(
    option: str, given: tuple[str, ...], known: Mapping[str, object]
) -> list[tuple[str, str]]:
    """Names and values of NAME=VALUE."""
    check_entries(option, (entry.partition("=")[0] for entry in given))
    entries = []
    for entry in given:
        name, equals, value = entry.partition("=")
        if not equals or name not in known:
            raise ValueError(f"{option}: expected one of {sorted(known)} and =, got {entry!r}")
        entries.append((name, value))
    return entries
