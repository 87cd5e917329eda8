"""The ball in play or not, from the commands of a referee and the way of the ball."""

from __future__ import annotations

import math
from typing import Final

from rsoccer.game import BLUE, NOBODY, YELLOW, Command
from rsoccer.rules.referee_config import RefereeConfig

_PREPARED: Final = tuple(
    command for command in Command if command.name.startswith(("PREPARE", "GOAL_KICK", "FREE_BALL"))
)
_DIRECT: Final = (Command.DIRECT_FREE_BLUE, Command.DIRECT_FREE_YELLOW)
_PENALTIES: Final = (Command.PREPARE_PENALTY_BLUE, Command.PREPARE_PENALTY_YELLOW)
_KICKOFFS: Final = (Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW)


class BallInPlay:
    """A kick from its command until the ball is in play.

    Packets of a referee do not tell when a kick was taken: a free kick has no command to start
    play, and one that starts a kick-off lets the other team wait. In the SSL the ball is in play
    once it has moved by `in_play_distance` or the time for the kick is over, but for penalty kicks
    ("Ball In And Out Of Play" of the rules). In VSSS a start lets all robots play.

    Attributes:
        command: command of the referee; None before the first.
        kick: command that prepared or allowed the kick to come, or was taken last; None for
            none, or after a stop.
        steps: steps since the command began; `judge` counts them.
        in_play: whether the ball is in play.
        kick_position: place of the ball at the kick, x and y, m; None before it is known.
    """

    def __init__(self, rules: RefereeConfig) -> None:
        """Begin before the first command.

        Args:
            rules: rules of the match.
        """
        self._rules = rules
        self._is_ssl = rules.preset.startswith("ssl")
        self.command: Command | None = None
        self.kick: Command | None = None
        self.steps = 0
        self.in_play = False
        self.kick_position: tuple[float, float] | None = None

    def give(self, command: Command, *, again: bool = False) -> None:
        """Take in the command of a packet; nothing changes if it goes on.

        Args:
            command: command of the referee.
            again: whether the same command was given anew: its time begins again.
        """
        before, self.command = self.command, command
        if command is before:
            if again:
                self.steps, self.kick_position = 0, None
                self.in_play &= command not in _DIRECT  # a free kick is to be taken again
            return
        self.steps = 0
        if command in _PREPARED or command in _DIRECT or command is Command.FORCE_START:
            self.kick = command
        elif command is Command.STOP:
            self.kick = None
        self.kick_position = None  # the referee may put the ball as it gives the command
        # A start without a preparation is that of a match which has begun before the first packet.
        starts = command is Command.NORMAL_START and not (self._is_ssl and before in _PREPARED)
        self.in_play = starts or command is Command.FORCE_START

    def judge(self, ball: tuple[float, float], time_step: float) -> None:
        """Put the ball in play if it has moved or the time is over.

        Args:
            ball: place of the ball, x and y, m.
            time_step: duration of a step, s.
        """
        if self.kick_position is None:
            self.kick_position = ball
        if not self._is_ssl or self._kicking_team() == NOBODY:
            return
        limit = math.inf
        if self.kick in _KICKOFFS:
            limit = self._rules.kickoff_seconds
        elif self.kick not in _PENALTIES:
            limit = self._rules.free_kick_seconds
        moved = math.dist(ball, self.kick_position) >= self._rules.in_play_distance
        # Half a step: times are sums of steps.
        self.in_play = moved or (self.steps + 0.5) * time_step > limit

    def may_touch(self, team: int) -> bool:
        """Return whether a team's robots may touch the ball.

        Args:
            team: `BLUE` or `YELLOW`.
        """
        command = self.command
        if command in (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW):
            return team_of(command) == team
        return self.in_play or self._kicking_team() == team

    def _kicking_team(self) -> int:
        """The team that may bring the ball into play; `NOBODY` if it is in play or none may."""
        if self.in_play or self.command is None:
            return NOBODY
        if self.command in _DIRECT:
            return team_of(self.command)
        is_kick = self.command is Command.NORMAL_START and self.kick is not None
        return team_of(self.kick) if is_kick else NOBODY


def team_of(command: Command | None) -> int:
    """Return the team that a command is about, by its name; `NOBODY` if it is about none.

    Args:
        command: command of the referee; None for none.
    """
    name = "" if command is None else command.name
    return BLUE if name.endswith("_BLUE") else YELLOW if name.endswith("_YELLOW") else NOBODY
