"""Ports of this machine for the servers of tests."""

import os
from collections.abc import Iterator
from itertools import count
from typing import Final

from rsoccer.bridge.sockets import LOOPBACK, receiver

FIRST: Final = 12000
"""Below the ports that Linux gives to sockets which ask for any port, 32768 and more: one of those
could go to another socket first."""
NUMBER: Final = 20000


def free_port() -> int:
    """Return a port that nobody uses, and that this process has not got before."""
    return next(_ports)


def _free_ports() -> Iterator[int]:
    # Tests run in several processes at once, so each begins elsewhere.
    for number in count(os.getpid() * 101):
        port = FIRST + number % NUMBER
        try:
            receiver(LOOPBACK, port).close()
        except OSError:
            continue
        yield port


_ports = _free_ports()
