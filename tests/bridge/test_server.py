"""A server in process: who drives whom, what is sent, what is refused."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rsoccer import Sensing
from rsoccer._core import GAME_COLUMNS
from rsoccer.bridge.arena import Arena
from rsoccer.bridge.awaited_answers import RESEND_SECONDS
from rsoccer.bridge.match_tasks import TICK, make_match
from rsoccer.bridge.settings import Settings
from rsoccer.bridge.tracker_packets import TrackerPackets
from rsoccer.game import Command
from rsoccer.protocols.schemas import (
    grsim_pb2,
    referee_pb2,
    simulation_pb2,
    tracker_pb2,
    vision_pb2,
)
from tests.bridge.clients import BLUE, OTHER, REMOTE, YELLOW, Wall, local_velocity
from tests.helpers import same


def test_a_client_drives_its_team_and_sees_it() -> None:
    wall = Wall()
    start = wall.robots.position[0].copy()
    for _ in range(20):
        answer = wall.team(local_velocity([1]))
        wall.tick(3)
    assert [feedback.id for feedback in answer.feedback] == [1]
    assert not answer.errors
    moved = np.linalg.norm(wall.robots.position[0] - start, axis=1)
    assert moved[1] > 0.15
    assert np.delete(moved, 1).max() < 1e-3, "nobody else moves"
    seen = [
        packet.detection
        for packet in (
            vision_pb2.Packet.FromString(each.data) for each in wall.sent if each.port == "vision"
        )
    ]
    assert len(seen) == pytest.approx(60 * wall.seconds, abs=1)
    last = {robot.robot_id: robot for robot in seen[-1].robots_blue}
    assert last[1].x / 1000 == pytest.approx(wall.robots.position[0, 1, 0], abs=0.02)
    assert [frame.frame_number for frame in seen] == list(range(len(seen)))


def test_all_ports_tell_the_same_match() -> None:
    wall = Wall(sensing=Sensing("rc2021"), blue_on_positive_half=True)
    wall.tick(100)
    kinds: dict[str, Any] = {
        "vision": vision_pb2.Packet,
        "tracker": tracker_pb2.Packet,
        "referee": referee_pb2.Packet,
    }
    reported = {
        port: [kind.FromString(each.data) for each in wall.sent if each.port == port]
        for port, kind in kinds.items()
    }
    assert {frame.detection.camera_id for frame in reported["vision"]} == {0, 1}
    assert reported["vision"][0].geometry.field.field_length == 9000
    assert len(reported["vision"][0].geometry.calib) == 2
    tracked = reported["tracker"][-1].tracked_frame
    assert len(tracked.robots) == 12
    blue = [robot for robot in tracked.robots if robot.robot_id.team_color == 2]
    assert min(robot.pos.x for robot in blue) > 0, "blue has the positive half"
    assert reported["referee"][-1].blue_team_on_positive_half
    assert len(reported["referee"]) >= 0.5 / 0.025


def test_a_command_that_is_given_again_is_reported_at_once_with_a_new_count() -> None:
    wall = Wall(options={"referee": {"prepare_seconds": 5.0}})
    packets = [
        referee_pb2.Packet.FromString(each.data) for each in wall.tick(20) if each.port == "referee"
    ]
    assert len({packet.command_counter for packet in packets}) == 1, "one command goes on"
    game = wall.server.session.arena.play.game.referee[0]
    game[GAME_COLUMNS.index("command_steps")] = 0
    wall.tick(4)
    last = referee_pb2.Packet.FromString(
        next(each.data for each in reversed(wall.sent) if each.port == "referee")
    )
    assert last.command == packets[-1].command
    assert last.command_counter == packets[-1].command_counter + 1
    assert last.command_timestamp > packets[-1].command_timestamp


def test_robots_stop_without_commands_and_another_client_takes_over() -> None:
    wall = Wall(command_timeout=0.2, client_timeout=1.0)
    for _ in range(30):
        wall.team(local_velocity([0]))
        wall.tick(2)
    assert np.linalg.norm(wall.robots.velocity[0, 0]) > 0.5
    wall.tick(39)
    assert wall.server.session.commands[0, 0] == 1.0, "not yet"
    wall.tick(3)
    assert not wall.server.session.commands.any(), "the robot is commanded to stop"
    answer = wall.team(local_velocity([0]), address=OTHER)
    assert [error.code for error in answer.errors] == ["TEAM_TAKEN"]
    assert str(BLUE[1]) in answer.errors[0].message
    wall.tick(200)
    assert np.linalg.norm(wall.robots.velocity[0, 0]) < 0.01
    assert not wall.team(local_velocity([0]), address=OTHER).errors
    assert [e.code for e in wall.team(local_velocity([0])).errors] == ["TEAM_TAKEN"]
    assert wall.server.session.counts["blue: left"] == 1


def test_teams_do_not_reach_each_other() -> None:
    wall = Wall()
    wall.team(local_velocity(range(6)))
    wall.team(local_velocity(range(6), -1.0), "yellow", YELLOW)
    for data in (b"\xff" * 20, local_velocity(range(100)), b"", local_velocity([0, 0])):
        wall.team(data)
    wall.tick()
    commands = wall.server.session.commands
    assert (commands[6:, 0] == -1.0).all()
    assert (commands[:6, 0] == 1.0).all()


@pytest.mark.parametrize(
    ("data", "code"),
    [
        (b"\x0a\xff", "UNREADABLE"),
        (b"\x00" * 70_000, "TOO_LARGE"),
        (local_velocity([0], math.nan), "NOT_FINITE"),
        (local_velocity([0], 1e30), "NOT_FINITE"),
        (local_velocity([77]), "UNKNOWN_ROBOT"),
    ],
)
def test_what_cannot_be_used_is_answered(data: bytes, code: str) -> None:
    wall = Wall()
    wall.team(local_velocity([1, 2]))
    assert [error.code for error in wall.team(data).errors] == [code]
    wall.tick()
    assert np.isfinite(wall.server.session.commands).all()
    assert (wall.server.session.commands[1:3, 0] == 1.0).all(), "other commands hold"


def test_control_messages_put_bodies_and_set_the_speed() -> None:
    wall = Wall(referee="off")
    message = simulation_pb2.Command()
    ball = message.control.teleport_ball
    ball.x, ball.y, ball.vx, ball.vy = 1.0, 2.5, 2.0, 0.0
    robot = message.control.teleport_robot.add(x=-2.0, y=1.0, orientation=1.0)
    robot.id.id, robot.id.team = 3, simulation_pb2.BLUE
    gone = message.control.teleport_robot.add(present=False)
    gone.id.id, gone.id.team = 4, simulation_pb2.YELLOW
    message.control.simulation_speed = 0.0
    assert wall.control(message) == []
    frame = wall.server.session.arena.frame
    np.testing.assert_allclose(frame.ball.position[0], [1.0, 2.5], atol=1e-5)
    np.testing.assert_allclose(frame.robots.position[0, 3], [-2.0, 1.0], atol=1e-5)
    assert frame.robots.absent[0, 10] == 1.0
    before = wall.seconds
    wall.tick(20)
    assert wall.seconds == before, "time stands still"
    message = simulation_pb2.Command()
    message.control.simulation_speed = 2.0
    assert wall.control(message) == []
    wall.tick(20)
    assert wall.seconds - before == pytest.approx(40 * TICK, abs=2 * TICK)
    assert wall.server.session.arena.frame.ball.position[0, 0] > 1.1


def test_control_that_cannot_be_honored_says_so() -> None:
    wall = Wall()
    message = simulation_pb2.Command()
    robot = message.control.teleport_robot.add(x=0.0, y=0.0)  # where the ball is
    robot.id.id, robot.id.team = 0, simulation_pb2.BLUE
    message.config.realism_config.SetInParent()
    assert sorted(wall.control(message)) == ["BLOCKED", "UNSUPPORTED_REALISM"]
    assert wall.control(message, REMOTE) == ["REMOTE_CONTROL"]
    assert Wall(allow_remote_control=True).control(simulation_pb2.Command(), REMOTE) == []


def test_control_from_an_address_of_this_machine_is_obeyed() -> None:
    wall = Wall()
    command = simulation_pb2.Command()
    command.control.teleport_ball.x = 1.0
    assert wall.control(command, REMOTE) == ["REMOTE_CONTROL"]
    wall.server.session.is_own_host = lambda host: host == REMOTE[0]
    assert wall.control(command, REMOTE) == []
    assert wall.control(command, ("192.0.2.8", 5004)) == ["REMOTE_CONTROL"]


def test_robots_can_be_exchanged_while_the_match_goes_on() -> None:
    wall = Wall()
    wall.tick(20)
    message = simulation_pb2.Command()
    specs = message.config.robot_specs.add(mass=3.5)
    specs.id.id, specs.id.team = 2, simulation_pb2.YELLOW
    specs.limits.vel_absolute_max = 0.5
    message.config.vision_port = 12345
    assert wall.control(message) == []
    assert wall.server.session.arena.config.robots[8].mass == pytest.approx(3.5)
    assert wall.server.ports.vision_port == 12345
    for _ in range(100):
        wall.team(local_velocity([2, 3], 2.0), "yellow", YELLOW)
        wall.tick()
    speeds = np.linalg.norm(wall.robots.velocity[0], axis=1)
    assert speeds[8] < 0.6
    assert speeds[9] > 0.9


def test_a_packet_of_grsim_drives_a_team_and_its_status_comes_back() -> None:
    wall = Wall()
    packet = grsim_pb2.Packet()
    packet.commands.timestamp, packet.commands.isteamyellow = 0.0, True
    packet.commands.robot_commands.add(
        id=5, wheelsspeed=False, veltangent=1.0, velnormal=0, velangular=0,
        kickspeedx=0, kickspeedz=0, spinner=False,
    )  # fmt: skip
    (answer,) = wall.send("grsim", packet.SerializeToString(), YELLOW)
    assert answer.address == (YELLOW[0], 30012)
    status = grsim_pb2.StatusPacket.FromString(answer.data)
    assert [robot.robot_id for robot in status.robots_status] == [5]
    assert wall.send("grsim", packet.SerializeToString(), OTHER) == []
    assert wall.server.session.counts["grsim: team taken"] == 1
    wall.tick()
    assert wall.server.session.commands[11, 0] == 1.0


def kick_command(robot: int, **fields: float) -> bytes:
    message = simulation_pb2.RobotControl()
    message.robot_commands.add(id=robot, **fields)
    data: bytes = message.SerializeToString()
    return data


@pytest.mark.parametrize("reader", ["fast", "protocol", "grsim"])
def test_a_packet_for_each_robot_leaves_the_kicks_of_others(reader: str) -> None:
    wall = Wall()
    for number in (1, 2):
        if reader == "grsim":
            packet = grsim_pb2.Packet()
            packet.commands.timestamp, packet.commands.isteamyellow = 0.0, False
            packet.commands.robot_commands.add(
                id=number, wheelsspeed=False, veltangent=1.0, velnormal=0, velangular=0,
                kickspeedx=3.0, kickspeedz=0, spinner=False,
            )  # fmt: skip
            wall.send("grsim", packet.SerializeToString())
            continue
        message = simulation_pb2.RobotControl()
        move = message.robot_commands.add(id=number, kick_speed=3.0).move_command
        if reader == "fast":
            move.local_velocity.forward = 1.0
            move.local_velocity.left = move.local_velocity.angular = 0.0
        else:
            move.global_velocity.x = 1.0
            move.global_velocity.y = move.global_velocity.angular = 0.0
        assert not wall.team(message.SerializeToString()).errors
    wall.tick()
    kicks = wall.server.session.commands[:, 3]
    np.testing.assert_allclose(kicks[:4], [0.0, 3.0, 3.0, 0.0])
    wall.team(kick_command(1))
    wall.tick()
    assert kicks[:4].tolist() == [0.0, 0.0, 3.0, 0.0], "a robot's next message ends its kick"


@pytest.mark.parametrize("side", [False, True])
def test_a_velocity_along_the_axes_of_the_field_holds_while_the_robot_turns(side: bool) -> None:
    wall = Wall(blue_on_positive_half=side, command_timeout=10.0, referee="off")
    message = simulation_pb2.RobotControl()
    moved = message.robot_commands.add(id=2).move_command.global_velocity
    moved.x, moved.y, moved.angular = 0.0, 0.5, 4.0
    start = wall.robots.position[0, 2].copy()
    assert not wall.team(message.SerializeToString()).errors
    wall.tick(200)
    way = (wall.robots.position[0, 2] - start) * (-1 if side else 1)
    assert way[1] > 0.3
    assert abs(way[0]) < 0.1 * way[1]
    wall.team(local_velocity([2], 0.0))
    wall.tick(100)
    assert np.linalg.norm(wall.robots.velocity[0, 2]) < 0.02


@pytest.mark.parametrize("fields", [{"kick_speed": 2.0}, {"dribbler_speed": 100.0}])
def test_a_kick_leaves_a_velocity_along_the_axes_of_the_field(fields: dict[str, float]) -> None:
    wall = Wall(command_timeout=10.0, referee="off")
    message = simulation_pb2.RobotControl()
    moved = message.robot_commands.add(id=2).move_command.global_velocity
    moved.x, moved.y, moved.angular = 0.0, 0.5, 4.0
    wall.team(message.SerializeToString())
    wall.team(kick_command(2, **fields))
    for _ in range(60):
        wall.tick()
        forward, left = wall.server.session.commands[2, :2].tolist()
        cos, sin = wall.robots.heading[0, 2].tolist()
        # The heading turns by less than 0.03 rad in the tick since the command.
        assert (cos * forward - sin * left, sin * forward + cos * left) == pytest.approx(
            (0.0, 0.5), abs=0.02
        )
    assert abs(wall.robots.heading[0, 2, 0] - 1.0) > 0.2, "the robot has turned"
    assert (wall.server.session.commands[2, 3:] > 0).any()
    message.robot_commands[0].move_command.SetInParent()
    message.robot_commands[0].move_command.ClearField("global_velocity")
    answer = wall.team(message.SerializeToString())
    assert [error.code for error in answer.errors] == ["UNSUPPORTED_MOVE"]
    wall.team(local_velocity([2], 0.25))
    wall.tick()
    assert wall.server.session.commands[2, :2].tolist() == [0.25, 0.0]


@pytest.mark.parametrize("data", [b"", kick_command(0, dribbler_speed=100.0)])
def test_a_new_client_inherits_nothing_while_the_match_stands_still(data: bytes) -> None:
    wall = Wall(client_timeout=1.0, speed=0.0)
    wall.team(local_velocity([0, 1]))
    wall.now += 1.1
    assert not wall.team(data, address=OTHER).errors
    team = wall.server.session.teams[0]
    assert not team.commands[:, :3].any()
    assert wall.server.session.counts["blue: left"] == 1
    assert [e.code for e in wall.team(local_velocity([0])).errors] == ["TEAM_TAKEN"]
    assert team.refused == 1


def test_bytes_that_are_no_message_take_no_team() -> None:
    wall = Wall()
    wall.team(b"\xff" * 20, address=OTHER)
    assert wall.server.session.teams[0].address is None
    assert not wall.team(local_velocity([0])).errors


@pytest.mark.parametrize("delay", [0.0, 0.045, 0.1])
def test_a_command_is_seen_after_the_configured_delay(delay: float) -> None:
    wall = Wall(sensing=Sensing(delay=delay, command_delay=0.02) if delay else Sensing(delay=1e-6))
    expected = delay + (0.02 if delay else 0.0)
    wall.tick(40)
    wall.team(local_velocity([0], 2.0))
    sent_at = wall.seconds
    rest = None
    for _ in range(60):
        for each in wall.tick():
            if each.port != "vision":
                continue
            frame = vision_pb2.Packet.FromString(each.data).detection
            x = next(robot.x for robot in frame.robots_blue if robot.robot_id == 0)
            rest = x if rest is None else rest
            if abs(x - rest) > 0.01:
                # The motion of the tick after the command is what the first frame can show.
                assert wall.seconds - sent_at == pytest.approx(expected + TICK, abs=1.01 * TICK)
                return
        wall.team(local_velocity([0], 2.0))
    pytest.fail("the command was never seen")


def test_clocks_that_jump_race_nothing_and_free_silent_teams() -> None:
    wall = Wall()
    wall.team(local_velocity([0]))
    wall.tick(10)
    before = wall.seconds
    wall.now += 3600.0
    wall.tick()
    assert wall.seconds - before <= 2 * TICK
    assert wall.server.session.clock is not None
    assert wall.server.session.clock.skipped > 3590
    assert wall.server.session.teams[0].address is None
    wall.now -= 7200.0
    before = wall.seconds
    wall.tick(10)
    assert wall.seconds - before == pytest.approx(9 * TICK, abs=2 * TICK)
    assert not wall.team(local_velocity([0]), address=OTHER).errors


def test_a_policy_plays_until_a_client_comes() -> None:
    wall = Wall(yellow="strike", blue="strike", options={"referee": {"prepare_seconds": 0.0}})
    wall.tick(600)
    assert np.linalg.norm(wall.robots.velocity[0], axis=1).max() > 0.1
    for _ in range(60):
        wall.team(local_velocity(range(6), 0.0), "yellow", YELLOW)
        wall.tick(2)
    assert not wall.server.session.commands[6:].any()
    wall.tick(300)
    assert wall.server.session.commands[6:].any(), "the policy plays on"


def test_policies_play_from_a_forecast_and_ports_tell_what_is_seen() -> None:
    late = Sensing(frame_rate=60.0, delay=0.05, command_delay=0.05)
    walls = [Wall(sensing=late, blue=policy, yellow="zero") for policy in ("scripted", "zero")]
    for wall in walls:
        while not wall.server.session.arena.play.game.in_play[0]:
            wall.tick(10)
    arena = walls[0].server.session.arena
    ahead = []
    for _ in range(40):
        walls[0].tick(5)
        arena.sense_for_policies()
        known = arena.play.known_to(0).blue.position - arena.sense().blue.position
        ahead.append(float(np.linalg.norm(known[0], axis=1).max()))
        assert same(arena.play.known_to(1).rows, arena.sense().rows), "yellow has no such policy"
    assert max(ahead) > 0.03, "a robot moves in 0.1 s"


def test_forecasts_of_policies_change_nothing_that_is_seen() -> None:
    task, noisy = make_match("ssl", "B", None, {}), Sensing("rc2021")
    arenas = [Arena(task, noisy, 1, forecasting=teams) for teams in ((), ("blue",))]
    commands = np.full((task.config.n_robots, 6), 0.3, np.float32)
    for tick in range(40):
        for arena in arenas:
            arena.step(commands)
            if tick % 5 == 0:
                arena.sense_for_policies()
        first, second = arenas
        assert same(first.sense().rows, second.sense().rows)
        assert len(first.camera_frames) == len(second.camera_frames)
        for seen, other in zip(first.camera_frames, second.camera_frames, strict=True):
            assert same(seen.balls, other.balls) and same(seen.robots, other.robots)
    assert not same(second.play.known_to(0).rows, first.play.known_to(0).rows)


@pytest.mark.parametrize("speed", [None, 1.0])
def test_vision_is_sent_before_the_tracker_is_asked(
    monkeypatch: pytest.MonkeyPatch, speed: float | None
) -> None:
    wall, other = Wall(speed=speed), Wall(speed=speed)
    for each in (wall, other):
        each.team(local_velocity([0]))
        each.team(local_velocity([0]), "yellow", YELLOW)
        each.now += 0.02
    expected = other.server.advance(other.now)
    calls = []
    of = TrackerPackets.of

    def noted(*args: Any) -> bytes:  # noqa: ANN401
        calls.append(args)
        return of(*args)

    monkeypatch.setattr(TrackerPackets, "of", noted)
    sent, known = [], []
    for datagram in wall.server.play(wall.now):
        sent.append(datagram)
        known.append((datagram.port, len(calls)))
    assert sent == expected
    assert [entry for entry in known if entry[0] != "referee"] == [("vision", 0), ("tracker", 1)]


def test_as_fast_as_clients_answer() -> None:
    wall = Wall(speed=None)
    assert [each.port for each in wall.sent].count("vision") == 1
    first = wall.seconds
    for _ in range(5):
        assert wall.server.advance(wall.now) == []
    wall.now += 2 * RESEND_SECONDS
    again = wall.server.advance(wall.now)
    assert [each.port for each in again] == ["vision", "tracker"]
    wall.team(local_velocity([0]))
    assert wall.server.advance(wall.now) == [], "yellow has not come yet"
    assert wall.seconds == first
    wall.team(local_velocity([0]), "yellow", YELLOW)
    assert wall.server.advance(wall.now), "the first frame is answered"
    wall.team(local_velocity([0]))
    wall.team(local_velocity([0]), "yellow", YELLOW)
    assert wall.server.advance(wall.now) == [], "these are the answers to its copy"
    first, frames = wall.seconds, 0
    for _ in range(60):
        wall.team(local_velocity([0]))
        wall.team(local_velocity([0]), "yellow", YELLOW)
        sent = wall.server.advance(wall.now)
        frames += [each.port for each in sent].count("vision")
    assert frames == 60
    assert wall.seconds - first == pytest.approx(1.0, abs=0.02)
    wall.team(local_velocity([0]))
    assert wall.server.advance(wall.now) == [], "a step waits for both"
    wall.now += 0.9
    wall.team(local_velocity([0]))
    wall.now += 0.2
    assert wall.server.advance(wall.now), "play goes on without the silent one"
    assert wall.server.session.counts["yellow: left"] == 1
    assert wall.server.session.counts["blue: left"] == 0
    message = simulation_pb2.Command()
    message.control.simulation_speed = 2.0
    assert wall.control(message) == ["UNSUPPORTED_SPEED"]


def test_the_same_messages_give_the_same_match() -> None:
    def play() -> tuple[bytes, bytes]:
        wall = Wall(sensing=Sensing("realistic"), yellow="strike", seed=3)
        for _ in range(100):
            wall.team(local_velocity(range(6), 1.0, 0.2, 0.5))
            wall.tick(2)
        reported = b"".join(each.data for each in wall.sent)
        return reported, wall.server.session.arena.frame.rows.tobytes()

    first = play()
    assert first == play()
    assert len(first[0]) > 10_000


def referee_packet(command: int = referee_pb2.DIRECT_FREE_BLUE) -> referee_pb2.Packet:
    packet = referee_pb2.Packet(
        packet_timestamp=1,
        stage=referee_pb2.NORMAL_FIRST_HALF,
        command=command,  # type: ignore[arg-type]
        command_counter=1,
        command_timestamp=1,
    )
    for team in (packet.blue, packet.yellow):
        team.name, team.score, team.red_cards = "x", 2, 0
        team.yellow_cards = team.timeouts = team.timeout_time = team.goalkeeper = 0
    return packet


@pytest.mark.parametrize("side", [False, True])
@pytest.mark.parametrize("reported", [None, False, True])
def test_places_of_an_external_referee_are_on_the_side_of_vision(
    side: bool, reported: bool | None
) -> None:
    wall = Wall(referee="external", blue_on_positive_half=side)
    packet = referee_packet(referee_pb2.BALL_PLACEMENT_BLUE)
    packet.designated_position.x, packet.designated_position.y = 1000.0, -500.0
    if reported is not None:
        packet.blue_team_on_positive_half = reported
    wall.send("referee", packet.SerializeToString())
    game = wall.server.session.arena.play.game
    sign = -1.0 if side else 1.0
    np.testing.assert_allclose(game.designated_position[0], [sign, -0.5 * sign], rtol=1e-6)
    differs = reported is not None and reported != side
    assert wall.server.session.counts["referee: blue on the other half"] == differs


def test_an_external_referee_is_obeyed() -> None:
    wall = Wall(referee="external")
    assert "referee" in wall.server.inputs
    packet = referee_packet()
    assert wall.send("referee", packet.SerializeToString()) == []
    game = wall.server.session.arena.play.game
    assert (game.command[0], game.stage[0], game.score[0].tolist()) == (9, 1, [2, 2])
    assert game.may_touch[0].tolist() == [True] * 6 + [False] * 6
    assert not [each for each in wall.tick(50) if each.port == "referee"]
    assert wall.send("referee", b"\xff\xff") == []
    assert wall.server.session.counts["referee: unreadable"] == 1


def test_robots_of_policies_stand_when_an_external_referee_halts() -> None:
    wall = Wall(referee="external", blue="strike")
    wall.send("referee", referee_packet(referee_pb2.FORCE_START).SerializeToString())
    wall.tick(150)
    assert np.linalg.norm(wall.robots.velocity[0], axis=1).max() > 0.3
    wall.send("referee", referee_packet(referee_pb2.HALT).SerializeToString())
    wall.tick(200)
    assert np.linalg.norm(wall.robots.velocity[0], axis=1).max() < 0.01
    wall.send("referee", referee_packet(referee_pb2.FORCE_START).SerializeToString())
    wall.tick(150)
    assert np.linalg.norm(wall.robots.velocity[0], axis=1).max() > 0.3


def test_robots_of_policies_keep_away_when_an_external_referee_stops_play() -> None:
    """`strike` knows no referee."""
    wall = Wall(referee="external", blue="strike")
    wall.send("referee", referee_packet(referee_pb2.FORCE_START).SerializeToString())
    ball = wall.server.session.arena.frame.ball

    def distance() -> float:
        offsets = wall.robots.position[0, :6] - ball.position[0]
        return float(np.linalg.norm(offsets, axis=1).min())

    for _ in range(600):
        wall.tick()
        if distance() < 0.2:
            break
    assert distance() < 0.2, "one is about to kick"
    wall.send("referee", referee_packet(referee_pb2.STOP).SerializeToString())
    wall.tick(400)
    assert distance() > 0.5
    assert np.linalg.norm(ball.velocity[0]) < 0.1, "nobody has kicked it"


@pytest.mark.parametrize("division", ["A", "B"])
def test_a_kick_of_an_external_referee_is_in_play_after_its_time(division: str) -> None:
    wall = Wall(referee="external", division=division)
    game = wall.server.session.arena.play.game
    half = len(game.may_touch[0]) // 2
    for command in (referee_pb2.STOP, referee_pb2.DIRECT_FREE_BLUE):
        wall.send("referee", referee_packet(command).SerializeToString())
        wall.tick(10)
        assert game.command_steps[0] == 10
    seconds = {"A": 5.0, "B": 10.0}[division]
    while game.command_steps[0] < round(seconds / TICK) - 1:
        wall.tick()
    wall.send("referee", referee_packet().SerializeToString())
    assert (game.in_play[0], game.may_touch[0].sum()) == (0.0, half)
    wall.tick(2)
    assert (game.in_play[0], game.may_touch[0].sum()) == (1.0, 2 * half)
    wall.send("referee", referee_packet(referee_pb2.STOP).SerializeToString())
    assert (game.in_play[0], game.may_touch[0].sum(), game.command_steps[0]) == (0.0, 0, 0)


def test_a_kick_off_of_an_external_referee_is_one_team_s_until_the_ball_has_moved() -> None:
    wall = Wall(referee="external")
    arena = wall.server.session.arena
    game = arena.play.game
    commands = (referee_pb2.PREPARE_KICKOFF_YELLOW, referee_pb2.NORMAL_START)
    for command, allowed in zip(commands, (0, 6), strict=True):
        wall.send("referee", referee_packet(command).SerializeToString())
        wall.tick(10)
        assert (game.in_play[0], game.may_touch[0].sum()) == (0.0, allowed)
    assert game.may_touch[0].tolist() == [False] * 6 + [True] * 6
    assert game["referee"][0, GAME_COLUMNS.index("kick")] == 4
    message = simulation_pb2.Command()
    message.control.teleport_ball.vx = 1.0
    assert wall.control(message) == []
    wall.tick(5)
    assert game.in_play[0] == 0.0, "the ball has moved by less than 0.05 m"
    wall.tick(10)
    assert (game.in_play[0], game.may_touch[0].all()) == (1.0, True)


@pytest.mark.parametrize("name", ["forecast", "own_cameras"])
def test_a_served_match_refuses_what_its_one_vision_cannot_tell(name: str) -> None:
    with pytest.raises(ValueError, match=rf"sensing\.{name}: expected 0"):
        Arena(make_match("ssl", "B", None, {}), Sensing("rc2021", **{name: 1}))


@pytest.mark.parametrize(("league", "policy"), [("ssl", "strike"), ("vsss", "best")])
def test_policies_play_a_match_without_a_referee(league: str, policy: str) -> None:
    wall = Wall(league=league, referee="off", blue=policy, yellow=policy)
    arena = wall.server.session.arena
    wall.tick(600)
    assert np.hypot(*arena.frame.ball.position[0]) > 0.05, "nobody plays the ball"
    assert arena.play.game.command[0] == Command.FORCE_START
    assert arena.play.game.may_touch.all()


@pytest.mark.parametrize(
    ("league", "options", "words"),
    [
        ("ssl", {"n_blue": 3}, r"options: expected `robots` for .*, got 'n_blue'"),
        ("ssl", {"division": "A"}, r"options: expected the argument `division`"),
        ("vsss", {"n_yellow": 3}, r"options: expected `robots` for .*, got 'n_yellow'"),
        ("vsss", {"field": "vss_5v5"}, r"options: expected `robots`, by which the field follows"),
    ],
)
def test_options_that_the_server_sets_are_refused(
    league: str, options: dict[str, object], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        Settings(league=league, options=options)
