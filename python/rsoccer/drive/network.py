"""Places on the network that every interface takes as `simulator=`, and their names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from rsoccer import checks
from rsoccer._core import Sensing, SimConfig, Threads
from rsoccer.drive.connection import Connection
from rsoccer.drive.settings import Settings
from rsoccer.drive.simulator import NetworkSimulator, NetworkStepper
from rsoccer.game import BLUE, YELLOW

CAMERA_NUMBERS: Final = (
    *("frame_rate", "ball_position_noise", "robot_position_noise", "heading_noise"),
)
"""Numbers of `Sensing` with which the tracker of detections counts."""


def forecasting(delay: float, cameras: str | Sensing | None = None) -> Sensing | None:
    """Return the senses of robots that know their state ahead of a delay.

    Args:
        delay: time from a command until vision shows its effect, s, 0 or above, as
            `rsoccer drive --check` measures it.
        cameras: senses whose noise and frame rate those of the cameras are; None for those of
            "rc2021" at 60 Hz. `rsoccer identify` measures them.

    Returns:
        Senses for `Matches(sensing=...)`; None without delay and cameras.

    Raises:
        TypeError: cameras of another type.
        ValueError: a delay outside 0 to 1, or a text that names no preset and no file.
    """
    delay = checks.number_in_range("delay", delay, 0.0, 1.0)
    numbers: dict[str, Any] = {"command_delay": delay, "forecast": 1.0} if delay else {}
    if cameras is not None:
        try:
            model = Sensing(cameras) if isinstance(cameras, str) else cameras
        except (FileNotFoundError, ValueError) as error:
            raise ValueError(f"cameras: {error}") from error
        if not isinstance(model, Sensing):
            raise TypeError(
                f"cameras: expected a Sensing, or the name of a preset, got {cameras!r}"
            )
        numbers |= {name: getattr(model, name) for name in CAMERA_NUMBERS}
    return Sensing(**numbers) if numbers else None


class Network:
    """A place on the network that `simulator=` of every interface takes.

    Matches that come one after the other share the connection: between them the robots stand. It
    ends with `close`, or with the process.

    Attributes:
        plays_one_match: True, as there is one match on the network.

    Example:
        >>> from rsoccer.drive import Limits, Network, Settings
        >>> network = Network(Settings("grsim", limits=Limits(speed=1.0)))
        >>> # rsoccer.evaluate("best", simulator=network, worlds=1)
    """

    plays_one_match: Final = True

    def __init__(
        self,
        settings: Settings,
        kind: type[NetworkStepper] = NetworkSimulator,
        drives: Sequence[int] = (BLUE, YELLOW),
    ) -> None:
        """Name a place; the first matches open the connection.

        Args:
            settings: the settings.
            kind: what happens when bodies are to be put: `NetworkSimulator` puts them,
                `UntouchedNetwork` leaves them, and with `NetworkStepper` episodes begin as it is.
            drives: teams to drive, in the package.
        """
        self.settings, self.kind, self.drives = settings, kind, tuple(drives)
        self._connection: Connection | None = None

    def __call__(self, config: SimConfig, worlds: int, threads: Threads) -> NetworkStepper:
        """Return the simulator of a match; see `rsoccer.sources.SimulatorFactory`.

        Args:
            config: field, ball and robots.
            worlds: 1.
            threads: not used.

        Raises:
            OSError: a port is taken, or an address is not one of this machine.
            ValueError: another number of worlds, or robots that the peer cannot have.
        """
        if worlds != 1:
            raise ValueError(f"worlds: expected 1 with a simulator on a network, got {worlds}")
        if self._connection is not None and self._connection.config != config:
            self.close()
        if self._connection is None:
            self._connection = Connection(config, self.settings, drives=self.drives)
        self._connection.on_sent.clear()
        return self.kind(self._connection, is_owner=False)

    def close(self) -> None:
        """Close the connection; a second call does nothing."""
        if self._connection is not None:
            self._connection.close()
        self._connection = None

    def __getstate__(self) -> tuple[object, ...]:
        """Return what a copy in another process needs: it opens a connection of its own."""
        return self.settings, self.kind, self.drives

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        """Take over settings.

        Args:
            state: what `__getstate__` returned.
        """
        self.settings, self.kind, self.drives = state
        self._connection = None


grsim: Final = Network(Settings("grsim"))
"""grSim on this machine at its usual ports: `simulator="grsim"`."""
firasim: Final = Network(Settings("firasim"))
"""FIRASim on this machine at its usual ports: `simulator="firasim"`."""
ssl_simulation: Final = Network(Settings("ssl-simulation"))
"""A simulator on this machine that speaks the simulation protocol of the SSL, with vision at the
port of SSL-Vision, 10006: `simulator="ssl-simulation"`."""
