"""Dead man's switch: a process that stops the robots when the one that drives them fails.

It is run by its path, and imports nothing of the package, so that it starts at once and fails with
nothing else. The first line of its input is its job in JSON. Each further byte is a sign of life,
but `q`, which ends it. It sends the stop messages when the input ends, whatever ended it, and while
there are no signs of life.
"""

from __future__ import annotations

import base64
import json
import os
import socket
import sys
import threading
import time
from typing import Any

END_SECONDS = 1.0
"""Time for which robots are commanded to stop at the end, s."""
QUIT = b"q"
"""Byte that ends the guard without further messages."""


class _Life:
    """Signs of life, which a thread reads: pipes cannot be waited for on every system."""

    def __init__(self, read: int) -> None:
        self._read = read
        self.last = time.monotonic()
        self.has_ended = self.has_quit = False
        threading.Thread(target=self._follow, daemon=True).start()

    def _follow(self) -> None:
        while data := os.read(self._read, 65536):
            self.last = time.monotonic()
            self.has_quit |= QUIT in data
        self.has_ended = True


def run(job: dict[str, Any], read: int) -> None:
    """Guard until the input ends.

    Args:
        job: `timeout` and `period` in seconds, and `stops`: lists of a file descriptor of a socket
            or None, host, port and the message in base64.
        read: file descriptor of the input.
    """
    own = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    stops = [
        (own if fd is None else socket.socket(fileno=fd), (host, port), base64.b64decode(data))
        for fd, host, port, data in job["stops"]
    ]
    timeout, period = float(job["timeout"]), float(job["period"])
    life, ended_at = _Life(read), None
    while not life.has_quit:
        now = time.monotonic()
        if life.has_ended and ended_at is None:
            ended_at = now
        if ended_at is not None and now - ended_at > END_SECONDS:
            return
        if life.has_ended or now - life.last > timeout:
            _send(stops)
        time.sleep(period)


def _send(stops: list[tuple[socket.socket, tuple[str, int], bytes]]) -> None:
    for source, address, data in stops:
        try:
            source.sendto(data, address)
        except OSError:  # nobody is there, or the network is down: the next one may arrive
            continue


def _first_line(read: int) -> bytes:
    line = b""
    while not line.endswith(b"\n"):
        byte = os.read(read, 1)
        if not byte:
            sys.exit(0)
        line += byte
    return line


if __name__ == "__main__":
    run(json.loads(_first_line(0)), 0)
