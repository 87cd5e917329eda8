"""A policy that drives a team of a match."""

from __future__ import annotations

import pytest

from rsoccer.drive.session import Session
from rsoccer.drive.settings import Settings
from rsoccer.game import Command
from rsoccer.registry import make_task
from tests.drive.wires import ServerLink

SMALL = {"n_blue": 2, "n_yellow": 2}


def session_of(link: ServerLink, task: str, peer: str, policy: str = "strike", **options: object) -> Session:
    settings = Settings(peer, **options)  # type: ignore[arg-type]
    link.heard = set(settings.heard)
    numbers = SMALL if task == "SSLMatch-v0" else {}
    return Session(policy, make_task(task, **numbers), settings, link=link, clock=link.clock)


@pytest.mark.parametrize("team", ["blue", "yellow"])
def test_a_match_policy_plays_under_the_referee_of_the_peer(team: str) -> None:
    link, told = ServerLink(robots=2), []
    session = session_of(link, "SSLMatch-v0", "ssl-simulation", team=team)
    session.connection.on_event.append(told.append)
    session.begin()
    arena = link.server.session.arena
    swap = {"blue": lambda score: score, "yellow": lambda score: score[::-1]}[team]
    assert link.server.session.arena.play.game.score.sum() == 0
    # Yellow's goals come from the peer: the ball is put into a goal of a side that is driven.
    for _ in range(400):
        session.step()
        if arena.play.game.score.any():
            break
    for _ in range(10):
        session.step()
    score = arena.play.game.score[0].tolist()
    assert sum(score) >= 1, "nobody else plays, so the policy scores"
    assert session.matches.play.game.score[0].tolist() == swap(score)
    assert score[0 if team == "blue" else 1] == 1
    assert "referee: NORMAL_START" in told
    command = Command(int(arena.play.game.command[0]))
    seen = Command(int(session.matches.play.game.command[0]))
    exchanged = {"BLUE": "YELLOW", "YELLOW": "BLUE"}
    color = command.name.rpartition("_")[2]
    expected = command.name.replace(color, exchanged[color]) if color in exchanged else command.name
    assert seen.name == (command.name if team == "blue" else expected)
    session.close()


def test_a_goal_is_scored_in_vsss_with_one_team_driven() -> None:
    link = ServerLink(league="vsss")
    session = session_of(link, "VSSSelfPlay-v0", "firasim", "best")
    session.begin()
    for _ in range(400):
        session.step()
        if link.server.session.arena.play.game.score.any():
            break
    assert link.server.session.arena.play.game.score[0].tolist() == [1, 0]
    assert session.episodes[0]["goal_score"] == 1.0
    session.close()


def test_a_policy_that_does_not_fit_closes_the_connection() -> None:
    link = ServerLink()
    with pytest.raises(ValueError, match="nobody"):
        session_of(link, "SSLGoToBall-v0", "ssl-simulation", "nobody")
    assert link.is_closed
