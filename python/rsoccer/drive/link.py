"""The network of a connection: datagrams in, datagrams out."""

from __future__ import annotations

import contextlib
import selectors
import socket
from collections.abc import Iterable
from typing import Final, NamedTuple, Protocol

from rsoccer.bridge.sockets import Network, group_receiver, sender
from rsoccer.bridge.team import Address
from rsoccer.drive.peers import Message
from rsoccer.drive.settings import LISTENING, Settings
from rsoccer.protocols.parsing import MAX_SIZE

BATCH: Final = 64
"""Datagrams that are read from a socket before another socket has its turn."""


class Received(NamedTuple):
    """A datagram that came in."""

    port: str
    """Name of the port: that of a group, or the one to which the answered message went."""
    data: bytes
    """The bytes."""


class Link(Protocol):
    """A carrier of datagrams."""

    def poll(self, seconds: float) -> list[Received]:
        """Return what has come in; wait for it if nothing has.

        Args:
            seconds: longest time to wait, s.
        """

    def send(self, messages: Iterable[Message]) -> None:
        """Send messages; those that cannot be sent are lost, as others on a network.

        Args:
            messages: the messages.
        """

    def close(self) -> None:
        """Release what is held."""


class SocketLink(Link):
    """Sockets.

    Attributes:
        addresses: where messages go, by the name of the port.
        lost: messages that could not be sent.
    """

    def __init__(self, settings: Settings) -> None:
        """Open the sockets.

        Args:
            settings: the settings.

        Raises:
            OSError: a port is taken by a program that does not share it, or an address is not one
                of this machine.
            ValueError: no IPv4 address.
        """
        ports, groups = settings.port_numbers, settings.group_hosts
        Network(settings.host, settings.interface, ports, groups, settings.ttl)  # checks them
        self.addresses: dict[str, Address] = {
            name: (settings.host, port) for name, port in ports.items() if name not in LISTENING
        }
        self.lost = 0
        self._stack = contextlib.ExitStack()
        with contextlib.ExitStack() as on_error:
            on_error.callback(self._stack.close)
            self._selector = self._stack.enter_context(selectors.DefaultSelector())
            self._sockets: dict[str, socket.socket] = {}
            for name in settings.heard:
                made = group_receiver(groups[name], ports[name], settings.interface)
                self._add(name, made)
            # A socket for each port, so that an answer tells what it answers.
            for name in self.addresses:
                local = settings.host.startswith("127.")
                made = sender(settings.interface, settings.ttl)
                self._add(name, made)
                made.bind(("127.0.0.1" if local else "", 0))
            on_error.pop_all()

    def _add(self, name: str, made: socket.socket) -> None:
        self._stack.enter_context(made)
        self._sockets[name] = made
        self._selector.register(made, selectors.EVENT_READ, name)

    def socket_of(self, port: str) -> socket.socket:
        """Return the socket that sends to a port.

        Args:
            port: name of the port.
        """
        return self._sockets[port]

    def poll(self, seconds: float) -> list[Received]:
        """Return what has come in; see `Link.poll`."""
        found = []
        for key, _ in self._selector.select(max(0.0, seconds)):
            for _ in range(BATCH):
                try:
                    data = self._sockets[key.data].recv(MAX_SIZE + 1)
                except BlockingIOError:
                    break
                except ConnectionError:
                    continue  # nobody was at the address of an earlier message
                found.append(Received(key.data, data))
        return found

    def send(self, messages: Iterable[Message]) -> None:
        """Send messages; see `Link.send`."""
        for message in messages:
            try:
                self._sockets[message.port].sendto(message.data, self.addresses[message.port])
            except OSError:  # the buffer is full, nobody is there, or there is no way
                self.lost += 1

    def close(self) -> None:
        """Close the sockets; a second call does nothing."""
        self._stack.close()
