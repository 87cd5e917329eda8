"""A team on the network: the one client that drives it, and the commands that hold."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.frame import RobotColumns
from rsoccer.protocols.layout import WireLayout

_TOLERANCE: Final = 2.5e-3
"""Half a tick: times are sums of ticks, s."""
Address = tuple[str, int]
"""Host and port of a client."""


class Team:
    """Commands of a team's client.

    Times of clients are those of the clock on the wall, in which they fall silent; times of
    commands are simulated, in which robots stop.

    Attributes:
        index: `BLUE` or `YELLOW`.
        address: address of the client that drives the team; None if nobody does.
        commands: (robots, command) commands that hold; only the team's rows are in use.
        refused: messages of other clients that were refused.
        answered: whether the client has sent commands since `await_answer`.
    """

    def __init__(
        self, index: int, layout: WireLayout, command_timeout: float, client_timeout: float
    ) -> None:
        """Begin without a client.

        Args:
            index: `BLUE` or `YELLOW`.
            layout: the match.
            command_timeout: simulated time after which a robot without a command stops, s.
            client_timeout: time after which a silent client has left, s.
        """
        config = layout.config
        self.index = index
        self.slots = layout.slots(index)
        self.address: Address | None = None
        self.refused = 0
        self.answered = False
        self.commands: Floats = np.zeros((config.n_robots, len(config.command_columns)), np.float32)
        self._command_timeout, self._client_timeout = command_timeout, client_timeout
        self._heard = 0.0
        self._commanded: Doubles = np.full(config.n_robots, -np.inf)
        self._own = slice(self.slots.start, self.slots.stop)
        self._own_commands = self.commands[self._own]
        self._own_commanded = self._commanded[self._own]
        self._next_stop = math.inf  # simulated time, s
        self._fixed: dict[int, tuple[float, float]] = {}

    def accept(self, address: Address, now: float) -> bool:
        """Return whether a client may drive the team; it does from now on if so.

        Args:
            address: address of the client.
            now: time on the wall, s.
        """
        self.expire(now)
        if self.address is None:
            self.release()
            self.address = address
        if self.address != address:
            self.refused += 1
            return False
        self._heard = now
        return True

    def expire(self, now: float) -> bool:
        """Return whether the team was released, which it is if its client is silent.

        Args:
            now: time on the wall, s.
        """
        if self.address is None:
            return False
        if now < self._heard:  # a clock that was set back does not keep a silent client
            self._heard = now
        if now - self._heard <= self._client_timeout:
            return False
        self.release()
        return True

    def release(self) -> None:
        """Stop all robots and let another client drive."""
        self.address, self.answered = None, False
        self.commands[:] = 0.0
        self._commanded[:] = -np.inf
        self._next_stop = math.inf
        self._fixed.clear()

    def hold(
        self,
        commands: Floats,
        given: Mask,
        seconds: float,
        fixed: Mapping[int, tuple[float, float]] = MappingProxyType({}),
        moved: Mask | None = None,
    ) -> None:
        """Take over the commands of a message.

        Args:
            commands: (robots, command) commands.
            given: (robots,) robots of the team that the message has.
            seconds: simulated time, s.
            fixed: velocities along the field's x and y in the package, m/s, by index in a state
                row, of robots that keep them while they turn.
            moved: (robots,) robots whose velocity the message has; None for all given. The others
                keep theirs.
        """
        # Other robots keep what they have: clients may send a packet for each robot.
        own = given[self._own]
        np.copyto(self._own_commands, commands[self._own], where=own[:, None])
        if self._fixed:
            turned = own if moved is None else own & moved[self._own]
            for slot in (np.flatnonzero(turned) + self.slots.start).tolist():
                self._fixed.pop(slot, None)
        if fixed:
            self._fixed.update(fixed)
        np.copyto(self._own_commanded, seconds, where=own)
        self._next_stop = min(self._next_stop, seconds + self._command_timeout + _TOLERANCE)
        self.answered = True

    def previous(self, seconds: float) -> Floats:
        """Return the commands that a message continues; zeros of robots that have stopped.

        Args:
            seconds: simulated time, s.
        """
        self._stop_silent(seconds)
        return self.commands

    def write(
        self, commands: Floats, seconds: float, stand_in: Floats | None, robots: RobotColumns
    ) -> None:
        """Write the commands of the team's robots for the next tick.

        Args:
            commands: (robots, command) output; only the team's rows are written.
            seconds: simulated time, s.
            stand_in: (robots, command) commands of a policy for robots that the client has never
                commanded; None if they stand still.
            robots: (1, robots, ...) states of all robots.
        """
        team = self._own
        if self.address is None:
            commands[team] = 0.0 if stand_in is None else stand_in[team]
            return
        if self._fixed:
            headings = robots.heading[0]
            for slot, (x, y) in self._fixed.items():
                cos, sin = headings[slot].tolist()
                self.commands[slot, :2] = cos * x + sin * y, cos * y - sin * x
        self._stop_silent(seconds)
        commands[team] = self._own_commands
        if stand_in is not None:
            never = np.flatnonzero(np.isneginf(self._own_commanded)) + self.slots.start
            commands[never] = stand_in[never]

    def _stop_silent(self, seconds: float) -> None:
        if seconds <= self._next_stop:
            return
        silent = self._commanded + self._command_timeout + _TOLERANCE < seconds
        self.commands[silent] = 0.0
        for slot in np.flatnonzero(silent).tolist():
            self._fixed.pop(slot, None)
        moving = self._commanded[~silent]
        self._next_stop = (
            float(moving.min()) + self._command_timeout + _TOLERANCE if len(moving) else math.inf
        )
