"""Robots stop when the process that drives them fails: with FIRASim, which has no watchdog."""

from __future__ import annotations

import contextlib
import socket
import subprocess
import sys
import threading

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.bridge.sockets import LOOPBACK, receiver
from rsoccer.drive.connection import Connection
from rsoccer.drive.settings import Settings
from rsoccer.frame import Frame
from rsoccer.protocols import fira
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.schemas import fira_pb2
from tests.bridge.ports import free_port
from tests.bridge.test_sockets import PATIENCE

CONFIG = SimConfig("vss_3v3", 3, 3)


class FakeFiraSim:
    """Vision of robots that never move, and their commands."""

    def __init__(self) -> None:
        self.commands = receiver(LOOPBACK, 0)
        self.commands.settimeout(PATIENCE)
        self.vision = free_port()
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._show)
        self._thread.start()

    @property
    def port(self) -> int:
        number: int = self.commands.getsockname()[1]
        return number

    def _show(self) -> None:
        layout = WireLayout(CONFIG, blue_on_positive_half=True)
        frame = Frame.empty(1, 3, 3)
        frame.robots.heading[..., 0] = 1.0
        seconds = 0.0
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            while not self._is_over.wait(0.016):
                seconds += 0.016
                message = fira.to_environment(layout, frame, seconds=seconds, score=(0, 0))
                sender.sendto(message.SerializeToString(), (LOOPBACK, self.vision))

    def wheels(self) -> tuple[float, tuple[str, int]]:
        """Return the greatest speed of a wheel in the next packet of blue, and its sender."""
        data, address = self.commands.recvfrom(65535)
        packet = fira_pb2.Packet.FromString(data)
        named = packet.cmd.robot_commands
        assert [(each.id, each.yellowteam) for each in named] == [(i, False) for i in range(3)]
        return max(each.wheel_left for each in named), address

    def close(self) -> None:
        self._is_over.set()
        self._thread.join()
        self.commands.close()


@pytest.mark.parametrize("waits", [False, True])
def test_a_simulator_that_waits_gets_no_stops_while_a_policy_decides(waits: bool) -> None:
    peer = FakeFiraSim()
    settings = Settings(
        "firasim",
        ports={"command": peer.port, "vision": peer.vision},
        groups={"vision": LOOPBACK},
        referee="ignore",
        is_synchronous=waits,
        guard_timeout=0.1,
    )
    connection = Connection(CONFIG, settings)
    try:
        connection.begin()
        commands = np.full((6, 2), 20.0, np.float32)
        connection.advance(commands, connection.sight.clock.now + 0.05)
        while peer.wheels()[0] == 0.0:
            pass
        peer.commands.settimeout(0.6)  # a decision that takes as long
        speeds = []
        with contextlib.suppress(TimeoutError):
            while 0.0 not in speeds:
                speeds.append(peer.wheels()[0])
        assert (0.0 in speeds) == (not waits)
        peer.commands.settimeout(PATIENCE)
    finally:
        connection.close()
        peer.close()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
@pytest.mark.parametrize("how", ["killed", "hanging", "closed"])
def test_robots_stop_when_their_driver_fails(how: str) -> None:
    peer = FakeFiraSim()
    words = [sys.executable, "-m", "tests.drive.driver", how, str(peer.port), str(peer.vision)]
    process = subprocess.Popen(words)
    try:
        driver, speed = None, 0.0
        while speed == 0.0:  # it stands until all robots are in sight
            speed, driver = peer.wheels()
        assert speed == 20.0
        while speed:  # it drives no longer than it lives
            speed, address = peer.wheels()
        for _ in range(5):
            speed, address = peer.wheels()
            assert speed == 0.0
            assert address == driver, "simulators take commands of one address alone"
    finally:
        process.kill()
        process.wait()
        peer.close()
    assert process.returncode in ({"killed": (-9,), "hanging": (-9,)}.get(how, (0, -9)))
