"""`rsoccer serve`."""

import signal
import socket
from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.bridge.sockets import SocketLoop
from rsoccer.commands.serve import ENDING, Serve
from rsoccer.protocols.logs import LogKind, read_log
from rsoccer.protocols.schemas import grsim_pb2, referee_pb2, tracker_pb2
from rsoccer.replay import Replay
from tests.bridge.ports import free_port


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


def test_each_server_has_an_identity_of_its_own(tmp_path: Path) -> None:
    trackers, referees = set(), set()
    for name in ("a.log", "b.log"):
        words = ["serve", "ssl", "--seconds", "0.3", "--blue", "zero", "--yellow", "zero"]
        words += ["--speed", "max", "--record", str(tmp_path / name), *ports(*SSL)]
        assert cli.main(words) == 0
        for entry in read_log(tmp_path / name):
            if entry.kind == LogKind.TRACKER:
                trackers.add(tracker_pb2.Packet.FromString(entry.data).uuid)
            elif entry.kind == LogKind.REFEREE:
                referees.add(referee_pb2.Packet.FromString(entry.data).source_identifier)
    assert len(trackers) == 2
    assert trackers == referees


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
        (["--yellow", "nobody"], "yellow: unknown policy 'nobody'"),
        (["--blue", "nobody", "--yellow", "strike"], "blue: unknown policy 'nobody'"),
        (["--yellow", "chase"], "yellow: task: chase needs robots with"),
        (["--task-options", "max_steps=100"], "options: expected `half_seconds` for the length of"),
        (["--robots", "12"], "12"),
        (["--page", "70000"], "page: expected at most 65535, got 70000"),
        (["--page", "-1"], "page: expected at least 0, got -1"),
        (["--seconds", "-1"], "seconds: expected 0 to inf, got -1"),
        (["--seconds", "nan"], "seconds: expected 0 to inf, got nan"),
        (["--ports", "status_blue=0"], "ports: status_blue: expected at least 1, got 0"),
        (["--ports", "vision=0"], "ports: expected 1 to 65535 for vision, which is sent, got 0"),
        (["--ports", "blue=10300"], "ports: expected others for control and blue, got 10300 twice"),
        (["--ports", "vision=10010"], "ports: expected others for vision and tracker, got 10010"),
        (["--record", "a.rsr", "a.rsr"], "record: expected each file once, got a.rsr a.rsr"),
        (["--record", "a.log", "./a.log"], "record: expected each file once, got a.log ./a.log"),
        (
            ["--task-options", "half=60"],
            "options: unknown ['half']; valid are ['robot', ",
        ),
        (["--robots", "0"], "robots: expected at least 1, got 0"),
        (["--robots", "17"], "robots: expected at most 11, got 17"),
        (["--task-options", "n_blue=3"], "options: expected `robots` for the size of both teams"),
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
                *([] if "--seconds" in words else ["--seconds", "0.01"]),
                *words,
                *([] if "--ports" in words else ports(*SSL)),
            ]
        )
        == cli.WRONG_INPUT
    )
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("name", ENDING)
def test_a_match_that_is_ended_by_a_signal_is_recorded(
    name: signal.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run, ended = SocketLoop.run, []

    def interrupted(self: SocketLoop, seconds: float | None = None) -> None:
        run(self, 0.1)
        signal.raise_signal(name)
        ended.append(self._stopped)

    monkeypatch.setattr(SocketLoop, "run", interrupted)
    previous = signal.signal(name, signal.SIG_DFL)  # `nohup make test` ignores one of them
    try:
        file = tmp_path / "match.rsr"
        assert cli.main(["serve", "ssl", "--record", str(file), *ports(*SSL)]) == 0
        assert ended == [True]
        assert Replay.load(file).seconds > 0.05
        assert signal.getsignal(name) is signal.SIG_DFL
    finally:
        signal.signal(name, previous)


def test_signals_while_a_record_is_written_do_not_cut_it_short(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    save = Replay.save

    def pressed(self: Replay, path: Path) -> Path:
        for name in ENDING:
            signal.raise_signal(name)
        return save(self, path)

    monkeypatch.setattr(Replay, "save", pressed)
    handlers = {name: signal.getsignal(name) for name in ENDING}
    for name in ENDING:
        signal.signal(name, signal.SIG_DFL)
    try:
        file = tmp_path / "match.rsr"
        words = ["serve", "ssl", "--seconds", "0.1", "--record", str(file), *ports(*SSL)]
        assert cli.main(words) == 0
        assert Replay.load(file).seconds > 0.02
    finally:
        for name, handler in handlers.items():
            signal.signal(name, handler)


@pytest.mark.parametrize("taken", ["port", "page"])
def test_a_start_that_fails_leaves_the_files_as_they_are(
    taken: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [tmp_path / name for name in ("match.rsr", "match.log")]
    for file in files:
        file.write_text("of before")
    kind = socket.SOCK_DGRAM if taken == "port" else socket.SOCK_STREAM
    with socket.socket(socket.AF_INET, kind) as other:
        other.bind(("127.0.0.1", 0))
        if kind == socket.SOCK_STREAM:
            other.listen()
        number = other.getsockname()[1]
        chosen = ports(*SSL)
        if taken == "port":
            chosen = [f"blue={number}" if word.startswith("blue=") else word for word in chosen]
        else:
            chosen += ["--page", str(number)]
        assert cli.main(["serve", "ssl", "--record", *map(str, files), *chosen]) == 2
    assert str(number) in capsys.readouterr().err
    assert [file.read_text() for file in files] == ["of before"] * 2


def test_a_signal_that_is_ignored_stays_so(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As under `nohup`, where a terminal that is closed ends nothing."""
    ended: list[bool] = []

    def run(self: SocketLoop, seconds: float | None = None) -> None:
        signal.raise_signal(name)
        ended.append(self._stopped)

    name = ENDING[-1]
    monkeypatch.setattr(SocketLoop, "run", run)
    previous = signal.signal(name, signal.SIG_IGN)
    try:
        assert cli.main(["serve", "ssl", *ports(*SSL)]) == 0
        assert signal.getsignal(name) is signal.SIG_IGN
    finally:
        signal.signal(name, previous)
    assert ended == [False]


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


def test_the_status_of_grsim_goes_to_the_ports_that_are_given(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    packet, answers = grsim_pb2.Packet(), []
    packet.commands.timestamp, packet.commands.isteamyellow = 0.0, True

    def send(self: SocketLoop, seconds: float | None = None) -> None:
        client = ("127.0.0.1", 5001)
        for yellow in (False, True):
            packet.commands.isteamyellow = yellow
            answers.extend(self.server.receive("grsim", packet.SerializeToString(), client, 0.0))

    monkeypatch.setattr(SocketLoop, "run", send)
    words = ["serve", "ssl", *ports(*SSL), "status_blue=4001", "status_yellow=4002"]
    assert cli.main(words) == 0
    assert [answer.address for answer in answers] == [("127.0.0.1", 4001), ("127.0.0.1", 4002)]
