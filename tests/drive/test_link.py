"""Sockets: a policy drives a team of a server on the loopback interface."""

from __future__ import annotations

import threading

import pytest

from rsoccer.bridge.server import Server
from rsoccer.bridge.settings import Settings as ServerSettings
from rsoccer.bridge.sockets import LOOPBACK, SocketLoop, receiver
from rsoccer.drive.link import SocketLink
from rsoccer.drive.peers import Message
from rsoccer.drive.session import Session
from rsoccer.drive.settings import Settings
from rsoccer.registry import make_task
from tests.bridge.test_sockets import PATIENCE, network


def test_a_team_of_a_server_is_driven_to_the_ball() -> None:
    places = network()
    server = Server(ServerSettings(speed=None, yellow="zero", referee="off"))
    with SocketLoop(server, places) as loop:
        ports = {name: loop.addresses[name][1] for name in ("blue", "yellow", "control")}
        ports["vision"] = places.ports["vision"]
        settings = Settings(
            "ssl-simulation",
            ids=(5,),
            ports=ports,
            referee="ignore",
            is_synchronous=True,
            vision_timeout=PATIENCE,
            patience=PATIENCE,
        )
        thread = threading.Thread(target=loop.run, args=(2 * PATIENCE,))
        thread.start()
        try:
            session = Session("best", make_task("SSLGoToBall-v0"), settings)
            session.begin()
            for _ in range(200):
                session.step()
                if session.episodes:
                    break
            session.close()
        finally:
            loop.stop()
            thread.join()
    assert session.episodes[0]["reached"] == 1.0
    assert server.session.arena.frame.ball.last_touch[0] == 5.0


def test_messages_that_nobody_hears_are_lost() -> None:
    link = SocketLink(Settings("grsim", ports={"grsim": 9, "vision": 20999}, referee="ignore"))
    for _ in range(3):
        link.send([Message("grsim", b"x")])
        assert link.poll(0.01) == []
    link.close()
    link.close()


def test_an_address_that_is_no_address_is_named() -> None:
    with pytest.raises(ValueError, match="groups: vision: expected an IPv4 address, got 'lo'"):
        SocketLink(Settings("grsim", groups={"vision": "lo"}))
    with pytest.raises(ValueError, match="host: expected an IPv4 address"):
        SocketLink(Settings("grsim", host="robots"))


def test_a_taken_port_is_named() -> None:
    with receiver(LOOPBACK, 0) as taken:
        port = taken.getsockname()[1]
        settings = Settings("grsim", ports={"vision": port}, groups={"vision": LOOPBACK})
        with pytest.raises(OSError, match=f"127.0.0.1:{port}"):
            SocketLink(settings)
