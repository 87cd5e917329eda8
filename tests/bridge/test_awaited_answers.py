"""Clients that are slow, lose frames, or drop copies, in a match that waits for them."""

from __future__ import annotations

from collections import deque

import pytest

from rsoccer.bridge.awaited_answers import RESEND_SECONDS
from rsoccer.bridge.session import Datagram
from rsoccer.protocols.schemas import vision_pb2
from tests.bridge.clients import BLUE, OTHER, Wall, local_velocity

STEP = 0.005
"""Time between two looks of a test at the clock, s."""


class Client:
    """Blue's software, which takes a time for each frame; frames wait in its socket meanwhile."""

    def __init__(self, wall: Wall, seconds: float, *, drops_copies: bool = False) -> None:
        self.wall, self.seconds, self._drops_copies = wall, seconds, drops_copies
        self.sent = -1
        self.answered = -1
        self.new_frames = 0
        self.slips = 0
        self.lose: set[int] = set()
        self._queue: deque[int] = deque()
        self._free_at = wall.now

    def take(self, datagrams: list[Datagram]) -> None:
        """Receive what was sent."""
        for each in datagrams:
            if each.port != "vision":
                continue
            number = vision_pb2.Packet.FromString(each.data).detection.frame_number
            if number > self.sent:
                self.new_frames += 1
                self.slips += self.answered != self.sent
            copy, self.sent = number == self.sent, number
            if (copy and self._drops_copies) or (not copy and number in self.lose):
                continue
            if not self._queue:
                self._free_at = self.wall.now + self.seconds
            self._queue.append(number)

    def play(self, seconds: float) -> None:
        """Answer frames for a while."""
        for _ in range(round(seconds / STEP)):
            self.wall.now += STEP
            if self._queue and self.wall.now >= self._free_at - STEP / 2:
                self.answered = self._queue.popleft()
                self.wall.team(local_velocity([0]))
                self._free_at = self.wall.now + self.seconds
            self.take(self.wall.server.advance(self.wall.now))


def client_of(**settings: object) -> Wall:
    return Wall(speed=None, yellow="zero", **settings)


@pytest.mark.parametrize("seconds", [0.01, 0.09, 0.15, 0.25, 0.45, 0.7])
def test_a_slow_client_answers_the_frame_that_was_sent_last(seconds: float) -> None:
    wall = client_of()
    client = Client(wall, seconds)
    client.take(wall.sent)
    client.play(100 * seconds)
    assert client.slips == 0
    assert client.new_frames > 80
    assert wall.server.session.counts["frames: sent again"] <= 5


def test_a_client_that_becomes_slow_for_a_while_stays_in_step() -> None:
    wall = client_of()
    client = Client(wall, 0.01)
    client.take(wall.sent)
    for seconds in (0.01, 0.35, 0.01, 0.6, 0.01):
        client.seconds = seconds
        client.play(5.0)
    assert client.slips == 0
    assert client.new_frames > 900
    assert wall.server.session.counts["frames: sent again"] >= 2


@pytest.mark.parametrize("drops_copies", [False, True])
def test_lost_frames_and_dropped_copies_hold_nothing_up(drops_copies: bool) -> None:
    wall = client_of()
    client = Client(wall, 0.15 if drops_copies else 0.01, drops_copies=drops_copies)
    client.lose = set() if drops_copies else set(range(10, 1000, 10))
    client.take(wall.sent)
    before = client.new_frames
    client.play(60.0)
    frames = client.new_frames - before
    # A lost frame costs one wait for its copy, and one for an answer to a copy that never comes.
    assert frames > (
        60.0 / 0.15 * 0.8 if drops_copies else 60.0 / (0.01 + 2.5 * RESEND_SECONDS / 10)
    )
    assert client.slips == 0


def test_the_next_client_of_a_team_begins_anew() -> None:
    wall = client_of()
    wall.now += RESEND_SECONDS
    assert wall.server.advance(wall.now), "a copy"
    wall.team(local_velocity([0]), address=BLUE)
    assert wall.server.advance(wall.now)
    wall.now += 1.1
    wall.server.advance(wall.now)
    assert wall.server.session.teams[0].address is None
    wall.team(local_velocity([0]), address=OTHER)
    assert wall.server.session.teams[0].answered
