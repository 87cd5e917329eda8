"""Matches on a network: our own server at the other end."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, Sensing, SimConfig, plugins
from rsoccer._core import Threads
from rsoccer.arrays import Floats
from rsoccer.drive import (
    Network,
    NetworkSimulator,
    NetworkStepper,
    Settings,
    UntouchedNetwork,
    forecasting,
)
from rsoccer.drive.connection import Connection
from rsoccer.drive.link import Received
from rsoccer.drive.network import CAMERA_NUMBERS
from rsoccer.drive.simulator import SETTLED
from rsoccer.evaluate import evaluate
from rsoccer.frame import Frame
from rsoccer.lineup import lineup
from rsoccer.protocols.schemas import simulation_pb2, tracker_pb2, vision_pb2
from rsoccer.registry import make_task
from rsoccer.simulator_interface import Stepper
from rsoccer.sources import NETWORK_SIMULATORS
from tests.drive.wires import ServerLink, connected

GO_TO_BALL = "SSLGoToBall-v0"


def matches_of(
    task: str,
    link: ServerLink,
    peer: str,
    kind: type[NetworkStepper] = NetworkSimulator,
    delay: float = 0.0,
    **settings: Any,  # noqa: ANN401
) -> Matches:
    made = make_task(task)

    def simulator(config: SimConfig, worlds: int, threads: Threads) -> Stepper:
        return kind(connected(config, link, peer, **settings))

    opponent = "zero" if made.config.n_yellow else None
    return Matches(
        made,
        controllers=lineup(made, "best", opponent),
        simulator=simulator,
        sensing=forecasting(delay),
    )


def played(matches: Matches, steps: int) -> list[dict[str, float]]:
    """Metrics of the episodes that end in some steps."""
    matches.reset(seed=0)
    actions = np.zeros((1, 0, matches.action_size), np.float32)
    found = []
    for _ in range(steps):
        outcome = matches.step(actions)
        if outcome.episodes is not None:
            metrics = outcome.episodes.metrics
            found.append({name: float(values[0]) for name, values in metrics.items()})
    matches.close()
    return found


@pytest.mark.parametrize(
    ("peer", "settings"),
    [
        ("ssl-simulation", {}),
        ("ssl-simulation", {"team": "yellow"}),
        ("ssl-simulation", {"source": "tracker", "ids": (4,)}),
        ("grsim", {}),
    ],
)
def test_the_ball_is_reached(peer: str, settings: dict[str, Any]) -> None:
    link = ServerLink(referee="off")
    found = played(matches_of(GO_TO_BALL, link, peer, **settings), 110)
    assert len(found) >= 2
    assert all(metrics["reached"] == 1.0 for metrics in found)
    assert link.is_closed


def test_the_ball_is_reached_through_noise_and_delay() -> None:
    link = ServerLink(referee="off", sensing=Sensing("rc2021"))
    found = played(matches_of(GO_TO_BALL, link, "ssl-simulation", delay=0.06), 110)
    assert [metrics["reached"] for metrics in found[:2]] == [1.0, 1.0]


def test_the_ball_is_reached_in_a_simulator_that_waits() -> None:
    link = ServerLink(referee="off", speed=None, yellow="zero")
    found = played(matches_of(GO_TO_BALL, link, "ssl-simulation", is_synchronous=True), 110)
    assert [metrics["reached"] for metrics in found[:2]] == [1.0, 1.0]
    assert link.server.session.counts["frames: sent again"] == 0


def test_a_goal_is_scored_in_vsss() -> None:
    link = ServerLink(league="vsss", referee="off")
    found = played(matches_of("VSSSelfPlay-v0", link, "firasim", drives=(0, 1)), 600)
    assert found
    assert found[0]["goal_score"] == 1.0


def test_bodies_are_where_a_task_wants_them_and_others_are_gone() -> None:
    link = ServerLink(referee="off")
    matches = matches_of(GO_TO_BALL, link, "ssl-simulation")
    here = Matches(GO_TO_BALL)
    here.reset(seed=3)
    matches.reset(seed=3)
    wanted, true = here.frame, link.frame
    np.testing.assert_allclose(true.robots.position[0, 0], wanted.robots.position[0, 0], atol=0.01)
    assert true.robots.absent[0].tolist() == [0.0] + [1.0] * 11
    np.testing.assert_allclose(
        matches.frame.robots.position[0, 0], true.robots.position[0, 0], atol=0.01
    )
    assert matches.play.times is not None


@pytest.mark.parametrize("referee", ["own", "off"])
def test_a_referee_that_has_a_part_is_named_once(
    referee: str, caplog: pytest.LogCaptureFixture
) -> None:
    link = ServerLink(referee=referee)
    matches = matches_of(GO_TO_BALL, link, "ssl-simulation")
    for seed in range(3):
        matches.reset(seed=seed)
    found = [record for record in caplog.records if record.message.startswith("referee: ")]
    assert len(found) == (1 if referee == "own" else 0)


def test_robots_rest_before_they_are_put_somewhere() -> None:
    link = ServerLink(referee="off")
    config = SimConfig("ssl_b", 1, 0)
    connection = connected(config, link, "ssl-simulation")
    stepper = NetworkSimulator(connection)
    begin = Frame.empty(1, 1, 0)
    begin.ball.position[0] = (0.0, 2.0)
    rows, out = begin.rows, begin.rows.copy()
    stepper.place(np.ones(1, np.bool_), rows, out)
    commands = np.zeros((1, 1, len(config.command_columns)), np.float32)
    commands[..., 0] = 2.0
    for _ in range(40):
        stepper.step(commands, out)
    assert np.hypot(*link.frame.robots.velocity[0, 0]) > 1.5
    speeds: list[float] = []
    put = connection.put

    def noted(messages: Any) -> None:  # noqa: ANN401
        speeds.append(float(np.hypot(*link.frame.robots.velocity[0, 0])))
        put(messages)

    connection.put = noted  # type: ignore[method-assign]
    stepper.place(np.ones(1, np.bool_), rows, out)
    assert speeds
    assert max(speeds) < 2 * SETTLED


def test_contact_that_a_robot_reports_adds_to_its_break_beam() -> None:
    link = ServerLink(referee="off")
    config = SimConfig("ssl_b", 1, 0)
    connection = connected(config, link, "ssl-simulation")
    stepper = NetworkSimulator(connection)
    rows = Frame.empty(1, 1, 0)
    model = config.robots[0]
    beam = model.front_distance + config.ball.radius + 0.5 * 0.01  # in the beam, without contact
    for reported in (False, True):
        for distance, seen in ((1.0, False), (beam, True)):
            rows.ball.position[0] = (distance, 0.0)
            out = rows.rows.copy()
            no_report = np.array([True]), np.array([reported])
            connection.contact = lambda report=no_report: report  # type: ignore[misc]
            stepper.place(np.ones(1, np.bool_), rows.rows, out)
            found = bool(Frame(out, 1, 0).robots.infrared[0, 0])
            assert found is (reported or seen), (reported, distance)


class BlindLink(ServerLink):
    """A link to a server whose cameras never see the ball."""

    def tick(self) -> None:
        before = len(self._waiting)
        super().tick()
        for index, received in enumerate(self._waiting[before:], before):
            if received.port == "vision":
                packet = vision_pb2.Packet.FromString(received.data)
                del packet.detection.balls[:]
                self._waiting[index] = Received("vision", packet.SerializeToString())
            elif received.port == "tracker":
                tracked = tracker_pb2.Packet.FromString(received.data)
                del tracked.tracked_frame.balls[:]
                self._waiting[index] = Received("tracker", tracked.SerializeToString())


@pytest.mark.parametrize("source", ["vision", "tracker"])
def test_a_ball_that_a_robot_hides_is_where_it_was_put(source: str) -> None:
    config = SimConfig("ssl_b", 1, 0)
    link = BlindLink(referee="off")
    connection = connected(config, link, "ssl-simulation", patience=3.0, source=source)
    stepper = NetworkSimulator(connection)
    wanted = Frame.empty(1, 1, 0)
    model = config.robots[0]
    wanted.robots.heading[0, 0] = (1.0, 0.0)
    wanted.ball.position[0] = (model.front_distance + config.ball.radius + 0.001, 0.0)
    out = wanted.rows.copy()
    stepper.place(np.ones(1, np.bool_), wanted.rows, out)
    found = Frame(out, 1, 0)
    np.testing.assert_allclose(found.ball.position[0], wanted.ball.position[0], atol=0.01)
    commands = np.zeros((1, 1, len(config.command_columns)), np.float32)
    commands[0, 0, [0, -1]] = 0.4, 1.0  # forward, with the dribbler
    for _ in range(60):
        stepper.step(commands, out)
    assert link.frame.ball.position[0, 0] > 0.4
    if source == "vision":  # a tracker on the network follows a hidden ball itself
        np.testing.assert_allclose(found.ball.position, link.frame.ball.position, atol=0.03)


def test_a_ball_away_from_robots_has_to_be_seen() -> None:
    config = SimConfig("ssl_b", 1, 0)
    connection = connected(config, BlindLink(referee="off"), "ssl-simulation", patience=3.0)
    wanted = Frame.empty(1, 1, 0)
    wanted.ball.position[0] = (1.0, 0.5)
    with pytest.raises(ConnectionError, match="without the ball"):
        NetworkSimulator(connection).place(
            np.ones(1, np.bool_), wanted.rows, np.empty_like(wanted.rows)
        )


def test_untouched_robots_stay() -> None:
    link = ServerLink(referee="off")
    before = link.frame.robots.position[0].copy()
    matches_of(GO_TO_BALL, link, "ssl-simulation", UntouchedNetwork).reset()
    np.testing.assert_allclose(link.frame.robots.position[0], before, atol=0.01)
    stepper = matches_of(GO_TO_BALL, ServerLink(referee="off"), "ssl-simulation", NetworkStepper)
    stepper.reset()
    with pytest.raises(ValueError, match="cannot place bodies"):
        stepper.reset(rows=np.zeros((1, stepper.task.config.row_size), np.float32))


def test_play_goes_on_without_a_robot_that_was_taken_off() -> None:
    link = ServerLink(referee="off")
    config = SimConfig("ssl_b", 2, 0)
    stepper = UntouchedNetwork(connected(config, link, "ssl-simulation", patience=3.0))
    world, rows = np.ones(1, np.bool_), np.zeros((1, config.row_size), np.float32)
    out, commands = rows.copy(), np.zeros((1, 2, len(config.command_columns)), np.float32)
    stepper.place(world, rows, out)
    assert not Frame(out, 2, 0).robots.absent.any()
    command = simulation_pb2.Command()
    robot = command.control.teleport_robot.add(present=False)
    robot.id.id, robot.id.team = 1, simulation_pb2.BLUE
    link.server.receive("control", command.SerializeToString(), ("127.0.0.1", 5109), link.now)
    for _ in range(40):
        stepper.step(commands, out)
    calls: tuple[Callable[[], object], ...] = (
        lambda: stepper.place(world, rows, out),
        lambda: stepper.restart(world, rows, out),
        lambda: stepper.reposition_balls(world, rows[:, :5], out),
    )
    for call in calls:
        out[:] = np.nan
        call()
        assert Frame(out, 2, 0).robots.absent[0].tolist() == [0.0, 1.0]
    # A match that begins needs it.
    with pytest.raises(ConnectionError, match=r"expected all in sight .* without blue 1$"):
        UntouchedNetwork(stepper.connection).place(world, rows, out)


def test_what_cannot_be_changed_is_refused() -> None:
    link = ServerLink(referee="off")
    stepper = NetworkSimulator(connected(SimConfig("ssl_b", 1, 0), link, "ssl-simulation"))
    row = np.zeros((1, stepper.connection.config.row_size), np.float32)
    with pytest.raises(ValueError, match="randomization: expected no factors"):
        stepper.place(np.ones(1, np.bool_), row, row, np.ones((1, 3), np.float32))
    with pytest.raises(ValueError, match="randomization: expected no numbers"):
        stepper.begin_senses(np.ones(1, np.bool_), np.zeros(1, np.uint64), row)


def test_one_match_at_a_time() -> None:
    with pytest.raises(ValueError, match="worlds: expected 1 with a simulator on a network, got 2"):
        Matches(GO_TO_BALL, 2, simulator="grsim")


def test_a_network_is_copied_without_its_connection() -> None:
    network = Network(Settings("grsim"), UntouchedNetwork, (0,))
    copy = pickle.loads(pickle.dumps(network))
    assert (copy.settings, copy.kind, copy.drives) == (network.settings, UntouchedNetwork, (0,))
    network.close()


def driven_ahead(sensing: Sensing | None) -> tuple[UntouchedNetwork, Floats, Floats]:
    """A robot on a network after a second of 1 m/s: its stepper, its state and what blue knows."""
    config = SimConfig("ssl_b", 1, 0).with_sensing(sensing)
    stepper = UntouchedNetwork(connected(config, ServerLink(referee="off"), "ssl-simulation"))
    out, known = np.empty((2, 1, config.row_size), np.float32)
    stepper.read(out)
    commands = np.zeros((1, 1, len(config.command_columns)), np.float32)
    commands[..., 0] = 1.0
    for _ in range(40):
        stepper.step(commands, out)
    stepper.sense(known, None, "blue")
    return stepper, out, known


def test_the_forecast_is_the_state_after_the_delay() -> None:
    stepper, out, known = driven_ahead(forecasting(0.1))
    assert known[0, 17] - out[0, 17] == pytest.approx(0.1, abs=0.02)
    stepper.sense(known, None, None)
    np.testing.assert_array_equal(known, out)
    assert forecasting(0.0) is None


def test_cameras_have_the_noise_of_a_preset() -> None:
    made = forecasting(0.1, "rc2021")
    assert made is not None
    assert made == Sensing(
        command_delay=0.1,
        forecast=1,
        **{name: getattr(Sensing("rc2021"), name) for name in CAMERA_NUMBERS},
    )
    assert forecasting(0.0, Sensing("rc2021", frame_loss=0.5)) == forecasting(0.0, "rc2021")
    with pytest.raises(ValueError, match=r"^cameras: .*rc2031"):
        forecasting(0.0, "rc2031")
    with pytest.raises(TypeError, match="cameras: expected a Sensing"):
        forecasting(0.0, 3.0)  # type: ignore[arg-type]


def test_robots_that_are_sent_equal_commands_are_forecast_to_go_on() -> None:
    sensing = Sensing(command_delay=0.1, command_timeout=0.15, forecast=1)
    *_, known = driven_ahead(sensing)
    assert Frame(known, 1, 0).robots.velocity[0, 0, 0] == pytest.approx(1.0, abs=0.02)


def test_a_team_knows_the_commands_of_its_own_robots_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    config = SimConfig("ssl_b", 2, 1).with_sensing(forecasting(0.1))
    wires = connected(config, ServerLink(referee="off"), "ssl-simulation", drives=(0, 1))
    stepper, sight, asked = UntouchedNetwork(wires), wires.sight, list[object]()
    read = sight.read

    def asking(out: Floats, robots: Sequence[int] | None = None) -> None:
        asked.append(robots)
        read(out, robots)

    out = np.empty((1, config.row_size), np.float32)
    stepper.read(out)
    commands = np.zeros((1, 3, len(config.command_columns)), np.float32)
    commands[..., 0] = 1.0
    for _ in range(20):
        stepper.step(commands, out)
    monkeypatch.setattr(sight, "read", asking)
    knowing = [np.empty_like(out) for _ in range(2)]
    for known, team in zip(knowing, ("blue", "yellow"), strict=True):
        stepper.sense(known, None, team)
    assert asked == [range(2), range(2, 3)]
    for known in knowing:
        robots = Frame(known, 2, 1).robots
        np.testing.assert_allclose(np.linalg.norm(robots.velocity[0], axis=-1), 1.0, atol=0.05)


def test_a_policy_is_evaluated_there() -> None:
    link = ServerLink(referee="off")
    made: list[Connection] = []

    def simulator(config: SimConfig, worlds: int, threads: Threads) -> NetworkSimulator:
        if not made:
            made.append(connected(config, link, "ssl-simulation", drives=(0, 1)))
        return NetworkSimulator(made[0], is_owner=False)

    found = evaluate(
        "best", matches=2, task=make_task(GO_TO_BALL), worlds=1, threads=1, simulator=simulator
    )
    assert found.score == 1.0
    assert not link.is_closed
    last = simulation_pb2.RobotControl.FromString(link.messages[-1].data)
    assert not any(each.move_command.local_velocity.forward for each in last.robot_commands)


@pytest.mark.parametrize("name", sorted(NETWORK_SIMULATORS))
def test_peers_have_names(name: str) -> None:
    found = plugins.find("simulator", NETWORK_SIMULATORS[name])
    assert isinstance(found, Network)
    assert found.settings == Settings(name)
    assert isinstance(pickle.loads(pickle.dumps(found)), Network)
