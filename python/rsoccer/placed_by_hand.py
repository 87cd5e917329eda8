"""Placement of bodies by people, or by the robots themselves, for steppers that cannot place."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from rsoccer._core import BALL_COLUMNS
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.simulator_interface import Reader, Stepper, close


class ReadableStepper(Stepper, Reader, Protocol):
    """A stepper that tells its present state."""


@dataclass(frozen=True, eq=False)
class Placement:
    """A wanted state of some worlds."""

    worlds: Mask
    """(n,) bool, k worlds in which bodies are to be placed."""
    rows: Floats
    """(k, row) wanted states."""
    ball_only: bool
    """True: only the ball is to be moved; the robots may be anywhere."""


class PlacedByHand:
    """A stepper that asks for each placement, and goes on with the state that it finds then.

    So a rule can restart play on real robots: `ask` tells people where the ball belongs and waits
    for a key, drives the robots there, or returns at once where play shall go on as it is. The
    stepper gets no commands in the meantime, so its robots must stop without them.

    Example:
        >>> def ask(placement):
        ...     input(f"Place the ball at {placement.rows[0, :2]} m and press return.")
        >>> # matches = Matches(task, simulator=PlacedByHand(robots, ask))
    """

    def __init__(self, stepper: ReadableStepper, ask: Callable[[Placement], None]) -> None:
        """Put the placement over a stepper.

        Args:
            stepper: robots of n worlds with `step` and `read`.
            ask: called with each wanted placement; returns when play can go on.
        """
        self._stepper, self._ask = stepper, ask

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        """Advance the active worlds by one control step.

        Args:
            commands: (n, robots, command) commands in SI units.
            out: (n, row) output.
            active: (n,) bool, worlds to advance; all if None.

        Returns:
            Time stamps, or None.
        """
        return self._stepper.step(commands, out, active)

    def read(self, out: Floats) -> Doubles | None:
        """Write the present state of all worlds.

        Args:
            out: (n, row) output.

        Returns:
            Time stamps, or None.
        """
        return self._stepper.read(out)

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Ask for the initial states of new episodes.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) wanted states.
            out: (n, row) output; the rows of the k worlds become the states that are found.
            parameters: None.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: factors on the numbers of models, which nobody can change by hand.
        """
        if parameters is not None:
            raise ValueError("parameters: expected None, because robots are as they are")
        return self._placed(worlds, rows, out, ball_only=False)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        """Ask for new states of all bodies.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) wanted states.
            out: (n, row) output; the rows of the k worlds become the states that are found.

        Returns:
            Time stamps, or None.
        """
        return self._placed(worlds, rows, out, ball_only=False)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        """Ask for new places of the balls.

        Args:
            worlds: (n,) bool, k of them True.
            balls: (k, ball column) wanted balls.
            out: (n, row) present state; the rows of the k worlds become the states that are found.

        Returns:
            Time stamps, or None.
        """
        rows = out[worlds]
        rows[:, : len(BALL_COLUMNS)] = balls
        return self._placed(worlds, rows, out, ball_only=True)

    def close(self) -> None:
        """Close the stepper, if it can be closed."""
        close(self._stepper)

    def _placed(
        self, worlds: Mask, rows: Floats, out: Floats, *, ball_only: bool
    ) -> Doubles | None:
        """Ask for a state, and read the one that is found."""
        self._ask(Placement(worlds.copy(), rows.copy(), ball_only))
        present = np.empty_like(out)
        times = self._stepper.read(present)
        out[worlds] = present[worlds]
        return times
