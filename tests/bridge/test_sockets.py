"""A server on the loopback interface, and a client that answers what it sees."""

from __future__ import annotations

import socket
import sys
import threading
from collections.abc import Iterator

import pytest

from rsoccer.bridge.server import Server
from rsoccer.bridge.settings import SSL_GROUPS, SSL_PORTS, Settings
from rsoccer.bridge.sockets import (
    BATCH,
    BATCH_SECONDS,
    LOOPBACK,
    Network,
    SocketLoop,
    group_receiver,
    is_own_host,
    receiver,
    sender,
)
from rsoccer.protocols.schemas import simulation_pb2, vision_pb2
from tests.bridge.clients import local_velocity
from tests.bridge.ports import free_port

PATIENCE = 60.0
"""Longest wait of a test for a message, s: for machines that are busy."""


def network(**others: int) -> Network:
    ports = {**dict.fromkeys(SSL_PORTS, 0), "vision": free_port(), "tracker": free_port()}
    ports |= {"referee": free_port(), **others}
    return Network(LOOPBACK, None, ports, SSL_GROUPS)


@pytest.fixture
def places() -> Network:
    return network()


@pytest.fixture
def vision(places: Network) -> Iterator[socket.socket]:
    with group_receiver(SSL_GROUPS["vision"], places.ports["vision"], LOOPBACK) as made:
        made.settimeout(PATIENCE)
        yield made


def test_a_team_plays_over_the_network(places: Network, vision: socket.socket) -> None:
    server = Server(Settings(speed=None, yellow="zero"))
    with SocketLoop(server, places) as loop, receiver(LOOPBACK, 0) as client:
        client.settimeout(PATIENCE)
        thread = threading.Thread(target=loop.run, args=(PATIENCE,))
        thread.start()
        try:
            numbers, answers = [], 0
            for _ in range(60):
                detection = vision_pb2.Packet.FromString(vision.recv(65535)).detection
                numbers.append(detection.frame_number)
                client.sendto(local_velocity([2]), loop.addresses["blue"])
                data, address = client.recvfrom(65535)
                assert address == loop.addresses["blue"]
                answers += len(simulation_pb2.RobotControlResponse.FromString(data).feedback)
        finally:
            loop.stop()
            thread.join()
    assert answers == 60
    # A frame is sent again while the client is slow.
    assert numbers == sorted(numbers)
    assert len(set(numbers)) >= 30
    assert server.session.arena.frame.robots.velocity[0, 2, 0] > 0.5


def test_a_real_time_server_keeps_on_while_it_is_flooded(places: Network) -> None:
    now = 0.0

    def clock() -> float:
        nonlocal now
        now += 1e-4
        return now

    server = Server(Settings())
    with SocketLoop(server, places, clock) as loop, receiver(LOOPBACK, 0) as client:
        for _ in range(300):
            for _ in range(40):
                client.sendto(b"\xff" * 30, loop.addresses["control"])
            loop.turn()
        assert server.session.arena.ticks > 20
        assert server.session.counts["control: unreadable"] > 1000


@pytest.mark.skipif(sys.platform != "linux", reason="an option of Linux")
def test_a_group_is_heard_on_its_interface_alone() -> None:
    group, port = SSL_GROUPS["referee"], free_port()
    with group_receiver(group, port, LOOPBACK) as made:
        assert made.getsockopt(socket.IPPROTO_IP, 49) == 0
        with sender(LOOPBACK, 0) as source:
            source.sendto(b"x", (group, port))
        made.settimeout(PATIENCE)
        data, address = made.recvfrom(10)
    assert (data, address[0]) == (b"x", LOOPBACK)


@pytest.mark.parametrize("platform", ["linux", "darwin"])
def test_a_host_in_place_of_a_group_is_the_only_place_that_hears(
    platform: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "platform", platform)
    with group_receiver(LOOPBACK, 0, LOOPBACK) as made:
        assert made.getsockname()[0] == LOOPBACK


@pytest.mark.parametrize(
    ("host", "interface", "is_local"),
    [(LOOPBACK, None, True), ("0.0.0.0", LOOPBACK, False)],
)
def test_a_server_of_this_machine_hears_no_other_referee(
    host: str, interface: str | None, is_local: bool
) -> None:
    server = Server(Settings(referee="external"))
    places = Network(host, interface, network().ports, SSL_GROUPS)
    with SocketLoop(server, places):
        for address in (("192.0.2.7", 10003), (LOOPBACK, 10003)):
            assert server.receive("referee", b"\xff\xff", address, 0.0) == []
    counts = server.session.counts
    assert counts["referee: not of this machine"] == is_local
    assert counts["referee: unreadable"] == 2 - is_local


def test_addresses_of_this_machine_are_known(places: Network) -> None:
    assert is_own_host(LOOPBACK)
    assert not is_own_host("192.0.2.7")
    server = Server(Settings())
    with SocketLoop(server, places):
        assert server.session.is_own_host is is_own_host


def test_messages_that_take_long_leave_time_for_ticks(places: Network) -> None:
    now = 0.0

    def clock() -> float:
        nonlocal now
        now += BATCH_SECONDS / 4
        return now

    server = Server(Settings())
    with SocketLoop(server, places, clock) as loop, receiver(LOOPBACK, 0) as client:
        for _ in range(BATCH):
            client.sendto(b"\xff", loop.addresses["control"])
        loop.turn(PATIENCE)
        assert 1 <= server.session.counts["control: received"] <= 4


def test_a_taken_port_is_named() -> None:
    with receiver(LOOPBACK, 0) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(OSError, match=f"127.0.0.1:{port}: .*in use"):
            SocketLoop(Server(), network(blue=port))


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"host": "localhost"}, "host: expected an IPv4 address, got 'localhost'"),
        ({"ports": {"blue": 70000}}, "ports: expected 0 to 65535 for blue, got 70000"),
        ({"groups": {"vision": "x"}}, "groups: vision: expected an IPv4 address, got 'x'"),
        ({"ttl": 256}, "ttl: expected 0 to 255, got 256"),
    ],
)
def test_places_are_checked(change: dict[str, object], message: str) -> None:
    values: dict[str, object] = {"host": LOOPBACK, "interface": None, "ports": {}, "groups": {}}
    with pytest.raises(ValueError, match=message):
        Network(**(values | change))  # type: ignore[arg-type]
