"""The referee of a connection: its packets, and what robots may do under it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from rsoccer.arrays import Floats
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.limits import stopped
from rsoccer.protocols.reported_referee import ReportedReferee
from rsoccer.protocols.restraint import must_stand, restrained
from rsoccer.rules.referee_config import RefereeConfig

SILENCE: Final = 5.0
"""Time without a packet after which a referee that was heard is taken to have halted the match, s.
The game controller sends at 40 Hz, VSSReferee repeats its command."""


class Officials:
    """A referee on the network.

    Attributes:
        reported: what its packets tell.
        packets: packets so far.
    """

    def __init__(
        self, settings: Settings, rules: RefereeConfig | None, clock: Callable[[], float]
    ) -> None:
        """Begin before the first packet.

        Args:
            settings: the settings.
            rules: rules of the match; None for those of the league.
            clock: time on the wall, s.
        """
        preset = "vsss_3v3" if settings.league == "vsss" else "ssl_2026_b"
        self.reported = ReportedReferee(RefereeConfig(preset) if rules is None else rules)
        self.packets = 0
        self._settings, self._clock = settings, clock
        self._heard_at = clock()

    def receive(self, layout: WireLayout, data: bytes) -> None:
        """Take in a packet.

        Args:
            layout: the match.
            data: the bytes.

        Raises:
            ValueError: no packet of the league's referee, a `MessageError`.
        """
        self.reported.receive(layout, data)
        self.packets += 1
        self._heard_at = self._clock()

    @property
    def is_halted(self) -> bool:
        """True if all robots must stand still."""
        settings = self._settings
        if settings.referee == "ignore":
            return False
        if not self.packets:
            return settings.referee == "require"
        if not settings.is_synchronous and self._clock() - self._heard_at > SILENCE:
            return True
        return must_stand(self.reported.state, is_vsss=settings.league == "vsss")

    @property
    def is_awaited(self) -> bool:
        """True if no packet has come, and none is needed for robots to drive."""
        return not self.packets and self._settings.referee == "obey"

    @property
    def words(self) -> str:
        """Words for what the referee demands."""
        if not self.packets:
            return "no packet of a referee"
        if not self._settings.is_synchronous and self._clock() - self._heard_at > SILENCE:
            return f"none for {SILENCE:g} s"
        command = self.reported.state.command
        return "no command" if command is None else command.name

    def restrains(self, team: int) -> bool:
        """Return whether a team's robots stand still or keep away from the ball.

        Args:
            team: `BLUE` or `YELLOW`, in the package.
        """
        return self.is_halted or (self._keeps_away and not self.reported.state.may_touch(team))

    @property
    def _keeps_away(self) -> bool:
        """Whether robots that may not touch the ball are kept away from it."""
        settings = self._settings
        is_known = self.reported.state.command is not None
        return is_known and settings.referee != "ignore" and settings.league == "ssl"

    def restrain(self, layout: WireLayout, commands: Floats, frame: Frame) -> Floats:
        """Return commands that the referee allows.

        Args:
            layout: the match.
            commands: (robots, command) commands of all robots.
            frame: frame of one world, what is known.

        Returns:
            (robots, command), the commands themselves where they may be.
        """
        if self.is_halted:
            return stopped(commands)
        if not self._keeps_away:
            return commands
        stop_speed = self._settings.limits.stop_speed
        return restrained(layout.config, self.reported.state, commands, frame, stop_speed)
