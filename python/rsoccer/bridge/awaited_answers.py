"""Answers to a frame, in a match that waits for its clients: copies of the frame, and who answers.

A datagram can be lost, so a frame is sent again while its answer is missing. A client that is only
slow answers the frame and later each copy. Answers to copies of an earlier frame must not count
for the next one: the client would be a frame behind for the rest of the match.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from rsoccer.bridge.session import Datagram
from rsoccer.bridge.team import Address, Team

RESEND_SECONDS: Final = 0.1
"""Least time after which a frame is sent again, s."""
RESEND_SHARE: Final = 0.8
"""Greatest such time, as a share of the time after which a silent client has left its team."""
_SLACK: Final = 2.0
"""Factor from the time that a client took to answer to the time after which a frame is sent again,
and from one such time of a frame to the next."""


@dataclass
class _Account:
    """Answers of a team's client: to the frame, and to copies of an earlier one."""

    address: Address | None = None
    answers: int = 0
    copies_open: int = 0
    was_ignored: bool = False


class AwaitedAnswers:
    """The last frame, its copies and its answers.

    Times are those on the wall, s.
    """

    def __init__(self, teams: Sequence[Team], client_timeout: float) -> None:
        """Begin without a frame.

        Args:
            teams: the teams; `Team.answered` tells which of them have answered.
            client_timeout: time after which a silent client has left its team, s.
        """
        self._teams = teams
        self._longest = max(RESEND_SECONDS, RESEND_SHARE * client_timeout)
        self._accounts = [_Account() for _ in teams]
        self._frame: list[Datagram] = []
        self._copies = 0
        self._wait, self._slowest = RESEND_SECONDS, 0.0
        self._asked_at = self._active_at = -math.inf

    def ask(self, frame: list[Datagram], now: float) -> None:
        """Wait for answers to a frame that is sent.

        Args:
            frame: the frame, without the referee.
            now: time.
        """
        for team, account in zip(self._teams, self._accounts, strict=True):
            account.copies_open = max(0, 1 + self._copies - account.answers)
            account.answers, account.was_ignored = 0, False
            team.answered = False
        self._frame, self._copies = frame, 0
        self._wait = min(max(RESEND_SECONDS, _SLACK * self._slowest), self._longest)
        self._slowest = 0.0
        self._asked_at = self._active_at = now

    def before_message(self) -> list[bool]:
        """Return which teams have answered, for `after_message`."""
        answered = [team.answered for team in self._teams]
        for team in self._teams:
            team.answered = False
        return answered

    def after_message(self, answered: Sequence[bool], now: float) -> None:
        """Count the answer in a message, unless it is one to a copy of an earlier frame.

        Args:
            answered: which teams had answered before the message.
            now: time.
        """
        for team, account, before in zip(self._teams, self._accounts, answered, strict=True):
            if not team.answered:
                team.answered = before and team.address is not None
                continue
            if account.address != team.address:
                account.address, account.copies_open, account.answers = team.address, 0, 0
                before = False
            if account.copies_open or not before:
                self._slowest = max(self._slowest, now - self._asked_at)
            if account.copies_open:
                account.copies_open -= 1
                account.was_ignored = True
                team.answered = before
                self._asked_at = self._active_at = now  # the client is there, and on its way
                continue
            account.answers += 1

    @property
    def due(self) -> float:
        """Time of the next copy; infinite without a frame."""
        return self._active_at + self._wait if self._frame else math.inf

    def settle(self, now: float) -> None:
        """Count ignored answers of clients that have fallen silent: these had no copies to answer.

        That is so where the first frame was lost, or where a client drops frames that it knows.

        Args:
            now: time.
        """
        if now < self.due:
            return
        for team, account in zip(self._teams, self._accounts, strict=True):
            if account.was_ignored and not team.answered and team.address is not None:
                team.answered = True
                account.answers = 1 + self._copies

    def copy(self, now: float) -> list[Datagram]:
        """Return the frame once more if it is due; else nothing.

        Args:
            now: time.
        """
        if now < self.due:
            return []
        self._copies += 1
        self._wait = min(_SLACK * self._wait, self._longest)
        self._active_at = now
        return list(self._frame)
