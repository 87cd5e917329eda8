"""Ctrl-C and SIGTERM during training: the run saves a checkpoint before it ends."""

from __future__ import annotations

import signal
import threading
from types import FrameType, TracebackType
from typing import Any, Self

SIGNALS = (signal.SIGINT, signal.SIGTERM)
"""Signals that stop a run."""


class Stopped(Exception):
    """A signal came; `StopSignal.check` raises it inside the run."""


class Interrupted(SystemExit):
    """The run saved its checkpoint after a signal; the exit status encodes the signal."""


class StopSignal:
    """Context manager in which the first signal sets a flag and the second acts as usual.

    Attributes:
        signal: the signal that came, or None.
    """

    def __init__(self) -> None:
        """Create the flag; signals are caught only inside the `with` block."""
        self.signal: signal.Signals | None = None
        self._previous: dict[signal.Signals, Any] = {}

    def check(self) -> None:
        """Do nothing unless a signal has come.

        Raises:
            Stopped: a signal has come.
        """
        if self.signal is not None:
            raise Stopped(self.signal.name)

    @property
    def name(self) -> str:
        """Name of the signal that came; empty if none did."""
        return "" if self.signal is None else self.signal.name

    @property
    def exit_status(self) -> int:
        """128 + the number of the signal, as shells report a program that it ended; else 0."""
        return 0 if self.signal is None else 128 + self.signal

    def __enter__(self) -> Self:
        """Catch the signals; Python allows that in the main thread only."""
        if threading.current_thread() is threading.main_thread():
            self._previous = {number: signal.signal(number, self._record) for number in SIGNALS}
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Restore the previous signal handlers."""
        self._restore_handlers()

    def _record(self, number: int, frame: FrameType | None) -> None:
        """Handle the first signal."""
        self.signal = signal.Signals(number)
        self._restore_handlers()

    def _restore_handlers(self) -> None:
        """Install the handlers from before the `with` block."""
        for number, handler in self._previous.items():
            signal.signal(number, handler)
        self._previous = {}
