"""A connection to robots: commands out, states in, and robots that stop when either fails."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.bridge.settings import BLUE_ON_POSITIVE_HALF
from rsoccer.drive.guard_process import GuardProcess
from rsoccer.drive.kicks import KickPauses
from rsoccer.drive.link import Link, SocketLink
from rsoccer.drive.officials import Officials
from rsoccer.drive.peers import Message, make_layout, make_peer
from rsoccer.drive.reception import Reception
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.game import BLUE
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.limits import limited, stopped
from rsoccer.rules.referee_config import RefereeConfig

DRIVEN: Final = (BLUE,)
"""Teams of the package whose robots a connection drives by default."""
MAX_AGE: Final = 0.1
"""Time since the last frame up to which time goes on without one, s."""
MAX_BATCHES: Final = 1000
"""Batches of datagrams that are taken in at once after a pause; a flood does not end."""
MAX_LATE_STEPS: Final = 20
"""Steps in a row in which a program may be late, so that none of its commands is sent."""
END_MESSAGES: Final = 5
"""Messages that stop the robots at the end: one may be lost."""


class Connection:
    """A connection.

    Attributes:
        config: field, ball and robots as policies know them.
        settings: the settings.
        sight: what is seen.
        officials: the referee.
        counts: numbers of datagrams by what became of them, such as "vision: unreadable", and of
            bodies that are ignored, by the reason.
        contact: returns robots whose break beam is known, and those whose break beam is cut.
        on_event: called with words for what happens to vision, sides and referee.
        on_sent: called with time and commands (robots, command) that are sent.
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
        """Open the connection; robots are commanded to stand.

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
        self._kick_pauses = KickPauses(config, self._peer.kick_pause)
        positive = settings.blue_on_positive_half
        positive = BLUE_ON_POSITIVE_HALF[settings.league] if positive is None else positive
        layout = make_layout(settings, config, positive=positive)
        self.officials = Officials(settings, rules, clock)
        self._reception = Reception(settings, layout, self._peer, self.officials, clock)
        self.sight, self.counts = self._reception.sight, self._reception.counts
        self.on_event, self.contact = self._reception.on_event, self._reception.contact
        self._teams = tuple(layout.exchanged(team) for team in drives)
        self.on_sent: list[Callable[[float, Floats], None]] = []
        self.frame = Frame.empty(1, config.n_blue, config.n_yellow)
        shape = (config.n_robots, len(config.command_columns))
        self._stopped: Floats = np.zeros(shape, np.float32)
        self._is_closed = False
        self._late_steps = 0
        self._sent_at = self._taken_at = clock()
        self._now = 0.0
        stops = self._messages(self._stopped)  # raises for robots that the peer cannot have
        self._link: Link = SocketLink(settings) if link is None else link
        self._guard: GuardProcess | None = None
        try:
            if settings.guard and isinstance(self._link, SocketLink):
                # A simulator that waits takes stops for answers: only the end here counts.
                timeout = math.inf if settings.is_synchronous else settings.guard_timeout
                self._guard = GuardProcess(self._link, stops, timeout, settings.rate)
            self._send(None)
        except BaseException:
            self.close()
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
        since = 0.0 if self.settings.is_synchronous else min(self._reception.silence, MAX_AGE)
        # A frame that was late on its way does not turn time back.
        self._now = max(self._now, self.sight.clock.now + since)
        return self._now

    @property
    def layout(self) -> WireLayout:
        """Sides and numbers on the wire."""
        return self._reception.layout

    # -- What goes on ----------------------------------------------------------------------------

    def advance(self, commands: Floats, until: float) -> None:
        """Give robots their commands, until a time.

        The commands go out now and with each frame. Robots stop while there are no frames; the
        first one then ends the call, so that nobody goes on with an old command. The same holds
        after a pause of this program in which robots would have stopped: what has come in
        meanwhile is old, and the commands are not sent.

        Args:
            commands: (robots, command) commands, finite.
            until: time by the clock of the frames at which the call ends, with the first frame of
                it or later, s.

        Raises:
            ConnectionError: there are no frames for `patience`.
            RuntimeError: the simulator refuses all commands, the guard has ended, or this program
                is late in `MAX_LATE_STEPS` calls in a row.
        """
        if self._slept():
            self._count_lateness()
            before = self.sight.clock.now
            self.stand(lambda: self.sight.clock.now > before, "a frame")
            return
        self._late_steps = 0
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
        self._send(None)
        if self._slept():
            self._drain()
        self._pump(None, is_done, wanted, stands=True)

    def begin(self, *, needs_all: bool = True) -> None:
        """Wait until there are frames, and the ball and all robots that are driven are in sight.

        Args:
            needs_all: whether ball and robots are awaited; else frames alone.

        Raises:
            ConnectionError: they are not for `patience`. The message has what is in sight.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """

        def is_ready() -> bool:
            return not needs_all or self._is_ready()

        if self._reception.silence > self.settings.seconds_to_stop or not is_ready():
            seen = self.sight.frames
            wanted = "all in sight" if needs_all else "a frame"
            self.stand(lambda: self.sight.frames > seen and is_ready(), wanted)

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

    def tell(self, text: str) -> None:
        """Tell those who listen to events.

        Args:
            text: words for what happens.
        """
        self._reception.tell(text)

    def stop(self) -> None:
        """Tell the robots to stand; the guard tells them again while nothing else is sent."""
        for _ in range(END_MESSAGES):
            self._send(None)

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

    def _slept(self) -> bool:
        """Whether nobody has looked for datagrams for so long that frames are old."""
        if self.settings.is_synchronous:
            return False
        return self._clock() - self._taken_at > self.settings.seconds_to_stop

    def _count_lateness(self) -> None:
        """Count a step in which this program was late, and give up if it always is."""
        source, seconds = self.settings.source, self.settings.seconds_to_stop
        self.counts[f"{source}: late"] += 1
        self.tell(f"{source}: this program was late, robots stop")
        self._late_steps += 1
        if self._late_steps >= MAX_LATE_STEPS:
            raise RuntimeError(
                f"vision_timeout: expected commands within {seconds:g} s of a frame, but this "
                f"program took longer in {self._late_steps} steps in a row, so that its robots "
                "never drive; give it more time, or let it compute less in a step"
            )

    def _drain(self) -> None:
        """Take in what has come while nobody looked, so that the next frame is one of now."""
        for _ in range(MAX_BATCHES):
            received = self._link.poll(0.0)
            for port, data in received:
                self._reception.take(port, data)
            if not received:
                break
        self._taken_at = self._clock()

    def _pump(
        self,
        commands: Floats | None,
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
            is_back = lost and is_newer and self.sight.clock.now > before
            if is_newer and (is_done() or (is_back and not stands)):
                self._answer(commands, came - 1)
                if lost:
                    self.tell(f"{settings.source}: back")
                return
            if is_back:  # robots that stand have no old command to go on with
                lost = False
                self.tell(f"{settings.source}: back")
            is_urgent = self.officials.is_halted != was_halted
            if not lost and self._reception.silence > settings.seconds_to_stop:
                lost, commands, is_urgent = True, None, True
                self.counts[f"{settings.source}: lost"] += 1
                self.tell(f"{settings.source}: lost, robots stop")
            is_due = self._clock() >= self._sent_at + period
            if came:
                self._answer(commands, came)
            elif is_urgent or (is_due and (lost or not settings.is_synchronous)):
                self._send(commands)
            self._check(wanted, self._clock() - begun if stands else self._reception.silence)

    def _answer(self, commands: Floats | None, frames: int) -> None:
        """Send commands for frames; a simulator that waits for its clients counts them."""
        for _ in range(frames if self.settings.is_synchronous else min(frames, 1)):
            self._send(commands)

    def _check(self, wanted: str, seconds: float) -> None:
        refusal = self._reception.lasting_refusal()
        if refusal is not None:
            raise RuntimeError(refusal)
        if seconds > self.settings.patience:
            raise ConnectionError(
                f"{self.settings.source}: expected {wanted} within {self.settings.patience:g} s, "
                f"got {self._reception.in_words(self.driven)}"
            )

    def _is_ready(self) -> bool:
        return self.sight.has_ball and bool(self.sight.in_sight[self.driven].all())

    def _take(self, seconds: float) -> bool:
        """Take in what comes. Return whether the state is a newer one."""
        newer = [self._reception.take(port, data) for port, data in self._link.poll(seconds)]
        self._taken_at = self._clock()
        return any(newer)

    def _messages(self, commands: Floats) -> list[Message]:
        return [
            message
            for team in self._teams
            for message in self._peer.commands(self.layout, commands, team)
        ]

    def _send(self, commands: Floats | None) -> None:
        """Send commands as referee and limits allow them; None to let all robots stand."""
        allowed = self._stopped.copy() if commands is None else self._allowed(commands)
        allowed = self._kick_pauses.applied(self._clock(), allowed)
        self._link.send(self._messages(allowed))
        self._sent_at = self._clock()
        if self._guard is not None:
            self._guard.sign()
        # Equal ones too: robots that hear nothing for a time stop.
        for listener in self.on_sent:
            listener(self.now, allowed)

    def _allowed(self, commands: Floats) -> Floats:
        """Commands as referee and limits allow them; robots that nobody sees or drives stand."""
        allowed = np.array(self.officials.restrain(self.layout, commands, self.frame), np.float32)
        in_sight = self.sight.in_sight
        for slot, model in enumerate(self.config.robots):
            if in_sight[slot]:
                allowed[slot] = limited(model, allowed[slot], self.settings.limits)
        allowed[~in_sight | ~self.driven] = stopped(allowed[0])
        return allowed
