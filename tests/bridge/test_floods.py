"""Packets of any content, to all ports, while a team plays."""

from __future__ import annotations

import os
import random
from collections.abc import Iterator

import numpy as np
import pytest

from rsoccer.bridge.server import MAX_SIZES
from rsoccer.bridge.session import Datagram
from rsoccer.protocols.errors import MAX_PROBLEMS
from rsoccer.protocols.parsing import MAX_EVENTS, MAX_ROBOTS, MAX_SIZE
from rsoccer.protocols.schemas import (
    fira_pb2,
    grsim_pb2,
    simulation_pb2,
    vssref_pb2,
)
from tests.bridge.clients import OTHER, YELLOW, Wall, local_velocity
from tests.bridge.test_server import referee_packet
from tests.bridge.test_vsss import wheels

PACKETS = int(
    os.environ.get("RSOCCER_FLOOD_PACKETS", "3000")
)  # to each port; `make soak` has a million


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
    if content and rng.random() < 0.01:
        content *= MAX_SIZE // len(content)
    return bytes(content)


def samples(league: str) -> list[bytes]:
    """Return valid messages of all ports."""
    if league == "vsss":
        wheeled = fira_pb2.Packet()
        wheeled.cmd.robot_commands.add(id=1, wheel_left=10.0, wheel_right=-5.0)
        wheeled.cmd.robot_commands.add(id=2, yellowteam=True, wheel_left=3.0)
        wheeled.replace.ball.x = 0.2
        wheeled.replace.robots.add(turnon=True).position.x = 0.3
        placement = vssref_pb2.Placement()
        placement.world.robots.add(robot_id=1, x=0.1, y=0.2, orientation=20.0)
        return [wheeled.SerializeToString(), placement.SerializeToString()]
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


def drive_yellow(wall: Wall, league: str) -> list[Datagram]:
    """Let yellow's client send commands, and return the answers."""
    if league == "vsss":
        return wall.send("command", wheels(1, 7.0, 7.0), YELLOW)
    assert not wall.team(local_velocity(range(6)), "yellow", YELLOW).errors
    return []


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_nothing_breaks(league: str) -> None:
    packets = packets_of(random.Random(league), samples(league))
    # Some packets make the simulation fast, so that commands would time out between two of yellow.
    wall = Wall(league=league, options={"half_seconds": 5.0}, command_timeout=3600.0)
    drive_yellow(wall, league)
    answered = longest = 0
    for nth, data in enumerate(packets):
        for port in wall.server.inputs:
            if port != "yellow":
                for answer in wall.send(port, data, OTHER):
                    answered, longest = answered + 1, max(longest, len(answer.data))
        if nth % 10 == 0:
            assert not drive_yellow(wall, league)
            wall.tick()
            wall.sent.clear()
            session = wall.server.session
            assert np.isfinite(session.arena.frame.rows).all()
            driven = session.teams[1].slots
            assert (session.commands[driven.start :, 0] == (7.0 if league == "vsss" else 1.0)).all()
    counts = wall.server.session.counts
    assert sum(count for name, count in counts.items() if name.endswith("unreadable")) > PACKETS
    if league == "ssl":
        assert answered > PACKETS
        assert longest < MAX_SIZE
    else:
        assert not answered, "the protocols of VSSS have no answers"
        assert counts["command: yellow taken"] > 0
    assert wall.seconds > 1.0


