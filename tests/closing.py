"""A simulator that counts how often it is closed, planted into whatever plays matches."""

from collections.abc import Callable
from typing import Any

import pytest

from rsoccer import SimConfig, Simulator
from rsoccer._core import Threads
from rsoccer.arrays import Floats, Mask


class LostError(Exception):
    """Error of a step of a simulator."""


class Closing:
    """The package's simulator, which counts how often it is closed and may fail in a step."""

    def __init__(
        self, config: SimConfig, worlds: int, threads: Threads, fails_after: int | None = None
    ) -> None:
        self.own = Simulator(config, worlds, threads)
        self.closed, self._steps_left = 0, fails_after

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self.own, name)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        assert not self.closed, "a step after close"
        if self._steps_left is not None:
            self._steps_left -= 1
            if self._steps_left < 0:
                raise LostError("the connection is lost")
        self.own.step(commands, out, active)

    def close(self) -> None:
        self.closed += 1


class Planted:
    """A factory of such simulators, which keeps them: "tests.closing:PLANTED"."""

    def __init__(self) -> None:
        self.made: list[Closing] = []
        self.fails_after: int | None = None

    def __call__(self, config: SimConfig, worlds: int, threads: Threads) -> Closing:
        self.made.append(Closing(config, worlds, threads, self.fails_after))
        return self.made[-1]

    def clear(self, fails_after: int | None = None) -> None:
        """Forget all simulators; later ones fail after a number of steps, if one is given."""
        self.made.clear()
        self.fails_after = fails_after

    def closed(self) -> list[int]:
        """Return how often each simulator was closed; there is at least one."""
        assert self.made, "a simulator was made"
        return [simulator.closed for simulator in self.made]


PLANTED = Planted()


def check_closing(close: Callable[[], object], failing: Callable[[], object] | None = None) -> None:
    """Check that what has played matches closes its simulators when it is closed, and once.

    Args:
        close: closes what has played.
        failing: a step that fails, which closes nothing; None without one.
    """
    if failing is not None:
        with pytest.raises(LostError):
            failing()
    assert PLANTED.closed() == [0]
    close()
    assert PLANTED.closed() == [1]
    close()
    assert PLANTED.closed() == [1]


TEXT = "tests.closing:PLANTED"
