"""Interfaces of what moves the robots of `Matches`: a simulator, one over a network, real robots.

All of them are a `Stepper`: commands in, state rows out. A simulator that can put bodies anywhere
is a `Placer` too. Robots cannot, and neither can some simulators over a network; these are a
`Reader`, and episodes begin with the state as it is. `rsoccer.Simulator` is everything but a
`Closer`. One that reports only poses becomes complete by `rsoccer.completed`.

Each method that writes rows may return time stamps: (n,) float64, the time at which each row was
true, in seconds on any clock that runs evenly. `Play.times` has them. None says that every control
step lasts exactly `config.time_step`.
"""

from typing import Protocol, cast

import numpy as np

from rsoccer.arrays import Doubles, Floats, Mask


class Stepper(Protocol):
    """Robots and balls of n worlds that execute commands."""

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        """Advance the active worlds by one control step.

        Real robots execute the commands for the time of a control step. Any exception leaves the
        calling `Matches` inconsistent until new episodes begin in all worlds.

        Args:
            commands: (n, robots, command) commands in SI units, `config.command_columns`.
            out: (n, row) output; the rows of the active worlds are overwritten.
            active: (n,) bool, worlds to advance; all if None.

        Returns:
            Time stamps, or None.
        """


class Reader(Protocol):
    """A stepper that tells its present state, from which episodes can begin."""

    def read(self, out: Floats) -> Doubles | None:
        """Write the present state of all worlds, without touches and crossings of the past.

        Args:
            out: (n, row) output.

        Returns:
            Time stamps, or None.
        """


class Placer(Protocol):
    """A stepper that can put bodies anywhere."""

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, params: Floats | None = None
    ) -> Doubles | None:
        """Start new matches in some worlds.

        `Matches` calls this method for new episodes, without `params`.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial state rows.
            out: (n, row) output; the rows of the k worlds are overwritten.
            params: (k, parameters) factors on the models' numbers in these worlds,
                `BALL_PARAMETERS` and then `ROBOT_PARAMETERS` of each robot; the simulator's choice
                if None.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: bodies that overlap or are outside, or factors out of their range. The state
                must be unchanged.
        """

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        """Put all bodies of some running matches into a new state, as a referee does.

        The worlds keep their factors on the models' numbers, and their clocks go on. `Matches`
        calls this method for a `Restart` with `rows`.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) new state rows.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: bodies that overlap or are outside. The state must be unchanged.
        """

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        """Move the balls of some worlds; their robots and clocks go on.

        `Matches` calls this method for a `Restart` with `balls`.

        Args:
            worlds: (n,) bool, k of them True.
            balls: (k, ball column) new ball states; position, velocity and spin count.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: a ball inside a robot or outside. The state must be unchanged.
        """


class Closer(Protocol):
    """A stepper that holds something to be released, such as a socket."""

    def close(self) -> None:
        """Stop the robots and release what is held; `Matches.close` calls this method."""


class SupportsSnapshots(Protocol):
    """A stepper that `Matches.state_dict` can save."""

    def snapshot(self) -> bytes:
        """Return the exact state of all worlds."""

    def restore(self, snapshot: bytes) -> None:
        """Overwrite all worlds with a saved state.

        Args:
            snapshot: bytes from `snapshot`.

        Raises:
            ValueError: bytes that are damaged or from another simulator. The state must be
                unchanged.
        """


def require_snapshots(stepper: Stepper) -> SupportsSnapshots:
    """Return a stepper after a check that it can be saved.

    Args:
        stepper: the stepper.

    Raises:
        TypeError: it has no `snapshot` or no `restore`.
    """
    if not _has(stepper, "snapshot", "restore"):
        raise TypeError(f"{type(stepper).__name__} has no snapshot and restore")
    return cast(SupportsSnapshots, stepper)


def placer_of(stepper: Stepper) -> Placer | None:
    """Return a stepper that can place bodies, or None.

    Args:
        stepper: the stepper.
    """
    placing = _has(stepper, "place", "restart", "reposition_balls")
    return cast(Placer, stepper) if placing else None


def reader_of(stepper: Stepper) -> Reader | None:
    """Return a stepper that tells its present state, or None.

    Args:
        stepper: the stepper.
    """
    return cast(Reader, stepper) if _has(stepper, "read") else None


def close(stepper: Stepper) -> None:
    """Close a stepper, if it can be closed.

    Args:
        stepper: the stepper.
    """
    if _has(stepper, "close"):
        cast(Closer, stepper).close()


def _has(stepper: Stepper, *methods: str) -> bool:
    """Whether it has all methods; one that forwards them by `__getattr__` has them, too."""
    return all(callable(getattr(stepper, name, None)) for name in methods)


class Starts:
    """The ways in which episodes begin and play restarts with a stepper."""

    def __init__(self, stepper: Stepper) -> None:
        """Choose the ways.

        Args:
            stepper: a `Placer`, or else a `Reader`.

        Raises:
            TypeError: it is neither.
        """
        self._placer, self._reader = placer_of(stepper), reader_of(stepper)
        self._name = type(stepper).__name__
        if self._placer is None and self._reader is None:
            raise TypeError(
                "simulator: expected one that can place bodies (place, restart, "
                f"reposition_balls) or read its state (read), got {self._name} with neither"
            )

    @property
    def can_place(self) -> bool:
        """True if bodies can be put anywhere; else episodes begin with the state as it is."""
        return self._placer is not None

    def check_rows(self) -> None:
        """Refuse initial states that are given from outside.

        Raises:
            ValueError: bodies cannot be placed.
        """
        if self._placer is None:
            raise ValueError(
                f"rows: {self._name} cannot place bodies, so episodes begin with the state as it "
                "is; expected None"
            )

    def begin(self, worlds: Mask, rows: Floats | None, out: Floats) -> Doubles | None:
        """Begin episodes in some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial states; None for the state as it is.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.

        Raises:
            ValueError: a state that is not finite. Nothing has changed.
        """
        if self._placer is not None and rows is not None:
            return self._placer.place(worlds, rows, out)
        assert self._reader is not None, "the constructor has checked it"
        present = np.empty_like(out)
        times = self._reader.read(present)
        if not np.isfinite(present[worlds]).all():
            raise ValueError(f"{self._name}.read: expected finite numbers")
        out[worlds] = present[worlds]
        return times

    def restart(
        self, worlds: Mask, rows: Floats | None, balls: Floats | None, out: Floats
    ) -> Doubles | None:
        """Restart play in some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) new states of all bodies, or None.
            balls: (k, ball column) new states of the balls, or None.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.

        Raises:
            RuntimeError: bodies cannot be placed.
        """
        if self._placer is None:
            raise RuntimeError(
                f"a rule restarts play in worlds {np.flatnonzero(worlds).tolist()}, but "
                f"{self._name} cannot place bodies; rsoccer.placed_by_hand.PlacedByHand asks "
                "people, or code of yours, to place them"
            )
        if balls is not None:
            return self._placer.reposition_balls(worlds, balls, out)
        assert rows is not None, "a restart has rows or balls"
        return self._placer.restart(worlds, rows, out)
