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
import selectors
import socket
import sys
import time
from typing import Any

END_SECONDS = 1.0
"""Time for which robots are commanded to stop at the end, s."""
QUIT = b"q"
"""Byte that ends the guard without further messages."""


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
    last, end = time.monotonic(), float("inf")
    with selectors.DefaultSelector() as selector:
        selector.register(read, selectors.EVENT_READ)
        while time.monotonic() < end:
            for _ in selector.select(period):
                data = os.read(read, 65536)
                last = time.monotonic()
                if QUIT in data:
                    return
                if not data:
                    selector.unregister(read)
                    end = last + END_SECONDS
            if end != float("inf") or time.monotonic() - last > timeout:
                _send(stops)
            if end != float("inf"):
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
