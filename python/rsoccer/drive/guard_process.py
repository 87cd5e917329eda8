"""The side of the driving process of the dead man's switch."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import subprocess
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Final

from rsoccer.drive.guard import QUIT
from rsoccer.drive.link import SocketLink
from rsoccer.drive.peers import Message

SIGNS_IN_TIMEOUT: Final = 6
"""Signs of life in the time after which the guard acts."""
MAX_PERIOD: Final = 1.0
"""Longest time between signs of life, s: they show as well that the guard lives."""
_GUARD: Final = Path(__file__).with_name("guard.py")


class GuardProcess:
    """A running guard.

    Attributes:
        pid: number of the process.
    """

    def __init__(
        self, link: SocketLink, stops: Iterable[Message], timeout: float, rate: float
    ) -> None:
        """Start the guard.

        It sends from the sockets of the link where it can inherit them, since simulators take
        commands of one address alone.

        Args:
            link: sockets and addresses of the ports.
            stops: messages that stop the robots.
            timeout: time without a sign of life after which it sends them, s; infinite for a guard
                that acts only when this process ends.
            rate: rate at which it repeats them, Hz.

        Raises:
            OSError: it cannot be started.
        """
        inherits = os.name == "posix"
        listed, sockets = [], []
        for stop in stops:
            fd = link.socket_of(stop.port).fileno() if inherits else None
            host, port = link.addresses[stop.port]
            listed.append([fd, host, port, base64.b64encode(stop.data).decode()])
            sockets += [] if fd is None else [fd]
        job = {"timeout": timeout, "period": 1.0 / rate, "stops": listed}
        self._process = subprocess.Popen(
            [sys.executable, "-I", "-S", str(_GUARD)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            pass_fds=tuple(dict.fromkeys(sockets)),
            start_new_session=inherits,  # Ctrl-C in a terminal is for the driving process alone
        )
        self.pid = self._process.pid
        self._period = min(timeout / SIGNS_IN_TIMEOUT, MAX_PERIOD)
        self._last = 0.0
        assert self._process.stdin is not None, "it was asked for"
        self._input = self._process.stdin.fileno()
        os.write(self._input, json.dumps(job).encode() + b"\n")
        if inherits:
            os.set_blocking(self._input, False)

    def sign(self) -> None:
        """Give a sign of life, if one is due.

        Raises:
            RuntimeError: the guard has ended.
        """
        now = time.monotonic()
        if now - self._last < self._period:
            return
        self._last = now
        try:
            os.write(self._input, b".")
        except BlockingIOError:
            pass  # it has not read the last ones, which are signs as well
        except OSError as error:
            raise RuntimeError("guard: the process that stops robots has ended") from error

    def close(self, *, has_stopped: bool = False) -> None:
        """End the guard.

        Args:
            has_stopped: whether the robots are known to stand, so that nothing is left to send.
        """
        if has_stopped:
            with contextlib.suppress(OSError):
                os.write(self._input, QUIT)
        if self._process.stdin is not None:
            self._process.stdin.close()
        self._process.wait()
