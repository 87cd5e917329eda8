"""A policy that drives a team of a match."""

from __future__ import annotations

import numpy as np
import pytest

from rsoccer.drive.session import Session
from rsoccer.drive.settings import Settings
from rsoccer.game import Command, Stage
from rsoccer.protocols import referee
from rsoccer.protocols.layout import WireLayout
from rsoccer.protocols.referee import RefereeStatus, TeamStatus
from rsoccer.registry import make_task
from tests.drive.wires import ServerLink

SMALL = {"n_blue": 2, "n_yellow": 2}


def session_of(
    link: ServerLink, task: str, peer: str, policy: str = "strike", **options: object
) -> Session:
    settings = Settings(peer, **options)  # type: ignore[arg-type]
    link.heard = set(settings.heard)
    numbers = SMALL if task == "SSLMatch-v0" else {}
    return Session(policy, make_task(task, **numbers), settings, link=link, clock=link.clock)


def packet_of(session: Session, command: Command, score: tuple[int, int] = (3, 1)) -> bytes:
    """Return a packet of a game controller."""
    teams = TeamStatus("Blue", score[0]), TeamStatus("Yellow", score[1])
    status = RefereeStatus(command, Stage.NORMAL_FIRST_HALF, teams)
    layout = WireLayout(session.connection.config)
    packet = referee.to_packet(layout, status, referee.Stamper().stamp(command, 1.0))
    data: bytes = packet.SerializeToString()
    return data


@pytest.mark.parametrize("team", ["blue", "yellow"])
def test_a_policy_of_matches_plays_by_the_commands_of_a_game_controller(team: str) -> None:
    link = ServerLink(robots=2, referee="off")
    session = session_of(link, "SSLMatch-v0", "ssl-simulation", team=team)
    game, own = session.matches.play.game, slice(0, 2) if team == "blue" else slice(2, 4)
    robots = link.frame.robots

    def play(command: Command, steps: int) -> None:
        link.give("referee", packet_of(session, command))
        for _ in range(steps):
            session.step()

    session.begin()
    play(Command[f"PREPARE_KICKOFF_{team.upper()}"], 30)
    assert game.command[0] == Command.PREPARE_KICKOFF_BLUE
    assert game.score[0].tolist() == ([3, 1] if team == "blue" else [1, 3])
    assert not game.may_touch[0].any()
    assert not link.frame.ball.position[0].any(), "nobody touches the ball"
    play(Command.NORMAL_START, 80)
    assert game.may_touch[0, 0]
    assert link.frame.ball.position[0].any(), "it takes its kick-off"
    assert game.in_play[0]
    play(Command.HALT, 30)
    speeds = np.linalg.norm(link.frame.robots.velocity[0, own], axis=1)
    assert speeds.max() < 0.01
    assert robots.absent[0, own].tolist() == [0.0, 0.0]
    session.close()


def test_robots_of_vsss_wait_for_the_start() -> None:
    link = ServerLink(league="vsss")
    session = session_of(link, "VSSSelfPlay-v0", "firasim", "best")
    events: list[str] = []
    session.connection.on_event.append(events.append)
    session.begin()
    start = link.frame.robots.position[0, :3].copy()
    while "referee: NORMAL_START" not in events:
        assert link.now < 110.0
        np.testing.assert_allclose(link.frame.robots.position[0, :3], start, atol=1e-3)
        session.step()
    for _ in range(40):
        session.step()
    assert np.linalg.norm(link.frame.robots.position[0, :3] - start, axis=1).max() > 0.2
    session.close()


def test_a_policy_that_expects_a_forecast_needs_the_delay() -> None:
    link = ServerLink()
    with pytest.raises(ValueError, match=r"delay: expected that of the robots.*got 0;"):
        session_of(link, "SSLGoToBall-v0", "ssl-simulation", "best:robust")
    assert link.is_closed


def test_a_policy_that_does_not_fit_closes_the_connection() -> None:
    link = ServerLink()
    with pytest.raises(ValueError, match="nobody"):
        session_of(link, "SSLGoToBall-v0", "ssl-simulation", "nobody")
    assert link.is_closed


def test_a_match_without_a_referee_goes_on_by_the_rules_of_the_task() -> None:
    link = ServerLink(robots=2, referee="off")
    session = session_of(link, "SSLMatch-v0", "ssl-simulation")
    events: list[str] = []
    session.connection.on_event.append(events.append)
    session.begin()
    (said,) = events
    assert said.startswith("referee: none heard so far")
    game = session.matches.play.game
    steps = 0
    while not game.may_touch[0].any():
        session.step()
        steps += 1
        assert steps < 800, "nobody starts the match"
    link.give("referee", packet_of(session, Command.HALT))
    session.step()
    assert game.command[0] == Command.HALT
    assert game.score[0].tolist() == [3, 1]
    session.close()


def test_a_match_waits_for_a_referee_that_is_required() -> None:
    link = ServerLink(robots=2, referee="off")
    session = session_of(link, "SSLMatch-v0", "ssl-simulation", referee="require")
    events: list[str] = []
    session.connection.on_event.append(events.append)
    session.begin()
    (said,) = events
    assert said.startswith("referee: none heard at 224.5.23.1:10003 so far; robots stand until")
    command = int(session.matches.play.game.command[0])
    for _ in range(400):
        session.step()
    assert int(session.matches.play.game.command[0]) == command
    assert not session.matches.play.game.may_touch[0].any()
    session.close()


@pytest.mark.parametrize("is_heard", [False, True])
def test_a_required_referee_that_is_not_heard_is_named_in_any_task(is_heard: bool) -> None:
    link = ServerLink(robots=1, referee="off")
    session = session_of(link, "SSLGoToBall-v0", "ssl-simulation", "best", referee="require")
    events: list[str] = []
    session.connection.on_event.append(events.append)
    if is_heard:
        link.give("referee", packet_of(session, Command.HALT))
    session.begin()
    assert any("none heard at" in each for each in events) is not is_heard
    session.close()
