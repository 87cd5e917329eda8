"""The page that shows a served match, over HTTP and a websocket on the loopback interface."""

from __future__ import annotations

import json
import re
import socket
import urllib.error
import urllib.request

import pytest

from rsoccer.protocols.schemas import simulation_pb2
from tests.bridge.clients import Wall
from tests.bridge.test_server import referee_packet

pytest.importorskip("websockets")

from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from websockets.typing import Origin

from rsoccer.bridge import live_page
from rsoccer.bridge.live_page import FRAMES, LivePage, frame_of

PATIENCE = 60.0
"""Longest wait for a frame, s: for machines that are busy."""


def status_of(request: str | urllib.request.Request) -> int:
    """Return the status of an answer that is an error."""
    with pytest.raises(urllib.error.HTTPError) as refused:
        urllib.request.urlopen(request, timeout=PATIENCE)
    refused.value.close()
    return refused.value.code


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_frames_come_while_somebody_watches(league: str) -> None:
    wall = Wall(league=league, yellow="zero")
    with LivePage(wall.server, 0) as page:
        with urllib.request.urlopen(page.url, timeout=PATIENCE) as answer:
            html = answer.read().decode()
        assert "FieldView" in html
        assert not re.search(r"\{\{\w+\}\}", html), "all parts are filled in"
        with connect(f"ws://127.0.0.1:{page.port}{FRAMES}", open_timeout=PATIENCE) as viewer:
            frame = None
            while frame is None:  # the server learns of the viewer in a thread of its own
                wall.tick(5)
                try:
                    frame = json.loads(viewer.recv(timeout=0.1))
                except TimeoutError:
                    continue
        assert frame["score"] == [0, 0]
        assert frame["drivers"] == "blue: nobody, yellow: zero"
        assert 0 < frame["seconds"] <= wall.seconds
        x = frame["row"][17]  # of the first robot, behind the columns of the ball
        assert x == pytest.approx(wall.robots.position[0, 0, 0], abs=1e-3)
    page.close()
    assert not wall.server.listeners


def test_a_viewer_too_many_that_does_not_answer_stops_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(live_page, "MAX_VIEWERS", 0)
    monkeypatch.setattr(live_page, "_CLOSE", PATIENCE)
    wall = Wall()
    with LivePage(wall.server, 0) as page:
        with socket.create_connection(("127.0.0.1", page.port), PATIENCE) as silent:
            silent.sendall(
                f"GET {FRAMES} HTTP/1.1\r\nHost: 127.0.0.1:{page.port}\r\nUpgrade: websocket\r\n"
                "Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n".encode()
            )
            received = b""
            while b"too many watch" not in received:
                part = silent.recv(4096)
                assert part
                received += part
            # The page waits for the answer now, and the match goes on.
            free = page._changed.acquire(timeout=5.0)
            if free:
                page._changed.release()
        assert free


def test_pages_of_others_get_nothing() -> None:
    with LivePage(Wall().server, 0) as page:
        stranger = urllib.request.Request(page.url, headers={"Host": "example.org"})
        assert status_of(stranger) == 403
        assert status_of(f"{page.url}other") == 404
        with pytest.raises(InvalidStatus, match="403"):
            connect(f"ws://127.0.0.1:{page.port}{FRAMES}", origin=Origin("http://example.org"))
        with pytest.raises(OSError, match=f"page: 127.0.0.1:{page.port}"):
            LivePage(Wall().server, page.port)


def test_the_page_shows_robots_that_were_exchanged() -> None:
    wall = Wall()
    message = simulation_pb2.Command()
    specs = message.config.robot_specs.add(radius=0.08, center_to_dribbler=0.07)
    specs.id.id, specs.id.team = 1, simulation_pb2.BLUE
    with LivePage(wall.server, 0) as page:
        pages = []
        for _ in range(2):
            with urllib.request.urlopen(page.url, timeout=PATIENCE) as answer:
                pages.append(answer.read().decode())
            assert wall.control(message) == []
            wall.tick(5)
    kinds = [re.findall(r'"robots": ?\[([0-9, ]+)\]', html) for html in pages]
    assert [len(set(each[0].replace(" ", "").split(","))) for each in kinds] == [1, 2]


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(0.0, "0:00.0"), (59.975, "0:59.9"), (60.0, "1:00.0"), (599.96, "9:59.9"), (0.3, "0:00.3")],
)
def test_no_minute_has_sixty_seconds(seconds: float, text: str) -> None:
    assert live_page._clock(seconds) == text


def test_a_referee_on_the_network_is_shown_from_its_first_packet_on() -> None:
    wall = Wall(referee="external")
    wall.tick(2)
    shown = frame_of(wall.server)
    assert (shown["stage"], shown["command"]) == ("", "No referee is heard")
    wall.send("referee", b"\xff")
    assert frame_of(wall.server)["command"] == "No referee is heard"
    wall.send("referee", referee_packet().SerializeToString())
    wall.tick(2)
    shown = frame_of(wall.server)
    assert shown["stage"]
    assert shown["command"] == "Free kick Blue"