def long_lists(entries: int) -> dict[str, list[bytes]]:
    """Return messages with entries of robots that do not exist, by port."""
    commands, control = simulation_pb2.RobotControl(), simulation_pb2.Command()
    specs, packet = simulation_pb2.Command(), grsim_pb2.Packet()
    put, fira, placement = grsim_pb2.Packet(), fira_pb2.Packet(), vssref_pb2.Placement()
    packet.commands.timestamp, packet.commands.isteamyellow = 0.0, False
    for _ in range(entries):
        commands.robot_commands.add(id=99)
        control.control.teleport_robot.add().id.id = 99
        specs.config.robot_specs.add().id.id = 99
        packet.commands.robot_commands.add(
            id=99, wheelsspeed=False, veltangent=0, velnormal=0, velangular=0, kickspeedx=0,
            kickspeedz=0, spinner=False,
        )  # fmt: skip
        put.replacement.robots.add(x=0.0, y=0.0, dir=0.0, id=99, yellowteam=False)
        fira.cmd.robot_commands.add(id=99)
        fira.replace.robots.add().position.robot_id = 99
        placement.world.robots.add(robot_id=99)
    return {
        "blue": [commands.SerializeToString()],
        "control": [control.SerializeToString(), specs.SerializeToString()],
        "grsim": [packet.SerializeToString(), put.SerializeToString()],
        "command": [fira.SerializeToString()],
        "replacer": [placement.SerializeToString()],
    }


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_long_lists_of_robots_are_refused_at_once(league: str) -> None:
    wall, messages = Wall(league=league), long_lists(MAX_ROBOTS + 1)
    counts, ports = wall.server.session.counts, set(wall.server.inputs) & set(messages)
    assert len(ports) == (3 if league == "ssl" else 2)
    for port in ports:
        for data in messages[port]:
            answers = wall.send(port, data)
            if port in ("blue", "control"):
                text = simulation_pb2.Response.FromString(answers[0].data)
                codes = wall.team(data).errors if port == "blue" else text.errors
                assert [error.code for error in codes] == ["TOO_LARGE"]
        assert counts[f"{port}: unreadable"] >= len(messages[port])


def test_an_answer_lists_some_problems_and_the_number_of_others() -> None:
    wall, messages = Wall(), long_lists(100)
    (answer,) = wall.send("control", messages["control"][0])
    for errors in (
        wall.team(messages["blue"][0]).errors,
        simulation_pb2.Response.FromString(answer.data).errors,
    ):
        assert len(errors) == MAX_PROBLEMS + 1
        assert errors[-1].code == "MORE_PROBLEMS"
        assert errors[-1].message.endswith("got 68 more")


def test_endless_lists_are_not_read() -> None:
    wall = Wall()
    known = local_velocity([1]) * 2500  # one robot again and again
    assert len(known) < MAX_SIZE
    assert [error.code for error in wall.team(known).errors] == ["TOO_LARGE"]
    assert not wall.server.session.commands.any()


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_messages_that_no_client_sends_are_refused_before_they_are_read(league: str) -> None:
    wall = Wall(league=league, referee="external")
    counts = wall.server.session.counts
    for port in wall.server.inputs:
        most = MAX_SIZES[port]
        for size, words in ((most, "expected a"), (most + 1, f"expected at most {most} bytes")):
            answers = wall.send(port, bytes(size))  # zeros are no message of any kind
            assert len(answers) == (port in ("blue", "yellow", "control"))
            for answer in answers:
                # Both kinds of answers have their errors in the same field.
                (error,) = simulation_pb2.Response.FromString(answer.data).errors
                assert words in error.message
        assert counts[f"{port}: unreadable"] == 2


def test_messages_with_all_fields_of_all_robots_have_room() -> None:
    for port, messages in long_lists(MAX_ROBOTS).items():
        assert max(map(len, messages)) < MAX_SIZES[port]
    message = simulation_pb2.RobotControl()
    for _ in range(MAX_ROBOTS):
        command = message.robot_commands.add(id=2**31, kick_speed=1.0, kick_angle=1.0)
        command.dribbler_speed = 1.0
        wheels = command.move_command.wheel_velocity
        wheels.front_right = wheels.back_right = wheels.back_left = wheels.front_left = 1.0
    assert len(message.SerializeToString()) < MAX_SIZES["blue"]


def test_endless_lists_of_events_are_refused_by_their_name() -> None:
    wall = Wall(referee="external")
    packet = referee_packet()
    for _ in range(MAX_EVENTS + 1):
        packet.game_events.add()
    assert len(packet.SerializeToString()) < MAX_SIZES["referee"]
    assert wall.send("referee", packet.SerializeToString()) == []
    counts = wall.server.session.counts
    assert counts["referee: unreadable"] == 1
    del packet.game_events[0]
    wall.send("referee", packet.SerializeToString())
    assert counts["referee: unreadable"] == 1
