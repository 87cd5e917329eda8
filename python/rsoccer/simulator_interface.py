"""Interface of simulators that `Matches` can use: `rsoccer.Simulator`, others, or real robots."""

from typing import Protocol, runtime_checkable

from rsoccer.arrays import Floats, Mask


class SimulatorLike(Protocol):
    """Simulator of the robots and balls of n worlds, such as `rsoccer.Simulator`."""

    def place(self, worlds: Mask, rows: Floats, out: Floats, params: Floats | None = None) -> None:
        """Start new matches in some worlds.

        `Matches` calls this method for new episodes, without `params`.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial state rows.
            out: (n, row) output; the rows of the k worlds are overwritten.
            params: (k, parameters) factors on the models' numbers in these worlds,
                `BALL_PARAMETERS` and then `ROBOT_PARAMETERS` of each robot; the simulator's choice
                if None.

        Raises:
            ValueError: bodies that overlap or are outside, or factors out of their range. The state
                must be unchanged.
        """

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        """Put all bodies of some running matches into a new state, as a referee does.

        The worlds keep their factors on the models' numbers, and their clocks go on. `Matches`
        calls this method only for tasks that override `Task.restart_play`.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) new state rows.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Raises:
            ValueError: bodies that overlap or are outside. The state must be unchanged.
        """

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
        """Move the balls of some worlds; their robots and clocks go on.

        `Matches` calls this method only for tasks that override `Task.reposition_ball`.

        Args:
            worlds: (n,) bool, k of them True.
            balls: (k, ball column) new ball states; position, velocity and spin count.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Raises:
            ValueError: a ball inside a robot or outside. The state must be unchanged.
        """

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        """Advance the active worlds by one control step.

        Any exception leaves the calling `Matches` inconsistent until all worlds are placed again.

        Args:
            commands: (n, robots, command) commands in SI units.
            out: (n, row) output; the rows of the active worlds are overwritten.
            active: (n,) bool, worlds to advance; all if None.
        """


@runtime_checkable
class SupportsSnapshots(Protocol):
    """Additional methods of a simulator that `Matches.state_dict` can save."""

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


def require_snapshots(simulator: SimulatorLike) -> SupportsSnapshots:
    """Return a simulator after a check that it can be saved.

    Args:
        simulator: the simulator.

    Raises:
        TypeError: the simulator has no `snapshot` or no `restore`.
    """
    if not isinstance(simulator, SupportsSnapshots):
        raise TypeError(f"{type(simulator).__name__} has no snapshot and restore")
    return simulator
