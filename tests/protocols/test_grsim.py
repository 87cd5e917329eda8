"""grSim's packets."""

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.game import BLUE, YELLOW
from rsoccer.protocols import grsim
from rsoccer.protocols.commands import motion
from rsoccer.protocols.errors import Code
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import grsim_pb2
from tests.protocols.matches import SIDES, SSL, WHEELS, codes, commands, layout, state


def command(**fields: float) -> grsim_pb2.Packet:
    packet = grsim_pb2.Packet()
    packet.commands.timestamp, packet.commands.isteamyellow = 0.0, False
    values = dict.fromkeys(
        ("kickspeedx", "kickspeedz", "veltangent", "velnormal", "velangular"), 0.0
    )
    entry = {"id": 5, "spinner": False, "wheelsspeed": False, **values, **fields}
    packet.commands.robot_commands.add(**entry)
    return packet


@pytest.mark.parametrize("config", [SSL, WHEELS])
@pytest.mark.parametrize("team", [BLUE, YELLOW])
def test_commands_survive_the_wire(config: SimConfig, team: int) -> None:
    made, rows = layout(config), commands(config)
    sent = grsim.to_commands(made, rows, team, timestamp=5.0).SerializeToString()
    result = grsim.read_commands(made, parse(grsim_pb2.Packet, sent))
    assert not result.problems
    for slot in made.slots(team):
        now = motion(config.robots[slot], result.commands[slot])
        then = motion(config.robots[slot], rows[slot])
        assert np.allclose(now.velocity, then.velocity, atol=1e-4)
        assert np.allclose(now.kick, then.kick)
        assert now.dribbler == (then.dribbler >= 0.5)
    assert result.given.sum() == len(made.slots(team))


def test_velocities_are_forward_and_left() -> None:
    packet = command(veltangent=1.0, velnormal=2.0, velangular=3.0, kickspeedx=4.0, spinner=True)
    row = grsim.read_commands(layout(), packet).commands[0]
    assert row.tolist() == [1, 2, 3, 4, 0, 1]


def test_wheels_are_rad_per_second_from_the_front_left() -> None:
    packet = command(wheelsspeed=True, wheel1=1.0, wheel2=2.0, wheel3=3.0, wheel4=4.0, velnormal=9)
    row = grsim.read_commands(layout(WHEELS), packet).commands[0]
    assert row[:4].tolist() == [1, 2, 3, 4]
    assert WHEELS.robot.wheel_angles == [60.0, 135.0, 225.0, 300.0], "front left first"


def test_missing_wheels_and_negative_kicks_are_listed() -> None:
    packet = command(wheelsspeed=True, wheel1=1.0, kickspeedx=-1.0)
    result = grsim.read_commands(layout(), packet)
    assert codes(result.problems) == [Code.INCOMPLETE, Code.OUT_OF_RANGE]
    assert not result.commands.any()


def test_tiny_kicks_are_none() -> None:
    assert not grsim.read_commands(layout(), command(kickspeedx=1e-4)).commands.any()


@pytest.mark.parametrize("positive", SIDES)
def test_replacements_survive_the_wire(positive: bool) -> None:
    made, frame = layout(positive=positive), state()
    frame.robots.absent[1, 4] = 1.0
    sent = grsim.to_replacement(made, frame, 1).SerializeToString()
    placement = grsim.read_replacement(made, parse(grsim_pb2.Packet, sent), state(seed=5))
    assert not placement.problems
    robots, there = placement.frame.robots, [0, 1, 2, 3, 5, 6]
    assert np.allclose(robots.position[0, there], frame.robots.position[1, there], atol=1e-6)
    assert np.allclose(robots.heading[0, there], frame.robots.heading[1, there], atol=1e-6)
    assert robots.absent[0].tolist() == [0, 0, 0, 0, 1, 0, 0]
    assert not robots.velocity.any()
    assert np.allclose(placement.frame.ball.position[0], frame.ball.position[1], atol=1e-6)
    assert np.allclose(placement.frame.ball.velocity[0], frame.ball.velocity[1], atol=1e-6)


def test_directions_are_degrees_and_robots_stay_on() -> None:
    packet = grsim_pb2.Packet()
    packet.replacement.robots.add(x=1.0, y=2.0, dir=90.0, id=3, yellowteam=True)
    packet.replacement.robots.add(x=1.0, y=2.0, dir=90.0, id=3, yellowteam=False)
    packet.replacement.ball.x = 90.0
    placement = grsim.read_replacement(layout(), packet, state())
    assert np.allclose(placement.frame.robots.heading[0, 4], (0.0, 1.0), atol=1e-6)
    assert placement.frame.robots.absent[0, 4] == 0.0
    assert codes(placement.problems) == [Code.UNKNOWN_ROBOT, Code.OUT_OF_RANGE]
    only = grsim.to_replacement(layout(), state(), robots=np.arange(7) == 4)
    assert [robot.id for robot in only.replacement.robots] == [3]


def test_status_tells_of_beams_and_kicks() -> None:
    frame, rows = state(), np.zeros((7, 6), np.float32)
    frame.robots.infrared[0, 1] = frame.robots.touched_ball[0, 0] = 1.0
    frame.robots.touched_ball[0, 2] = 1.0
    rows[0, 3:5], rows[2, 3:5] = (2.0, 0.0), (2.0, 1.5)
    message = grsim.to_status(layout(), frame, 0, BLUE, rows)
    reported = [(s.robot_id, s.infrared, s.flat_kick, s.chip_kick) for s in message.robots_status]
    assert reported == [(5, False, True, False), (0, True, False, False), (11, False, False, True)]
    sent = parse(grsim_pb2.StatusPacket, message.SerializeToString())
    assert grsim.read_status(layout(), sent, BLUE) == {0: False, 1: True, 2: False}
    assert grsim.read_status(layout(), sent, YELLOW) == {}


def test_a_ball_without_numbers_stays() -> None:
    message, before = grsim_pb2.Packet(), state()
    message.replacement.ball.SetInParent()
    placement = grsim.read_replacement(layout(), message, before, 1)
    assert not placement.ball
    assert np.array_equal(placement.row, before.rows[1])
