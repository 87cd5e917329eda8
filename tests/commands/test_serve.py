"""`rsoccer serve`."""

from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.commands.serve import Serve
from rsoccer.replay import Replay
from tests.bridge.test_sockets import free_port


def ports(*names: str) -> list[str]:
    """Return options for free ports."""
    return ["--ports", *(f"{name}={free_port()}" for name in names)]


SSL = ("control", "blue", "yellow", "grsim", "vision", "tracker", "referee")
VSSS = ("command", "vision", "referee", "replacer")


@pytest.mark.parametrize(("league", "names"), [("ssl", SSL), ("vsss", VSSS)])
def test_a_match_is_served_and_recorded(
    league: str, names: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "match.rsr"
    words = ["serve", league, "--seconds", "0.3", "--blue", "zero", "--yellow", "zero"]
    words += ["--speed", "max", "--record", str(file), *ports(*names)]
    assert cli.main(words) == 0
    report = capsys.readouterr().err
    assert f"{names[0]}: receives at 127.0.0.1:" in report
    assert "s were simulated" in report
    assert Replay.load(file).seconds > 0.1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--speed", "fast"], "speed: expected a number or max, got 'fast'"),
        (["--speed", "-1"], "speed: expected"),
        (["--ports", "video=1"], "ports: expected one of"),
        (["--ports", "vision=x"], "ports: expected a number for vision, got 'x'"),
        (["--ports", "vision=1", "vision=2"], "ports: expected each name once"),
        (["--groups", "vision=lo"], "groups: vision: expected an IPv4 address"),
        (["--host", "nowhere"], "host: expected an IPv4 address"),
        (["--sensing", "perfect"], "perfect"),
        (["--yellow", "nobody"], "nobody"),
        (["--robots", "12"], "12"),
    ],
)
def test_wrong_words_are_named(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert (
        cli.main(
            [
                "serve",
                "ssl",
                "--seconds",
                "0.01",
                *words,
                *([] if "--ports" in words else ports(*SSL)),
            ]
        )
        == cli.WRONG_INPUT
    )
    assert message in capsys.readouterr().err


def test_ports_and_groups_are_those_of_the_league_unless_given() -> None:
    network = Serve("ssl", ports=("vision=10020",), groups=("vision=127.0.0.1",)).network()
    assert network.ports["vision"] == 10020
    assert network.groups == {
        "vision": "127.0.0.1",
        "tracker": "224.5.23.2",
        "referee": "224.5.23.1",
    }
    assert (network.ports["control"], network.ports["blue"]) == (10300, 10301)
    assert Serve("vsss").network().ports["command"] == 20011
