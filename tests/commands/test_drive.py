"""`rsoccer drive`."""

from __future__ import annotations

import threading
from collections.abc import Iterator

import pytest

from rsoccer import cli
from rsoccer.bridge.server import Server
from rsoccer.bridge.settings import Settings
from rsoccer.bridge.sockets import SocketLoop
from tests.bridge.test_sockets import PATIENCE, network


@pytest.fixture
def words() -> Iterator[list[str]]:
    """Return the words that drive blue 5 of a server that waits for its clients."""
    places = network()
    server = Server(Settings(speed=None, yellow="zero", referee="off"))
    with SocketLoop(server, places) as loop:
        ports = {name: loop.addresses[name][1] for name in ("blue", "yellow", "control")}
        ports |= {name: places.ports[name] for name in ("vision", "referee")}
        thread = threading.Thread(target=loop.run, args=(2 * PATIENCE,))
        thread.start()
        try:
            yield [
                *("drive", "best", "--task", "SSLGoToBall-v0", "--to", "ssl-simulation"),
                *("--synchronous", "--ids", "5", "--patience", str(PATIENCE)),
                *("--ports", *(f"{name}={number}" for name, number in ports.items())),
            ]
        finally:
            loop.stop()
            thread.join()


def test_the_ball_is_reached(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*words, "--episodes", "1", "--seconds", "20"]) == 0
    report = capsys.readouterr()
    assert "an episode ended, reached 1" in report.out
    assert "1 episodes of SSLGoToBall-v0" in report.out
    assert "frames were seen" in report.err


def test_a_robot_is_checked(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*words, "--check", "5"]) == 0
    report = capsys.readouterr()
    assert report.out.count("right") >= 6
    assert "use --delay 0" in report.out


def test_a_robot_that_is_not_of_the_team_is_not_checked(
    words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([*words, "--check", "3"]) == cli.WRONG_INPUT
    assert "check: expected one of the robots [5] (--ids), got 3" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--ports", "vision=x"], "ports: expected a number for vision, got 'x'"),
        (["--ports", "vision"], "ports: expected NAME=VALUE, got 'vision'"),
        (["--ports", "video=1"], "ports: expected names of"),
        (["--groups", "vision=lo", "--ports", "vision=20998"], "groups: vision: expected an IPv4"),
        (["--ids", "1", "2"], "ids: expected 1 different numbers, got [1, 2]"),
        (["--to", "firasim"], "task: expected robots on two wheels with firasim, got some with"),
        (["--to", "firasim", "--groups", "tracker=127.0.0.1"], "groups: expected names of"),
        (["--delay", "2"], "delay: expected 0 to 1, got 2"),
        (["--seconds", "-1"], "seconds: expected 0 to inf, got -1"),
        (["--episodes", "0"], "episodes: expected at least 1, got 0"),
        (["--max-speed", "-1"], "max_speed: expected 0 to 1e+06, got -1"),
        (["--policy", "nobody"], "policy: expected a task before"),
    ],
)
def test_wrong_words_are_named(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["drive", "best", "--task", "SSLGoToBall-v0", *words]) == 2
    assert message in capsys.readouterr().err
