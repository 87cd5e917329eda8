"""What `Matches` needs of whatever moves the robots: ours, another simulator, or real robots."""

from typing import Protocol, runtime_checkable

from rsoccer.frame import Floats, Mask


class Worlds(Protocol):
    """Moves the robots of n worlds. `rsoccer.Simulator` is one."""

    def place(self, worlds: Mask, rows: Floats, out: Floats) -> None:
        """Start the worlds of the mask (n,) at `rows` (k, row); write their rows into `out`."""

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> None:
        """Put the balls (k, ball column) of the worlds of the mask (n,) elsewhere, and only them.

        Robots and all else go on; write the rows of these worlds into `out`. Only tasks with a
        `reposition_ball` of their own ask for it.
        """

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        """Move active worlds one control step; write their rows into `out` (n, row).

        May raise; `Matches` are torn then, until all worlds are placed anew.
        """


@runtime_checkable
class Snapshots(Protocol):
    """What it must do besides, to be saved with `Matches.state_dict`."""

    def snapshot(self) -> bytes:
        """All worlds, exactly."""

    def restore(self, snapshot: bytes) -> None:
        """Go back to a snapshot."""


def snapshots(simulator: Worlds) -> Snapshots:
    """The simulator as what can be saved, or TypeError if it cannot."""
    if not isinstance(simulator, Snapshots):
        raise TypeError(f"{type(simulator).__name__} has no snapshot and restore")
    return simulator
