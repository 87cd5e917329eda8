"""VSSS in process: FIRASim's packets and VSSReferee's."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer.protocols.schemas import fira_pb2, vssref_pb2
from tests.bridge.clients import BLUE, OTHER, REMOTE, YELLOW, Wall


def wheels(team: int, left: float, right: float, robots: int = 3) -> bytes:
    packet = fira_pb2.Packet()
    for number in range(robots):
        packet.cmd.robot_commands.add(
            id=number, yellowteam=bool(team), wheel_left=left, wheel_right=right
        )
    data: bytes = packet.SerializeToString()
    return data


def test_teams_drive_and_see() -> None:
    wall = Wall(league="vsss", referee="off")
    start = wall.robots.position[0].copy()
    for _ in range(20):
        assert wall.send("command", wheels(0, 20.0, 20.0), BLUE) == []
        assert wall.send("command", wheels(1, -20.0, 20.0), YELLOW) == []
        wall.tick(3)
    assert (wall.server.session.commands[:3] == 20.0).all()
    assert (wall.server.session.commands[3:] == [-20.0, 20.0]).all()
    assert np.linalg.norm(wall.robots.position[0, :3] - start[:3], axis=1).min() > 0.05
    seen = [fira_pb2.Environment.FromString(e.data) for e in wall.sent if e.port == "vision"]
    assert len(seen[-1].frame.robots_yellow) == 3
    # As in FIRASim, blue has the positive half on the wire.
    assert seen[-1].frame.robots_blue[1].x == pytest.approx(
        -wall.robots.position[0, 1, 0], abs=0.05
    )
    assert seen[0].step < seen[-1].step
    wall.tick(60)
    assert not wall.server.session.commands.any(), "robots stop without commands"


def test_a_second_client_of_a_team_is_refused_and_counted() -> None:
    wall = Wall(league="vsss")
    wall.send("command", wheels(0, 20.0, 20.0), BLUE)
    wall.send("command", wheels(0, -20.0, -20.0), OTHER)
    wall.tick()
    assert (wall.server.session.commands[:3] == 20.0).all()
    assert wall.server.session.counts["command: blue taken"] == 1


def test_one_client_may_drive_both_teams() -> None:
    wall = Wall(league="vsss")
    wall.send("command", wheels(0, 20.0, 20.0) + wheels(1, 5.0, 5.0), BLUE)
    wall.tick()
    assert wall.server.session.commands.tolist() == [[20.0, 20.0]] * 3 + [[5.0, 5.0]] * 3


def test_bodies_are_put_by_this_machine_alone() -> None:
    wall = Wall(league="vsss", referee="off")
    packet = fira_pb2.Packet()
    packet.replace.ball.x, packet.replace.ball.y = 0.3, 0.4
    wall.send("command", packet.SerializeToString(), REMOTE)
    assert wall.server.session.counts["command: remote control refused"] == 1
    wall.send("command", packet.SerializeToString(), OTHER)
    ball = wall.server.session.arena.frame.ball.position[0]
    np.testing.assert_allclose(ball, [-0.3, -0.4], atol=1e-6)


def placement(robot: int = 1, x: float = 0.5) -> bytes:
    message = vssref_pb2.Placement()
    message.world.teamColor = vssref_pb2.BLUE
    message.world.robots.add(robot_id=robot, x=x, y=0.5, orientation=90.0)
    data: bytes = message.SerializeToString()
    return data


def test_nobody_is_placed_while_an_external_referee_lets_play_go_on() -> None:
    wall = Wall(league="vsss", referee="external")
    for foul, x in ((vssref_pb2.KICKOFF, -0.5), (vssref_pb2.GAME_ON, -0.5)):
        command = vssref_pb2.Command(foul=foul, teamcolor=vssref_pb2.BLUE)
        wall.send("referee", command.SerializeToString())
        wall.send("replacer", placement(x=0.5 if foul == vssref_pb2.KICKOFF else 0.2))
        np.testing.assert_allclose(wall.robots.position[0, 1], [x, -0.5], atol=1e-6)
    assert wall.server.session.counts["replacer: refused while play goes on"] == 1


def test_a_team_that_somebody_drives_is_placed_from_there() -> None:
    wall = Wall(league="vsss")
    wall.send("command", wheels(0, 0.0, 0.0), REMOTE)
    before = wall.robots.position[0, 1].tolist()
    wall.send("replacer", placement(), BLUE)
    assert wall.robots.position[0, 1].tolist() == before
    assert wall.server.session.counts["replacer: remote control refused"] == 1
    wall.send("replacer", placement(), (REMOTE[0], 6000))
    np.testing.assert_allclose(wall.robots.position[0, 1], [-0.5, -0.5], atol=1e-6)


def test_the_referee_tells_and_a_team_places_its_robots() -> None:
    wall = Wall(league="vsss")
    wall.tick(20)
    reported = [vssref_pb2.Command.FromString(e.data) for e in wall.sent if e.port == "referee"]
    assert [each.foul for each in reported][:1] == [vssref_pb2.KICKOFF]
    placement = vssref_pb2.Placement()
    placement.world.teamColor = vssref_pb2.BLUE
    placement.world.robots.add(robot_id=1, x=0.5, y=0.5, orientation=90.0)
    wall.send("replacer", placement.SerializeToString())
    np.testing.assert_allclose(wall.robots.position[0, 1], [-0.5, -0.5], atol=1e-6)
    wall.tick(2000)
    reported = [vssref_pb2.Command.FromString(e.data) for e in wall.sent if e.port == "referee"]
    assert vssref_pb2.GAME_ON in [each.foul for each in reported]


def test_problems_of_a_packet_for_both_teams_are_counted_once() -> None:
    wall, packet = Wall(league="vsss"), fira_pb2.Packet()
    for yellow, number in ((False, 0), (True, 1), (False, 9)):
        packet.cmd.robot_commands.add(yellowteam=yellow, id=number)
    wall.send("command", packet.SerializeToString())
    assert wall.server.session.counts["command: parts refused"] == 1
