"""The referee of a connection: its packets, and what robots may do under it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Floats
from rsoccer.drive.limits import limited, stopped
from rsoccer.drive.settings import Limits, Settings
from rsoccer.frame import Frame
from rsoccer.game import BLUE, YELLOW, Command
from rsoccer.protocols.ball_in_play import team_of
from rsoccer.protocols.commands import CommandRow, motion
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.referee import RUNNING
from rsoccer.protocols.reported_referee import ReportedReferee
from rsoccer.rules.referee_config import RefereeConfig

SILENCE: Final = 5.0
"""Time without a packet after which a referee that was heard is taken to have halted the match, s.
The game controller sends at 40 Hz, VSSReferee repeats its command."""
KEEP_AWAY: Final = 0.55
"""Distance of a robot's center from the ball when the other team has the kick or play is stopped,
m: 0.5 m by the rules of the SSL, and the error of a tracker."""
GAP: Final = 0.05
"""Gap to the ball of a robot that waits for the start of its own team's kick, m."""
RETREAT: Final = 0.5
"""Greatest speed away from the ball of a robot that is too near, m/s."""
APPROACH: Final = 2.0
"""Greatest approach to the distance, 1/s: speed by what is left of the way."""


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
        command = self.reported.state.command
        if settings.league == "vsss":
            return command not in RUNNING  # people or the simulator place robots meanwhile
        return command is Command.HALT

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
        state = self.reported.state
        command = state.command
        if not self._keeps_away:
            return commands
        allowed = np.array(commands, np.float32)
        limits = Limits()
        if command is Command.STOP:
            limits = Limits(speed=self._settings.limits.stop_speed, kick_speed=0.0)
        kicking = team_of(state.kick if command is Command.NORMAL_START else command)
        for team in (BLUE, YELLOW):
            if state.may_touch(team):
                continue
            slots = (
                range(layout.config.n_blue)
                if team == BLUE
                else range(layout.config.n_blue, layout.config.n_robots)
            )
            for slot in slots:
                model = layout.config.robots[slot]
                own = kicking == team
                touching = model.radius + layout.config.ball.radius
                distance = touching + GAP if own else KEEP_AWAY
                allowed[slot] = _away(model, allowed[slot], frame, slot, distance)
                allowed[slot] = limited(model, allowed[slot], replace(limits, kick_speed=0.0))
        return allowed


def _away(model: RobotModel, command: Floats, frame: Frame, slot: int, distance: float) -> Floats:
    """A command that keeps a robot at a distance from the ball, and does not dribble."""
    offset = frame.robots.position[0, slot] - frame.ball.position[0]
    gap = float(np.hypot(*offset))
    away = offset / gap if gap > 1e-6 else np.array([1.0, 0.0], np.float32)
    cos, sin = frame.robots.heading[0, slot].tolist()
    asked = motion(model, command)
    forward, left, turn = asked.velocity
    velocity = np.array([cos * forward - sin * left, sin * forward + cos * left])
    outward = float(velocity @ away)
    least = min(APPROACH * (distance - gap), RETREAT)
    row = np.array(command, np.float32)
    made = CommandRow(model, row)
    made.dribble(0.0)
    if outward < least and model.drive != "differential":
        x, y = (velocity + (least - outward) * away).tolist()
        made.drive(cos * x + sin * y, cos * y - sin * x, turn)
    return row
