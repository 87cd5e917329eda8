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
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Start new matches in some worlds.

        `Matches` calls this method for new episodes, without `parameters`.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial state rows.
            out: (n, row) output; the rows of the k worlds are overwritten.
            parameters: (k, parameter) factors on the models' numbers in these worlds,
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
    if not has_snapshots(stepper):
        raise TypeError(f"{type(stepper).__name__} has no snapshot and restore")
    return cast(SupportsSnapshots, stepper)


def has_snapshots(stepper: Stepper) -> bool:
    """Return whether a stepper can be saved, unlike robots and other simulators.

    Args:
        stepper: the stepper.
    """
    return _has(stepper, "snapshot", "restore")


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
