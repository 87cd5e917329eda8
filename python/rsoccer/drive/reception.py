"""Receiver of a connection: frames, packets of the referee, and answers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer.arrays import Doubles, Mask
from rsoccer.drive.officials import Officials
from rsoccer.drive.peers import Peer
from rsoccer.drive.settings import Settings
from rsoccer.drive.sight import OLDER_FRAMES, UNCONFIRMED_FRAMES
from rsoccer.drive.state_sight import make_sight
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import TEAM_NAMES, WireLayout

REFUSALS: Final = ("TEAM_TAKEN", "UNKNOWN_ROBOT")
"""Errors of answers with which no robot obeys."""
REFUSED_SECONDS: Final = 3.0
"""Time for which commands are refused until a connection gives up, s: a simulator gives a team free
one second after its last client fell silent."""
FIELD_TOLERANCE: Final = 0.05
"""Difference of length or width from which a field is another one, m."""
CONTACT_SECONDS: Final = 0.2
"""Time for which the report of a break beam counts, s."""


class Reception:
    """Takes in datagrams.

    Attributes:
        settings: the settings.
        layout: sides and numbers on the wire; they follow a referee of the SSL.
        sight: what is seen.
        counts: numbers of datagrams by what became of them, such as "vision: unreadable", and of
            bodies that are ignored, by the reason.
        on_event: called with words for what happens to vision, sides and referee, and once for a
            field of another size than that of the task.
    """

    def __init__(
        self,
        settings: Settings,
        layout: WireLayout,
        peer: Peer,
        officials: Officials,
        clock: Callable[[], float],
    ) -> None:
        """Begin before the first datagram.

        Args:
            settings: the settings.
            layout: sides and numbers on the wire.
            peer: the simulator or the robots.
            officials: the referee.
            clock: time on the wall, s.
        """
        self.settings, self.layout = settings, layout
        self._peer, self._officials, self._clock = peer, officials, clock
        given = settings.blue_on_positive_half
        self._follows_sides = given is None and settings.league == "ssl"
        self.sight = make_sight(layout, settings.league, settings.source, clock)
        self.counts = self.sight.counts
        self.on_event: list[Callable[[str], None]] = []
        self._contact: Mask = np.zeros(layout.config.n_robots, np.bool_)
        self._contact_at: Doubles = np.full(layout.config.n_robots, -np.inf)
        self._problem = ""
        self._refusals: dict[str, tuple[str, float]] = {}  # by port, as each has its own client
        self._seen_at = clock()
        self._knows_field = False

    @property
    def silence(self) -> float:
        """Time since the last frame with a newer stamp, on the wall, s."""
        return max(0.0, self._clock() - self._seen_at)

    def lasting_refusal(self) -> str | None:
        """Return why a team's commands have been refused for some time; None if they are not."""
        now = self._clock()
        for text, since in self._refusals.values():
            if now - since > REFUSED_SECONDS:
                return text
        return None

    def contact(self) -> tuple[Mask, Mask]:
        """Return robots whose break beam is known, and those whose break beam is cut."""
        known = self._clock() - self._contact_at <= CONTACT_SECONDS
        return known, self._contact & known

    def in_words(self, wanted: Mask) -> str:
        """Return words for what is seen and what is missing.

        Args:
            wanted: (robots,) robots that are to be in sight.
        """
        settings, sight = self.settings, self.sight
        place = f"{settings.group_hosts[settings.source]}:{settings.port_numbers[settings.source]}"
        unreadable = self.counts[f"{settings.source}: unreadable"]
        others = f"{unreadable} other datagrams ({self._problem})" if unreadable else "nothing"
        if not sight.frames:
            return f"no frames at {place}, {others}"
        if self.silence > settings.seconds_to_stop:
            words = f"no newer frames at {place} for {self.silence:.1f} s"
            return words + (f", {others}" if unreadable else "") + self._ignored()
        missing = np.flatnonzero(wanted & ~sight.in_sight).tolist()
        teams = [f"{name} {sight.numbers(team)}" for team, name in enumerate(TEAM_NAMES)]
        lacks = [
            f"{TEAM_NAMES[team]} {number}" for team, number in map(self.layout.identity, missing)
        ]
        lacks += [] if sight.has_ball else ["the ball"]
        words = f"robots {', '.join(teams)} in sight"
        words += f" without {', '.join(lacks)}" if lacks else ""
        return words + self._ignored()

    def _ignored(self) -> str:
        counts = {reason: self.counts[reason] for reason in (OLDER_FRAMES, UNCONFIRMED_FRAMES)}
        return "".join(f"; ignored {reason}: {count}" for reason, count in counts.items() if count)

    def take(self, port: str, data: bytes) -> bool:
        """Take in a datagram.

        Args:
            port: name of the port.
            data: the bytes; any.

        Returns:
            True if the state is a newer one.
        """
        try:
            if port == self.settings.source:
                return self._take_frame(data)
            if port == "referee":
                self._take_referee(data)
            else:
                self._take_answer(port, data)
        except MessageError as error:
            self.counts[f"{port}: unreadable"] += 1
            self._problem = str(error)
        return False

    def _take_frame(self, data: bytes) -> bool:
        self._turn()
        known, cut = self.contact()
        self.sight.cut = np.flatnonzero(cut).tolist() if known.any() else None
        is_newer = self.sight.take(data)
        self._compare_fields()
        if is_newer:  # frames whose clock stands still are as good as none
            self._seen_at = self._clock()
        return is_newer

    def _compare_fields(self) -> None:
        """Tell of a field of another size than that of the task, as soon as vision tells it."""
        size = self.sight.field_size
        if size is None or self._knows_field:
            return
        self._knows_field = True
        field = self.layout.config.field
        if max(abs(field.length - size[0]), abs(field.width - size[1])) > FIELD_TOLERANCE:
            self.tell(
                f"field: the task's is {field.length:g} x {field.width:g} m, that of vision "
                f"{size[0]:g} x {size[1]:g} m"
            )

    def _turn(self) -> None:
        """Take note of other sides, as the teams change them between the halves."""
        side = self._officials.reported.blue_on_positive_half
        if side is None or side == self.layout.blue_on_positive_half:
            return
        if not self._follows_sides:
            self.counts["referee: blue on the other half"] += 1
            return
        self.layout = replace(self.layout, blue_on_positive_half=side)
        self.sight.turn(self.layout)
        self.counts["sides changed"] += 1
        self.tell(f"referee: blue's goal is at {'+x' if side else '-x'}")

    def _take_referee(self, data: bytes) -> None:
        state = self._officials.reported.state
        before = state.command
        self._officials.receive(self.layout, data)
        if state.command is not before and state.command is not None:
            self.tell(f"referee: {state.command.name}")

    def tell(self, text: str) -> None:
        """Tell what happens.

        Args:
            text: words for it.
        """
        for listener in self.on_event:
            listener(text)

    def _take_answer(self, port: str, data: bytes) -> None:
        answer = self._peer.answer(self.layout, port, data)
        if answer is None:
            return
        for code, text in answer.errors:
            self.counts[f"{port}: {code}"] += 1
            self._problem = f"{port}: {code}: {text}"
        now = self._clock()
        refused = [f"{port}: {code}: {text}" for code, text in answer.errors if code in REFUSALS]
        if not refused:
            self._refusals.pop(port, None)
        elif port in TEAM_NAMES:  # commands are repeated, so that a team that is free shows
            self._refusals.setdefault(port, (refused[0], now))
        self._contact[answer.reported] = answer.contact[answer.reported]
        self._contact_at[answer.reported] = now
