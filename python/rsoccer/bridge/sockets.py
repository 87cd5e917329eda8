"""Sockets of a server, and the loop between them and the clock."""

from __future__ import annotations

import contextlib
import functools
import ipaddress
import selectors
import socket
import struct
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Final, Self

from rsoccer.bridge.server import Server
from rsoccer.bridge.session import Datagram
from rsoccer.bridge.team import Address
from rsoccer.protocols.parsing import MAX_SIZE

LOOPBACK: Final = "127.0.0.1"
"""The interface that nothing outside of this machine reaches."""
BATCH: Final = 32
"""Datagrams that are read from a socket before another socket and the clock have their turn."""
BATCH_SECONDS: Final = 2.5e-3
"""Time after which no more of them are read, s: half a tick, for messages that take long."""
BUFFER: Final = 1 << 20
"""Bytes of a socket's buffers that are asked for."""
LONGEST_WAIT: Final = 0.5
"""Longest time without a look at whether to stop, s."""
_ANY_PORT: Final = 9
_IP_MULTICAST_ALL: Final = 49
"""Option of Linux, which `socket` does not name (ip(7))."""


@dataclass(frozen=True)
class Network:
    """Places of a server on the network.

    Attributes:
        host: address on which ports receive.
        interface: address of the interface of multicast; None for that of `host`.
        ports: numbers of the ports by name; 0 for any that is free, where the server receives.
        groups: hosts or multicast groups of what is sent, by the name of the port.
        ttl: routers that multicast may pass plus 1; 0 to stay on this machine.
    """

    host: str
    interface: str | None
    ports: Mapping[str, int]
    groups: Mapping[str, str]
    ttl: int = 0

    def __post_init__(self) -> None:
        """Check the addresses and numbers.

        Raises:
            ValueError: no IPv4 address, or no port.
        """
        for name, text in (("host", self.host), ("interface", self.interface_address)):
            _check_address(name, text)
        for name, text in self.groups.items():
            _check_address(f"groups: {name}", text)
        for name, number in self.ports.items():
            if not 0 <= number <= 65535:
                raise ValueError(f"ports: expected 0 to 65535 for {name}, got {number}")
        if not 0 <= self.ttl <= 255:
            raise ValueError(f"ttl: expected 0 to 255, got {self.ttl}")

    @property
    def interface_address(self) -> str:
        """Address of the interface of multicast."""
        return self.host if self.interface is None else self.interface


def _check_address(name: str, text: str) -> None:
    try:
        ipaddress.IPv4Address(text)
    except ValueError:
        raise ValueError(f"{name}: expected an IPv4 address, got {text!r}") from None


def receiver(host: str, port: int) -> socket.socket:
    """Return a socket that receives datagrams to a port.

    Args:
        host: address of the interface; "0.0.0.0" for all.
        port: number of the port; 0 for any that is free.

    Raises:
        OSError: the port is taken, or the address is not one of this machine. The message has both.
    """
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
        made.setblocking(False)
        made.bind((host, port))
    except OSError as error:
        made.close()
        raise OSError(f"{host}:{port}: {error.strerror or error}") from error
    return made


def sender(interface: str, ttl: int) -> socket.socket:
    """Return a socket that sends datagrams to hosts and multicast groups.

    Args:
        interface: address of the interface of multicast.
        ttl: routers that multicast may pass plus 1; 0 to stay on this machine.

    Raises:
        OSError: the interface is not one of this machine. The message has it.
    """
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        made.setblocking(False)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER)
        made.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
        made.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_LOOP, 1)
        if interface != "0.0.0.0":
            made.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton(interface))
    except OSError as error:
        made.close()
        raise OSError(f"interface {interface}: {error.strerror or error}") from error
    return made


def group_receiver(group: str, port: int, interface: str) -> socket.socket:
    """Return a socket that receives what is sent to a group, beside others that do.

    Args:
        group: multicast group, or address of this machine.
        port: number of the port.
        interface: address of the interface of multicast.

    Raises:
        OSError: the port is taken by a program that does not share it. The message has both.
    """
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        made.setblocking(False)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER)
        made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if sys.platform != "linux" and hasattr(socket, "SO_REUSEPORT"):
            made.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
        multicast = ipaddress.IPv4Address(group).is_multicast
        # Bound to its group, a socket gets nothing of other groups on the same port.
        made.bind((group if sys.platform == "linux" or not multicast else "", port))
        if multicast:
            if sys.platform == "linux":
                # Else it gets what other programs have joined the group for on other interfaces.
                made.setsockopt(socket.IPPROTO_IP, _IP_MULTICAST_ALL, 0)
            member = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton(interface))
            made.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
    except OSError as error:
        made.close()
        place = f"{group}:{port} at interface {interface}"
        raise OSError(f"{place}: {error.strerror or error}") from error
    return made


