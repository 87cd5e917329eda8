"""The check of sides, signs and delay."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from rsoccer import Sensing, SimConfig
from rsoccer.drive.check import Movement, check_robot, describe
from rsoccer.drive.connection import Connection
from rsoccer.drive.link import Received
from rsoccer.drive.peers import Message
from rsoccer.game import Command
from rsoccer.protocols.limits import Limits
from rsoccer.protocols.schemas import simulation_pb2, vision_pb2
from tests.drive.test_connection import packet_of
from tests.drive.wires import ServerLink, connected

SSL = SimConfig("ssl_b", 1, 0)


def test_a_robot_that_obeys_is_right_and_its_delay_is_measured() -> None:
    sensing = Sensing(delay=0.05, command_delay=0.03, frame_rate=60.0)
    link = ServerLink(referee="off", sensing=sensing, blue_on_positive_half=True)
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), blue_on_positive_half=True)
    found = check_robot(connection, 0)
    assert found.is_right
    assert found.delay == pytest.approx(0.08, abs=0.011)
    assert found.gain == pytest.approx(1.0, abs=0.02)
    text = describe(connection, found, 0)
    assert "blue 5 is at (0.90, 1.50) m on the wire; its own goal is at +x there" in text
    assert text.count("right") >= 6
    assert f"use --delay {found.delay:g}" in text
    # Only its team was commanded, and the robot is back and stands.
    assert {message.port for message in link.messages} == {"blue"}
    assert not link.frame.robots.velocity[0, 5].round(2).any()


def test_a_side_that_is_wrong_shows_in_the_places() -> None:
    link = ServerLink(referee="off", blue_on_positive_half=True)
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), blue_on_positive_half=False)
    found = check_robot(connection, 0)
    assert found.position == pytest.approx((0.9, 1.5), abs=0.01)  # in the half of the opponents


class Reversed(ServerLink):
    """Robots whose software has a sign wrong."""

    def send(self, messages: Iterable[Message]) -> None:
        turned = []
        for message in messages:
            control = simulation_pb2.RobotControl.FromString(message.data)
            for each in control.robot_commands:
                local = each.move_command.local_velocity
                local.left, local.angular = -local.left, 0.3 * local.angular
            turned.append(Message(message.port, control.SerializeToString()))
        super().send(turned)


def test_wrong_signs_and_units_are_named() -> None:
    connection = connected(SSL, Reversed(referee="off"), "ssl-simulation", ids=(5,))
    found = check_robot(connection, 0)
    verdicts = {movement.name: movement.verdict for movement in found.movements}
    assert verdicts["forward"] == verdicts["back"] == "right"
    assert verdicts["left"].startswith("wrong: the opposite")
    assert verdicts["turn"].startswith("wrong: 0.3")
    assert not found.is_right
    assert "do not let a policy drive" in describe(connection, found, 0)


def test_the_delay_of_a_robot_that_stands_is_not_measured() -> None:
    link = ServerLink(referee="off")
    connection = connected(SSL, link, "ssl-simulation", ids=(5,))
    link.server.session.teams[0].hold = lambda *_, **__: None  # type: ignore[method-assign]
    found = check_robot(connection, 0)
    assert found.delay is None
    assert {movement.verdict for movement in found.movements} == {"wrong: it does not move"}
    assert "delay: not measured" in describe(connection, found, 0)


@pytest.mark.parametrize(
    ("asked", "seen", "words"),
    [
        ((0.24, 0.0, 0.0), (0.0, 0.24, 0.0), "across"),
        ((0.0, 0.24, 0.0), (-0.24, 0.0, 0.0), "across"),
        ((0.0, 0.0, 1.2), (0.0, 0.0, -1.2), "the opposite"),
        ((0.24, 0.0, 0.0), (0.48, 0.0, 0.0), "2.00 of the way"),
        ((-0.24, 0.0, 0.0), (-0.2, 0.02, 0.1), "right"),
    ],
)
def test_verdicts(
    asked: tuple[float, float, float], seen: tuple[float, float, float], words: str
) -> None:
    assert words in Movement("forward", asked, seen).verdict


def test_a_ball_that_nobody_sees_takes_no_space() -> None:
    link = ServerLink(referee="off")
    connection = connected(SSL, link, "ssl-simulation", ids=(5,))
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(x=0.05, y=0.05, orientation=0.0)
    robot.id.id, robot.id.team = 5, simulation_pb2.BLUE
    command.control.teleport_ball.x, command.control.teleport_ball.y = 3.0, 1.0
    link.server.receive("control", command.SerializeToString(), ("127.0.0.1", 5109), link.now)
    real_poll = link.poll

    def poll(seconds: float) -> list[Received]:
        found = []
        for port, sent in real_poll(seconds):
            data = sent
            if port == "vision":
                packet = vision_pb2.Packet.FromString(data)
                packet.detection.ClearField("balls")
                data = packet.SerializeToString()
            found.append(Received(port, data))
        return found

    link.poll = poll  # type: ignore[method-assign]
    found = check_robot(connection, 0)
    assert np.abs(found.position).max() < 0.1
    assert not connection.sight.has_ball
    assert found.is_right


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        (Limits(speed=0.3), r"limits: speed: expected 0\.4 m/s or more for the check, got 0\.3"),
        (Limits(angular_velocity=1.0), r"limits: angular_velocity: expected 2 rad/s .*, got 1$"),
    ],
)
def test_limits_below_the_speeds_of_the_check_are_refused(limits: Limits, message: str) -> None:
    link = ServerLink(referee="off")
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), limits=limits)
    with pytest.raises(ValueError, match=message):
        check_robot(connection, 0)


def test_robots_that_the_task_does_not_have_take_space() -> None:
    link = ServerLink(referee="off", blue_on_positive_half=True)
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), blue_on_positive_half=True)
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(x=1.2, y=1.5, orientation=0.0)
    robot.id.id, robot.id.team = 0, simulation_pb2.YELLOW
    link.server.receive("control", command.SerializeToString(), ("127.0.0.1", 5109), link.now)
    with pytest.raises(
        ValueError, match=r"check: expected 0\.47 m of free .*, got 0\.30 m to yellow 0"
    ):
        check_robot(connection, 0)
    assert not link.frame.robots.velocity[0, 5].round(3).any()


@pytest.mark.parametrize(
    ("division", "x", "room"), [("A", 5.0, None), ("B", 4.4, r"0\.10 m to a line")]
)
def test_lines_are_those_of_the_field_that_vision_tells(
    division: str, x: float, room: str | None
) -> None:
    link = ServerLink(referee="off", division=division)
    field = "ssl_b" if division == "A" else "ssl_a"
    connection = connected(SimConfig(field, 1, 0), link, "ssl-simulation", ids=(5,))
    for _ in range(20):
        link.tick()  # the first geometry is missed
    link.poll(0.0)
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(x=x, y=2.0, orientation=0.0)
    robot.id.id, robot.id.team = 5, simulation_pb2.BLUE
    link.server.receive("control", command.SerializeToString(), ("127.0.0.1", 5109), link.now)
    if room is None:
        assert check_robot(connection, 0).is_right
    else:
        with pytest.raises(ValueError, match=rf"check: expected 0\.47 m of free .*, got {room}"):
            check_robot(connection, 0)


def test_a_robot_whose_number_was_misread_takes_no_space() -> None:
    link = ServerLink(referee="off")
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), patience=0.25)
    real_poll, misread = link.poll, [True]

    def poll(seconds: float) -> list[Received]:
        found = []
        for port, sent in real_poll(seconds):
            data = sent
            if port == "vision" and misread and connection.sight.frames > 3:
                packet = vision_pb2.Packet.FromString(data)
                for robot in packet.detection.robots_blue:
                    robot.robot_id = 7 if robot.robot_id == 5 else robot.robot_id
                data = packet.SerializeToString()
                misread.clear()
            found.append(Received(port, data))
        return found

    link.poll = poll  # type: ignore[method-assign]
    assert check_robot(connection, 0).is_right
    assert not misread


@pytest.mark.parametrize(
    ("command", "word"), [(Command.STOP, "STOP"), (Command.HALT, "HALT"), (None, None)]
)
def test_a_referee_that_keeps_robots_away_is_refused(
    command: Command | None, word: str | None
) -> None:
    link = ServerLink(referee="off")
    required = {"referee": "require"} if command is None else {}
    connection = connected(SSL, link, "ssl-simulation", ids=(5,), **required)
    if command is not None:
        link.give("referee", packet_of(command))
    with pytest.raises(ValueError, match=f"--referee ignore`, got {word or 'no packet'}"):
        check_robot(connection, 0)
    assert not link.frame.robots.velocity[0, 5].round(3).any()


def test_a_robot_needs_space_and_must_be_driven() -> None:
    link = ServerLink(league="vsss", referee="off")
    connection: Connection = connected(SimConfig("vss_3v3", 3, 3), link, "firasim")
    with pytest.raises(
        ValueError, match=r"check: expected 0\.40 m of free field .*, got 0\.\d\d m"
    ):
        check_robot(connection, 1)
    with pytest.raises(ValueError, match=r"check: expected one of \[0, 1, 2\], got 3"):
        check_robot(connection, 3)
    assert not np.abs(link.server.session.commands).any()
