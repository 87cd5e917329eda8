"""Packets of any content, to all ports, while a team plays."""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np
import pytest

from rsoccer.protocols.schemas import (
    fira_pb2,
    grsim_pb2,
    simulation_pb2,
    vssref_pb2,
)
from tests.bridge.clients import OTHER, YELLOW, Wall, local_velocity

PACKETS = 3000


def mutated(rng: random.Random, data: bytes) -> bytes:
    """Return bytes with some of them changed, cut off or repeated."""
    content = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        if content and rng.random() < 0.8:
            content[rng.randrange(len(content))] = rng.randrange(256)
        elif rng.random() < 0.5:
            del content[rng.randrange(len(content) + 1) :]
        else:
            content *= 2
    return bytes(content[:2000])


def samples(league: str) -> list[bytes]:
    """Return valid messages of all ports."""
    if league == "vsss":
        packet = fira_pb2.Packet()
        packet.cmd.robot_commands.add(id=1, wheel_left=10.0, wheel_right=-5.0)
        packet.replace.ball.x = 0.2
        packet.replace.robots.add(turnon=True).position.x = 0.3
        placement = vssref_pb2.Placement()
        placement.world.robots.add(robot_id=1, x=0.1, y=0.2, orientation=20.0)
        return [packet.SerializeToString(), placement.SerializeToString()]
    command = simulation_pb2.Command()
    command.control.teleport_ball.x = 1.0
    robot = command.control.teleport_robot.add(x=1.0, y=2.0, orientation=0.5)
    robot.id.id, robot.id.team = 1, simulation_pb2.BLUE
    specs = command.config.robot_specs.add(radius=0.08)
    specs.id.id, specs.id.team = 2, simulation_pb2.BLUE
    packet = grsim_pb2.Packet()
    packet.commands.timestamp, packet.commands.isteamyellow = 1.0, False
    packet.replacement.ball.x = 1.0
    packet.replacement.robots.add(x=0.0, y=1.0, dir=10.0, id=1, yellowteam=False)
    return [local_velocity(range(6)), command.SerializeToString(), packet.SerializeToString()]


def packets_of(rng: random.Random, valid: list[bytes]) -> Iterator[bytes]:
    """Yield random, mutated and valid packets."""
    for nth in range(PACKETS):
        source = rng.randrange(3)
        if source == 0:
            yield rng.randbytes(rng.randrange(60))
        elif source == 1 or nth % 10:
            yield mutated(rng, rng.choice(valid))
        else:
            yield rng.choice(valid)


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_nothing_breaks(league: str) -> None:
    packets = packets_of(random.Random(league), samples(league))
    wall = Wall(league=league, options={"half_seconds": 5.0})
    if league == "ssl":
        wall.team(local_velocity(range(6)), "yellow", YELLOW)
    answers = 0
    for nth, data in enumerate(packets):
        for port in wall.server.inputs:
            if port != "yellow":
                answers += len(wall.send(port, data, OTHER))
        if nth % 10 == 0:
            if league == "ssl":
                assert not wall.team(local_velocity(range(6)), "yellow", YELLOW).errors
            wall.tick()
            assert np.isfinite(wall.server.session.arena.frame.rows).all()
            if league == "ssl":
                assert (wall.server.session.commands[6:, 0] == 1.0).all()
    counts = wall.server.session.counts
    assert sum(count for name, count in counts.items() if name.endswith("unreadable")) > PACKETS
    assert answers > (PACKETS if league == "ssl" else -1)
    assert wall.seconds > 1.0