@functools.lru_cache(maxsize=256)  # asked for with each message of a client on the network
def is_own_host(host: str) -> bool:
    """Return whether a host is this machine.

    Args:
        host: its address.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as made:
        try:
            # Nothing is sent. What goes to an address of this machine comes from there; to bind
            # to it tells less, as machines may allow that for any address.
            made.connect((host, _ANY_PORT))
        except OSError:
            return False
        return bool(made.getsockname()[0] == host)


class SocketLoop:
    """A server on the network; a `with` statement closes its sockets.

    Attributes:
        server: the server.
        addresses: addresses at which it receives, by the name of the port.
    """

    def __init__(
        self, server: Server, network: Network, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Open the sockets.

        Args:
            server: the server.
            network: places on the network.
            clock: time on the wall, s.

        Raises:
            OSError: a port is taken, or an address is not one of this machine.
        """
        self.server = server
        self._network, self._clock = network, clock
        server.is_local = all(
            ipaddress.IPv4Address(text).is_loopback
            for text in (network.host, network.interface_address)
        )
        server.session.is_own_host = is_own_host
        self._stack = contextlib.ExitStack()
        self._selector = self._stack.enter_context(selectors.DefaultSelector())
        self._sockets: dict[str, socket.socket] = {}
        self.addresses: dict[str, Address] = {}
        self._stopped = False
        with contextlib.ExitStack() as on_error:
            on_error.callback(self._stack.close)
            for name in server.inputs:
                made = self._open(name)
                self._stack.enter_context(made)
                self._sockets[name] = made
                self.addresses[name] = made.getsockname()
                self._selector.register(made, selectors.EVENT_READ, name)
            self._sender = self._stack.enter_context(sender(network.interface_address, network.ttl))
            on_error.pop_all()

    def _open(self, name: str) -> socket.socket:
        network = self._network
        if name in self.server.listening_groups:
            group, port = network.groups[name], network.ports[name]
            return group_receiver(group, port, network.interface_address)
        return receiver(network.host, network.ports[name])

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close all sockets; a second call does nothing."""
        self._stack.close()

    def stop(self) -> None:
        """Let `run` return soon; for signal handlers and other threads."""
        self._stopped = True

    @property
    def is_stopped(self) -> bool:
        """True once `stop` was called."""
        return self._stopped

    def run(self, seconds: float | None = None) -> None:
        """Play until `stop`.

        Args:
            seconds: longest duration on the wall, s; None for no limit.
        """
        end = None if seconds is None else self._clock() + seconds
        while not self._stopped and (end is None or self._clock() < end):
            self.turn(LONGEST_WAIT)

    def turn(self, longest: float = 0.0) -> None:
        """Wait for a message or a tick, and do what is due.

        Args:
            longest: longest time to wait, s.
        """
        now = self._clock()
        wait = min(max(0.0, self.server.next_due(now) - now), longest)
        for key, _ in self._selector.select(wait):
            self._receive(key.data)
        self._send(self.server.play(self._clock()))

    def _receive(self, name: str) -> None:
        """Read some datagrams of a port. What is left waits, so that a flood stops no tick."""
        source = self._sockets[name]
        end = self._clock() + BATCH_SECONDS
        for _ in range(BATCH):
            try:
                data, address = source.recvfrom(MAX_SIZE + 1)
            except BlockingIOError:
                return
            except ConnectionError:
                continue  # an earlier answer found nobody
            self._send(self.server.receive(name, data, address, self._clock()))
            if self._clock() > end:
                return

    def _send(self, datagrams: Iterable[Datagram]) -> None:
        counts = self.server.session.counts
        for port, data, address in datagrams:
            through = self._sockets.get(port, self._sender) if address else self._sender
            try:
                through.sendto(data, address or self._group(port))
            except OSError:  # the buffer is full, or there is no way to the receiver
                counts[f"{port}: not sent"] += 1

    def _group(self, port: str) -> Address:
        number = self._network.ports[port]
        if port == "vision" and self.server.ports.vision_port is not None:
            number = self.server.ports.vision_port
        return self._network.groups[port], number
