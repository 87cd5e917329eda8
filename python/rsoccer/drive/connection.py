"""A connection to robots: commands out, states in, and robots that stop when either fails."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.drive.guard_process import GuardProcess
from rsoccer.drive.limits import limited, stopped
from rsoccer.drive.link import Link, SocketLink
from rsoccer.drive.officials import Officials
from rsoccer.drive.peers import Message, make_layout, make_peer
from rsoccer.drive.settings import Settings
from rsoccer.drive.sight import make_sight
from rsoccer.frame import Frame
from rsoccer.game import BLUE
from rsoccer.protocols.errors import MessageError
from rsoccer.protocols.layout import TEAM_NAMES
from rsoccer.rules.referee_config import RefereeConfig

DRIVEN: Final = (BLUE,)
"""Teams of the package whose robots a connection drives by default."""
REFUSALS: Final = ("TEAM_TAKEN", "UNKNOWN_ROBOT")
"""Errors of answers with which no robot obeys."""
REFUSED_SECONDS: Final = 3.0
"""Time for which commands are refused until a connection gives up, s: a simulator gives a team free
one second after its last client fell silent."""
CONTACT_SECONDS: Final = 0.2
"""Time for which the report of a break beam counts, s."""
END_MESSAGES: Final = 5
"""Messages that stop the robots at the end: one may be lost."""


class Connection:
    """A connection.

    Attributes:
        config: field, ball and robots as policies know them.
        settings: the settings.
        layout: sides and numbers on the wire.
        sight: what is seen.
        officials: the referee.
        counts: numbers of datagrams by what became of them, such as "vision: unreadable".
        on_event: called with words for what happens to vision, sides and referee.
        on_sent: called with time and commands (robots, command) when robots get others than before.
        frame: frame of one world that limits near the ball go by; the owner keeps it current.
    """

    def __init__(
        self,
        config: SimConfig,
        settings: Settings,
        *,
        drives: Sequence[int] = DRIVEN,
        rules: RefereeConfig | None = None,
        link: Link | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Open the connection; robots are told to stand.

        Args:
            config: field, ball and robots.
            settings: the settings.
            drives: teams to drive, in the package.
            rules: rules of the match, for what the referee allows; None for those of the league.
            link: what carries datagrams; None for sockets.
            clock: time on the wall, s.

        Raises:
            OSError: a port is taken, or an address is not one of this machine.
            ValueError: uniform numbers or robots that the match or the peer cannot have.
        """
        self.config, self.settings = config, settings
        self._clock = clock
        self._peer = make_peer(settings)
        positive = settings.blue_on_positive_half
        self._follows_sides = positive is None and settings.league == "ssl"
        positive = settings.peer == "firasim" if positive is None else positive
        self.layout = make_layout(settings, config, positive=positive)
        self._teams = tuple(self.layout.exchanged(team) for team in drives)
        self.sight = make_sight(self.layout, settings.league, settings.source)
        self.officials = Officials(settings, rules, clock)
        self.counts: Counter[str] = Counter()
        self.on_event: list[Callable[[str], None]] = []
        self.on_sent: list[Callable[[float, Floats], None]] = []
        self.frame = Frame.empty(1, config.n_blue, config.n_yellow)
        shape = (config.n_robots, len(config.command_columns))
        self._stopped: Floats = np.zeros(shape, np.float32)
        self._sent: Floats | None = None
        self._is_closed = False
        self._contact: Mask = np.zeros(config.n_robots, np.bool_)
        self._contact_at: Doubles = np.full(config.n_robots, -np.inf)
        self._problem = ""
        self._refusal: tuple[str, float] | None = None
        self._seen_at = self._sent_at = clock()
        stops = self._messages(self._stopped)  # raises for robots that the peer cannot have
        self._link: Link = SocketLink(settings) if link is None else link
        self._guard: GuardProcess | None = None
        try:
            if settings.guard and isinstance(self._link, SocketLink):
                times = settings.guard_timeout, settings.rate
                self._guard = GuardProcess(self._link, stops, *times)
            self._send(self._stopped)
        except BaseException:
            self._link.close()
            raise

    @property
    def driven(self) -> Mask:
        """(robots,) robots that are driven."""
        driven = np.zeros(self.config.n_robots, np.bool_)
        for team in self._teams:
            slots = self.layout.slots(team)
            driven[slots.start : slots.stop] = True
        return driven

    @property
    def now(self) -> float:
        """Time by the clock of the frames, s; a simulator that waits stands still between them."""
        seen = self.sight.clock.now
        return seen if self.settings.is_synchronous else seen + min(self._silence, 0.1)

    @property
    def _silence(self) -> float:
        """Time since the last frame on the wall, s."""
        return max(0.0, self._clock() - self._seen_at)

    def contact(self) -> tuple[Mask, Mask]:
        """Return robots whose break beam is known, and those whose break beam is cut."""
        known = self._clock() - self._contact_at <= CONTACT_SECONDS
        return known, self._contact & known

    # -- What goes on ----------------------------------------------------------------------------

    def advance(self, commands: Floats, until: float) -> None:
        """Give robots their commands, until a time.

        The commands go out now and with each frame. Robots stop while there are no frames; the
        first one then ends the call, so that nobody goes on with an old command.

        Args:
            commands: (robots, command) commands, finite.
            until: time by the clock of the frames at which the call ends, with the first frame of
                it or later, s.

        Raises:
            ConnectionError: there are no frames for `patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        self._send(commands)
        self._pump(commands, lambda: self.sight.clock.now >= until, "a frame")

    def stand(self, is_done: Callable[[], bool], wanted: str) -> None:
        """Let robots stand until a condition holds; it is asked after each frame.

        Args:
            is_done: whether it holds.
            wanted: words for it.

        Raises:
            ConnectionError: it does not hold for `patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        self._send(self._stopped)
        self._pump(self._stopped, is_done, wanted, stands=True)

    def begin(self) -> None:
        """Wait until the ball and all robots that are driven are in sight.

        Raises:
            ConnectionError: they are not for `patience`. The message has what is in sight.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        if self._silence > self.settings.seconds_to_stop or not self._is_ready():
            seen = self.sight.frames
            self.stand(lambda: self.sight.frames > seen and self._is_ready(), "all in sight")

    def put(self, messages: Sequence[Message]) -> None:
        """Send messages that put bodies.

        Args:
            messages: the messages, of `peer`.
        """
        self._link.send(messages)

    def placement(self, frame: Frame, *, ball_only: bool = False) -> list[Message]:
        """Return the messages that put bodies.

        Args:
            frame: frame of one world.
            ball_only: whether robots stay.
        """
        if ball_only:
            return self._peer.ball_placement(self.layout, frame)
        return self._peer.placement(self.layout, frame, self.sight.strangers)

    def forget(self) -> None:
        """Forget all estimates, as bodies have been put somewhere."""
        self.sight.turn(self.layout)

    def stop(self) -> None:
        """Tell the robots to stand; the guard tells them again while nothing else is sent."""
        for _ in range(END_MESSAGES):
            self._send(self._stopped)

    def close(self) -> None:
        """Stop the robots and close the connection; a second call does nothing."""
        if self._is_closed:
            return
        self._is_closed = True
        for _ in range(END_MESSAGES):
            self._link.send(self._messages(self._stopped))
        if self._guard is not None:
            self._guard.close()
        self._link.close()

    # -- Parts -----------------------------------------------------------------------------------

    def _pump(
        self,
        commands: Floats,
        is_done: Callable[[], bool],
        wanted: str,
        *,
        stands: bool = False,
    ) -> None:
        settings = self.settings
        begun, period, lost = self._clock(), 1.0 / settings.rate, False
        while True:
            was_halted = self.officials.is_halted
            frames, before = self.sight.frames, self.sight.clock.now
            waited = 0.0 if settings.is_synchronous else self._clock() - self._sent_at
            is_newer = self._take(min(max(0.0, period - waited), period))
            came = self.sight.frames - frames
            if is_newer and (is_done() or (lost and self.sight.clock.now > before)):
                self._answer(commands, came - 1)
                if lost:
                    self._tell(f"{settings.source}: back")
                return
            is_urgent = self.officials.is_halted != was_halted
            if not lost and self._silence > settings.seconds_to_stop:
                lost, commands, is_urgent = True, self._stopped, True
                self.counts[f"{settings.source}: lost"] += 1
                self._tell(f"{settings.source}: lost, robots stop")
            is_due = self._clock() >= self._sent_at + period
            if came:
                self._answer(commands, came)
            elif is_urgent or (is_due and (lost or not settings.is_synchronous)):
                self._send(commands)
            self._check(wanted, self._clock() - begun if stands else self._silence)

    def _answer(self, commands: Floats, frames: int) -> None:
        """Send commands for frames; a simulator that waits for its clients counts them."""
        for _ in range(frames if self.settings.is_synchronous else min(frames, 1)):
            self._send(commands)

    def _check(self, wanted: str, seconds: float) -> None:
        if self._refusal is not None and self._clock() - self._refusal[1] > REFUSED_SECONDS:
            raise RuntimeError(self._refusal[0])
        if seconds > self.settings.patience:
            raise ConnectionError(
                f"{self.settings.source}: expected {wanted} within {self.settings.patience:g} s, "
                f"got {self._sight_in_words()}"
            )

    def _sight_in_words(self) -> str:
        settings, sight = self.settings, self.sight
        place = f"{settings.group_hosts[settings.source]}:{settings.port_numbers[settings.source]}"
        if not sight.frames:
            unreadable = self.counts[f"{settings.source}: unreadable"]
            others = f"{unreadable} other datagrams ({self._problem})" if unreadable else "nothing"
            return f"no frames at {place}, {others}"
        missing = np.flatnonzero(self.driven & ~sight.in_sight).tolist()
        teams = [f"{name} {sight.numbers(team)}" for team, name in enumerate(TEAM_NAMES)]
        lacks = [
            f"{TEAM_NAMES[team]} {number}" for team, number in map(self.layout.identity, missing)
        ]
        lacks += [] if sight.has_ball else ["the ball"]
        words = f"robots {', '.join(teams)} in sight"
        return words + (f" without {', '.join(lacks)}" if lacks else "")

    def _is_ready(self) -> bool:
        return self.sight.has_ball and bool(self.sight.in_sight[self.driven].all())

    def _take(self, seconds: float) -> bool:
        """Take in what comes. Return whether the state is a newer one."""
        is_newer = False
        for port, data in self._link.poll(seconds):
            try:
                if port == self.settings.source:
                    self._turn()
                    before = self.sight.frames
                    is_newer |= self.sight.take(data)
                    if self.sight.frames > before:
                        self._seen_at = self._clock()
                elif port == "referee":
                    self._take_referee(data)
                else:
                    self._take_answer(port, data)
            except MessageError as error:
                self.counts[f"{port}: unreadable"] += 1
                self._problem = str(error)
        return is_newer

    def _turn(self) -> None:
        """Take note of other sides, as the teams change them between the halves."""
        told = self.officials.reported.blue_on_positive_half
        if told is None or told == self.layout.blue_on_positive_half:
            return
        if not self._follows_sides:
            self.counts["referee: blue on the other half"] += 1
            return
        self.layout = replace(self.layout, blue_on_positive_half=told)
        self.sight.turn(self.layout)
        self.counts["sides changed"] += 1
        self._tell(f"referee: blue's goal is at {'+x' if told else '-x'}")

    def _take_referee(self, data: bytes) -> None:
        state = self.officials.reported.state
        before = state.command
        self.officials.receive(self.layout, data)
        if state.command is not before and state.command is not None:
            self._tell(f"referee: {state.command.name}")

    def _tell(self, text: str) -> None:
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
            self._refusal = None
        elif self._refusal is None:
            self._refusal = refused[0], now
        self._contact[answer.reported] = answer.contact[answer.reported]
        self._contact_at[answer.reported] = now

    def _messages(self, commands: Floats) -> list[Message]:
        return [
            message
            for team in self._teams
            for message in self._peer.commands(self.layout, commands, team)
        ]

    def _send(self, commands: Floats) -> None:
        """Send commands as referee and limits allow them, and stop robots that nobody sees."""
        allowed = np.array(self.officials.restrain(self.layout, commands, self.frame), np.float32)
        in_sight = self.sight.in_sight
        for slot, model in enumerate(self.config.robots):
            if in_sight[slot]:
                allowed[slot] = limited(model, allowed[slot], self.settings.limits)
        allowed[~in_sight | ~self.driven] = stopped(allowed[0])
        self._link.send(self._messages(allowed))
        self._sent_at = self._clock()
        if self._guard is not None:
            self._guard.sign()
        if self._sent is None or not np.array_equal(allowed, self._sent):
            for listener in self.on_sent:
                listener(self.now, allowed)
        self._sent = allowed
