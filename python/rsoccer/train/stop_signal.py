"""Ctrl-C and SIGTERM as a polite request: finish, save, leave."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType
from typing import Any, Self

SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Stopped(Exception):
    """Raised by `Stop.check` once a signal has come."""


class Interrupted(SystemExit):
    """A run that a signal ended after it was saved; the exit status tells which signal."""


class Stop:
    """While entered, a first signal only sets a flag; a second one acts as it always does."""

    def __init__(self) -> None:
        """Nothing is caught until the object is entered."""
        self.signal: signal.Signals | None = None
        self._before: dict[signal.Signals, Any] = {}

    def check(self) -> None:
        """Raise `Stopped` if a signal has come."""
        if self.signal is not None:
            raise Stopped(self.signal.name)

    @property
    def name(self) -> str:
        """Name of the signal that came."""
        return "" if self.signal is None else self.signal.name

    @property
    def status(self) -> int:
        """Exit status of a program that this signal ended, by the shell's convention."""
        return 0 if self.signal is None else 128 + self.signal

    def __enter__(self) -> Self:
        """Catch the signals, where Python lets us: in the main thread."""
        if threading.current_thread() is threading.main_thread():
            self._before = {number: signal.signal(number, self._record) for number in SIGNALS}
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Give the signals back."""
        self._give_back()

    def _record(self, number: int, frame: FrameType | None) -> None:
        self.signal = signal.Signals(number)
        self._give_back()

    def _give_back(self) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)
        self._before = {}
