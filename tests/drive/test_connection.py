"""Robots that stop when anything fails, and get no command that is not allowed."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer.bridge.match_tasks import TICK
from rsoccer.drive.connection import MAX_LATE_STEPS, Connection
from rsoccer.drive.link import Received
from rsoccer.drive.peers import Message
from rsoccer.drive.settings import Settings
from rsoccer.game import Command, Stage
from rsoccer.protocols import referee
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.limits import Limits
from rsoccer.protocols.referee import RefereeStatus
from rsoccer.protocols.schemas import simulation_pb2, vision_pb2
from tests.drive.wires import CLIENT, ServerLink, connected

CONFIG = SimConfig("ssl_b", 6, 6)
ONE = SimConfig("ssl_b", 1, 0)
OTHER = ("127.0.0.1", 5109)
FORWARD = np.zeros((12, len(CONFIG.command_columns)), np.float32)
FORWARD[:6, 0] = 1.0


def advance(connection: Connection, seconds: float, commands: np.ndarray = FORWARD) -> None:
    commands = commands[: connection.config.n_robots]
    connection.advance(commands, connection.sight.clock.now + seconds)


def driving() -> tuple[Connection, ServerLink, list[str]]:
    """Return a connection whose robots have driven for a while, its link and its events to come."""
    link = ServerLink(referee="off")
    events: list[str] = []
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.on_event.append(events.append)
    connection.begin()
    advance(connection, 0.3)
    return connection, link, events


def speeds(messages: list[Message]) -> list[float]:
    """Greatest speed in each message to a team."""
    found = []
    for message in messages:
        if message.port in ("blue", "yellow"):
            control = simulation_pb2.RobotControl.FromString(message.data)
            locals_ = [each.move_command.local_velocity for each in control.robot_commands]
            found.append(max(float(np.hypot(each.forward, each.left)) for each in locals_))
    return found


def wait(link: ServerLink, seconds: float) -> None:
    """Let time pass in which nobody looks; what comes in then waits, and is read in batches."""
    for _ in range(round(seconds / TICK)):
        link.tick()
    waiting, real_poll = link.poll(0.0), link.poll
    assert waiting

    def poll(seconds: float) -> list[Received]:
        if waiting:
            batch = waiting[:64]
            del waiting[:64]
            return batch
        return real_poll(seconds)

    link.poll = poll  # type: ignore[method-assign]


def packet_of(command: Command, **numbers: object) -> bytes:
    """Return a packet of a game controller."""
    layout = WireLayout(CONFIG, **numbers)  # type: ignore[arg-type]
    status = RefereeStatus(command, Stage.NORMAL_FIRST_HALF)
    stamp = referee.Stamper().stamp(command, 1.0)
    data: bytes = referee.to_packet(layout, status, stamp).SerializeToString()
    return data


def test_robots_are_driven_and_stand_before_and_after() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.begin()
    assert set(speeds(link.messages)) == {0.0}
    start = link.frame.robots.position[0].copy()
    advance(connection, 0.5)
    moved = link.frame.robots.position[0, :, 0] - start[:, 0]
    assert moved[:6].min() > 0.2
    assert np.abs(moved[6:]).max() < 1e-3
    connection.close()
    connection.close()
    assert link.is_closed
    assert speeds(link.messages)[-5:] == [0.0] * 5


def test_robots_stop_without_vision_and_go_on_with_new_commands_alone() -> None:
    connection, link, events = driving()
    heard, link.heard = link.heard, set()
    sent = len(link.messages)

    real_poll, lost = link.poll, link.now

    def poll(seconds: float) -> list[Received]:
        if link.now > lost + 2.0:
            link.heard = heard
        return real_poll(seconds)

    link.poll = poll  # type: ignore[method-assign]
    advance(connection, 0.025)
    found = speeds(link.messages[sent:])
    stopped = found.index(0.0)
    # Fewer commands than fit into 0.2 s at 60 Hz keep them driving, and not one after that.
    assert stopped <= 16
    assert len(found) > stopped + 60
    assert set(found[stopped:]) == {0.0}
    assert link.now < lost + 2.2
    assert events == ["vision: lost, robots stop", "vision: back"]
    assert np.abs(link.frame.robots.velocity[0]).max() < 0.01
    advance(connection, 0.3)
    assert link.frame.robots.velocity[0, :6, 0].min() > 0.5
    assert connection.sight.clock.jumps == 1


def test_robots_near_the_ball_stand_without_vision_in_a_stop() -> None:
    """With vision they keep away from the ball; blind, they must not drive at all."""
    link = ServerLink(referee="off")
    connection = connected(ONE, link, "ssl-simulation", ids=(5,), patience=2.0)
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(x=0.3, y=0.0, orientation=0.0)
    robot.id.id, robot.id.team = 5, simulation_pb2.BLUE
    link.server.receive("control", command.SerializeToString(), OTHER, link.now)
    link.give("referee", packet_of(Command.STOP))
    connection.begin()
    stands = np.zeros((1, len(ONE.command_columns)), np.float32)
    connection.sight.read(connection.frame.rows)
    connection.advance(stands, connection.sight.clock.now + 0.025)
    assert speeds(link.messages)[-1] == pytest.approx(0.5), "it keeps away from the ball"
    link.heard = {"referee"}
    sent = len(link.messages)
    with pytest.raises(ConnectionError):
        connection.advance(stands, connection.sight.clock.now + 0.025)
    found = speeds(link.messages[sent:])
    assert set(found[found.index(0.0) :]) == {0.0}
    assert len(found) > 100
    connection.stop()
    assert speeds(link.messages)[-1] == 0.0


def test_robots_that_wait_for_the_others_stand() -> None:
    link = ServerLink(referee="off")
    show(link, 3, present=False)
    connection = connected(CONFIG, link, "ssl-simulation", patience=1.0)
    link.give("referee", packet_of(Command.STOP))
    with pytest.raises(ConnectionError, match="without blue 3"):
        connection.begin()
    assert len(link.messages) > 50
    assert set(speeds(link.messages)) == {0.0}


def test_a_program_that_was_late_goes_on_with_new_frames_alone() -> None:
    connection, link, events = driving()
    sent = len(link.messages)
    wait(link, 3.0)
    begun = link.now
    advance(connection, 0.025)
    assert set(speeds(link.messages[sent:])) == {0.0}, "the commands are old"
    assert connection.now == pytest.approx(link.now - 100.0, abs=0.05)
    assert link.now < begun + 0.1
    assert events == ["vision: this program was late, robots stop"]
    assert connection.counts["vision: late"] == 1
    advance(connection, 0.3)
    assert speeds(link.messages)[-1] == pytest.approx(1.0)


def test_an_episode_begins_with_new_frames_after_a_pause() -> None:
    connection, link, _ = driving()
    wait(link, 3.0)
    connection.begin()
    assert connection.sight.clock.now == pytest.approx(link.now - 100.0, abs=0.05)
    sent = len(link.messages)
    advance(connection, 0.1)
    found = speeds(link.messages[sent:])
    assert found
    assert min(found) == max(found) == pytest.approx(1.0)
    assert not connection.counts["vision: late"]


def test_a_program_that_is_always_late_ends_with_the_reason() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.begin()
    for _ in range(MAX_LATE_STEPS - 1):
        wait(link, 0.25)
        advance(connection, 0.025)
    advance(connection, 0.1)
    for _ in range(MAX_LATE_STEPS - 1):
        wait(link, 0.25)
        advance(connection, 0.025)
    wait(link, 0.25)
    with pytest.raises(RuntimeError, match=r"vision_timeout: expected commands within 0\.2 s"):
        advance(connection, 0.025)
    link = ServerLink(referee="off")
    patient = connected(CONFIG, link, "ssl-simulation", vision_timeout=1.0)
    patient.begin()
    for _ in range(MAX_LATE_STEPS):
        wait(link, 0.25)
        advance(patient, 0.025)
    assert not patient.counts["vision: late"]
    assert link.frame.robots.velocity[0, 0, 0] > 0.5


def test_robots_stop_when_the_frames_stand_still() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation", patience=1.0)
    connection.begin()
    advance(connection, 0.3)
    last = next(d for d in _frames(link))
    link.heard = set()
    real_poll = link.poll

    def poll(seconds: float) -> list[Received]:
        link.give("vision", last)
        link.tick()
        return real_poll(seconds)

    link.poll = poll  # type: ignore[method-assign]
    sent = len(link.messages)
    with pytest.raises(ConnectionError, match="expected a frame within 1 s"):
        advance(connection, 0.025)
    found = speeds(link.messages[sent:])
    assert len(found) > 60
    assert set(found[len(found) // 2 :]) == {0.0}


def _frames(link: ServerLink) -> Iterator[bytes]:
    """Yield the frames of vision to come."""
    while True:
        for received in link.poll(0.1):
            if received.port == "vision":
                yield received.data


def test_a_connection_gives_up_in_the_end() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation", patience=3.0)
    connection.begin()
    link.heard = set()
    link.give("vision", b"garbage")
    silent = r"within 3 s, got no newer frames at .*:10006 for 3\.\d s, 1 other datagrams \("
    with pytest.raises(ConnectionError, match="expected a frame " + silent):
        advance(connection, 0.025)
    assert speeds(link.messages)[-1] == 0.0


def test_what_is_missing_is_named() -> None:
    link = ServerLink(referee="off")
    connection = connected(ONE, link, "ssl-simulation", ids=(9,), patience=1.0)
    with pytest.raises(
        ConnectionError, match=r"blue \[0, 1, 2, 3, 4, 5\], yellow .* without blue 9$"
    ):
        connection.begin()
    link.heard = set()
    connection = connected(ONE, link, "ssl-simulation", patience=1.0)
    link.heard = set()
    with pytest.raises(ConnectionError, match=r"no frames at 224\.5\.23\.2:10006, nothing"):
        connection.begin()


def show(link: ServerLink, number: int, *, present: bool) -> None:
    """Take a robot of blue off the field, or put it back."""
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(present=present)
    robot.id.id, robot.id.team = number, simulation_pb2.BLUE
    robot.x, robot.y, robot.orientation = -1.0, 2.0, 0.0
    link.server.receive("control", command.SerializeToString(), OTHER, link.now)


@pytest.mark.parametrize("returns", [False, True])
def test_vision_that_starts_late_ends_no_wait(returns: bool) -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation", patience=4.0)
    heard, link.heard, start = link.heard, set(), link.now
    events: list[str] = []
    connection.on_event.append(events.append)
    show(link, 3, present=False)
    real_poll = link.poll

    def poll(seconds: float) -> list[Received]:
        if link.now > start + 1.0:
            link.heard = heard
        if returns and link.now > start + 2.0 and link.frame.robots.absent[0, 3]:
            show(link, 3, present=True)
        return real_poll(seconds)

    link.poll = poll  # type: ignore[method-assign]
    if returns:
        connection.begin()
        assert 2.0 < link.now - start < 2.5
        assert connection.sight.in_sight[3]
    else:
        with pytest.raises(ConnectionError, match=r"without blue 3$"):
            connection.begin()
    assert events == ["vision: lost, robots stop", "vision: back"]
    assert set(speeds(link.messages)) == {0.0}


@pytest.mark.parametrize(
    ("ids", "message"),
    [((1, 1), "ids: expected 2 different numbers"), ((1,), "ids: expected 2 different numbers")],
)
def test_wrong_numbers_are_named(ids: tuple[int, ...], message: str) -> None:
    link = ServerLink(referee="off")
    with pytest.raises(ValueError, match=message):
        connected(SimConfig("ssl_b", 2, 0), link, "ssl-simulation", ids=ids)
    assert not link.messages


@pytest.mark.parametrize(("peer", "field"), [("grsim", "vss_3v3"), ("firasim", "ssl_b")])
def test_robots_of_the_other_league_are_refused(peer: str, field: str) -> None:
    with pytest.raises(ValueError, match=f"task: expected robots .* with {peer}"):
        Connection(SimConfig(field, 1, 0), Settings(peer), link=ServerLink())


@pytest.mark.parametrize("drives", [(0,), (0, 1)])
def test_a_team_that_another_client_drives_is_refused_in_the_end(drives: tuple[int, ...]) -> None:
    link = ServerLink(referee="off")
    message = simulation_pb2.RobotControl()
    local = message.robot_commands.add(id=0).move_command.local_velocity
    local.forward = local.left = local.angular = 0.0
    data = message.SerializeToString()
    link.server.receive("blue", data, OTHER, link.now)
    connection = connected(CONFIG, link, "ssl-simulation", drives=drives)
    with pytest.raises(
        RuntimeError, match=r"blue: TEAM_TAKEN: team: blue is driven by 127\.0\.0\.1:5109"
    ):
        for _ in range(400):
            link.server.receive("blue", data, OTHER, link.now)
            advance(connection, 0.025)


def test_a_team_that_becomes_free_is_taken() -> None:
    link = ServerLink(referee="off")
    link.server.receive("blue", simulation_pb2.RobotControl().SerializeToString(), OTHER, link.now)
    connection = connected(CONFIG, link, "ssl-simulation")
    for _ in range(100):
        advance(connection, 0.025)
    assert connection.counts["blue: TEAM_TAKEN"] > 0
    assert link.server.session.teams[0].address == CLIENT
    assert link.frame.robots.velocity[0, 0, 0] > 0.5


def test_halt_stops_at_once_and_stop_is_slow() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    fast = FORWARD.copy()
    fast[:6, 0] = 3.0
    connection.begin()
    advance(connection, 0.1, fast)
    assert speeds(link.messages)[-1] == pytest.approx(3.0)
    link.give("referee", packet_of(Command.HALT))
    advance(connection, 0.1, fast)
    assert speeds(link.messages)[-1] == 0.0
    link.give("referee", packet_of(Command.STOP))
    advance(connection, 0.1, fast)
    assert 0.0 < speeds(link.messages)[-1] <= 1.5 + 1e-5
    link.give("referee", packet_of(Command.FORCE_START))
    advance(connection, 0.1, fast)
    assert speeds(link.messages)[-1] == pytest.approx(3.0)


@pytest.mark.parametrize(("division", "reported"), [("A", 1), ("B", 0)])
def test_another_field_is_reported_once_it_is_known(division: str, reported: int) -> None:
    link = ServerLink(referee="off", division=division)
    connection = connected(SimConfig("ssl_b", 1, 0), link, "ssl-simulation", ids=(5,))
    events: list[str] = []
    connection.on_event.append(events.append)
    for _ in range(20):
        link.tick()  # the first geometry is missed
    link.poll(0.0)
    connection.begin()
    assert not events
    for _ in range(30):
        connection.advance(np.zeros((1, 7), np.float32), connection.sight.clock.now + 0.1)
    assert events == reported * ["field: the task's is 9 x 6 m, that of vision 12 x 9 m"]


def test_a_required_referee_is_awaited() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation", referee="require")
    connection.begin()
    advance(connection, 0.2)
    assert set(speeds(link.messages)) == {0.0}
    link.give("referee", packet_of(Command.FORCE_START))
    advance(connection, 0.2)
    assert speeds(link.messages)[-1] == pytest.approx(1.0)


def test_a_referee_that_falls_silent_has_halted_the_match() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    link.give("referee", packet_of(Command.FORCE_START))
    connection.begin()
    advance(connection, 0.2)
    assert speeds(link.messages)[-1] == pytest.approx(1.0)
    for _ in range(16):
        advance(connection, 0.4)
    assert speeds(link.messages)[-1] == 0.0


def test_the_sides_follow_the_referee() -> None:
    link = ServerLink(referee="off", blue_on_positive_half=True)
    connection = connected(CONFIG, link, "ssl-simulation")
    link.give("referee", packet_of(Command.FORCE_START, blue_on_positive_half=True))
    connection.begin()
    row = np.empty((1, CONFIG.row_size), np.float32)
    connection.sight.read(row)
    np.testing.assert_allclose(row[0, :2], link.frame.rows[0, :2], atol=0.01)
    np.testing.assert_allclose(row[0, 17:21], link.frame.rows[0, 17:21], atol=0.01)
    assert connection.counts["sides changed"] == 1


def test_limits_hold() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation", limits=Limits(speed=0.25))
    connection.begin()
    advance(connection, 0.3)
    assert max(speeds(link.messages)) == pytest.approx(0.25)


@pytest.mark.parametrize(("peer", "pause"), [("grsim", 0.02), ("ssl-simulation", 0.0)])
def test_a_kick_that_lasts_is_sent_as_often_as_the_simulator_bears(peer: str, pause: float) -> None:
    link = ServerLink(referee="off")
    connection = connected(ONE, link, peer)
    connection.begin()
    kicks: list[tuple[float, bool]] = []
    connection.on_sent.append(lambda time, sent: kicks.append((time, bool(sent[0, 3] > 0.0))))
    advance(connection, 0.2, np.array([[0.0, 0.0, 0.0, 3.0, 0.0, 1.0]], np.float32))
    kicked = [time for time, is_kick in kicks if is_kick]
    assert len(kicked) > 4
    assert all(after - before >= pause for before, after in itertools.pairwise(kicked))
    assert (len(kicked) < len(kicks)) == (pause > 0.0)


def test_garbage_and_frames_of_others_change_nothing() -> None:
    rng = np.random.default_rng(1)
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.begin()
    packet = vision_pb2.Packet()
    detection = packet.detection
    detection.frame_number, detection.camera_id = 1, 0
    detection.t_sent = 5.0
    for wrong in (float("nan"), 1e300, 5.0):
        detection.t_capture = wrong
        link.give("vision", packet.SerializePartialToString())
    for port in ("vision", "referee", "blue", "control"):
        for size in rng.integers(0, 400, 200).tolist():
            link.give(port, rng.bytes(size))
    start = link.frame.robots.position[0, :6, 0].copy()
    advance(connection, 0.5)
    assert (link.frame.robots.position[0, :6, 0] - start).min() > 0.2
    assert connection.counts["vision: unreadable"] > 100
    assert connection.sight.clock.jumps == 0


def test_vision_whose_clock_jumps_is_followed() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.begin()
    for shift in (1e4, -2e4):
        link.server.session.epoch += shift
        link.server.ports._vision._epoch += shift  # type: ignore[union-attr]
        start, time = link.frame.robots.position[0, 0, 0], link.now
        advance(connection, 0.3)
        advance(connection, 0.3)
        assert link.frame.robots.position[0, 0, 0] - start > 0.2
        assert link.now - time < 0.8
    assert connection.sight.clock.jumps == 2


def test_a_robot_out_of_sight_stands() -> None:
    link = ServerLink(referee="off")
    connection = connected(CONFIG, link, "ssl-simulation")
    connection.begin()
    show(link, 3, present=False)
    advance(connection, 0.7)
    last = simulation_pb2.RobotControl.FromString(link.messages[-1].data)
    velocity = [each.move_command.local_velocity.forward for each in last.robot_commands]
    assert velocity == [1.0, 1.0, 1.0, 0.0, 1.0, 1.0]
