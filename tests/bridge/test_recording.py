"""Records of a served match."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

import numpy as np
import pytest

from rsoccer import Sensing
from rsoccer.bridge import recording
from rsoccer.bridge.recording import MAX_COMMAND, record
from rsoccer.bridge.server import MAX_HEARD
from rsoccer.game import Command
from rsoccer.protocols.logs import LogKind, read_log
from rsoccer.protocols.schemas import simulation_pb2
from rsoccer.replay import Replay
from tests.bridge.clients import Wall, local_velocity
from tests.drive.test_connection import packet_of


def play(wall: Wall) -> None:
    for _ in range(40):
        wall.team(local_velocity([1]))
        wall.tick(5)


def test_a_replay(tmp_path: Path) -> None:
    wall = Wall(sensing=Sensing("rc2021"), yellow="zero")
    with record(wall.server, tmp_path / "match.rsr"):
        play(wall)
    assert not wall.server.listeners
    replay = Replay.load(tmp_path / "match.rsr")
    assert len(replay) == 41
    assert replay.seconds == pytest.approx(1.0)
    np.testing.assert_allclose(replay.frame.robots.position[-1], wall.robots.position[0], atol=1e-3)
    assert replay.commands[-1, 1, 0] == pytest.approx(1.0, abs=0.01)
    assert replay.names == ("BLUE", "zero")
    assert replay.sensed is not None
    assert replay.referee_states is not None
    state = replay.referee_states[-1]
    assert state.command_seconds == pytest.approx(1.0, abs=0.05)
    assert "canvas" in replay.to_html()


def test_a_replay_of_absurd_commands_is_written(tmp_path: Path) -> None:
    wall = Wall()
    with record(wall.server, tmp_path / "match.rsr"):
        for _ in range(4):
            wall.team(local_velocity([1], forward=9e8, left=-9e8, angular=-9e8))
            wall.tick(5)
    replay = Replay.load(tmp_path / "match.rsr")
    assert replay.commands[-1, 1, :3].tolist() == [MAX_COMMAND, -MAX_COMMAND, -MAX_COMMAND]
    np.testing.assert_allclose(replay.frame.robots.position[-1], wall.robots.position[0], atol=1e-3)


def test_a_log(tmp_path: Path) -> None:
    wall = Wall()
    with record(wall.server, tmp_path / "match.log.gz"):
        play(wall)
    entries = list(read_log(tmp_path / "match.log.gz"))
    kinds = [entry.kind for entry in entries]
    assert kinds.count(LogKind.VISION) == pytest.approx(60, abs=1)
    assert kinds.count(LogKind.TRACKER) == kinds.count(LogKind.VISION)
    assert kinds.count(LogKind.REFEREE) >= 40
    assert [entry.time for entry in entries] == sorted(entry.time for entry in entries)
    assert all(entry.message() is not None for entry in entries)


def test_a_log_has_the_packets_of_a_referee_on_the_network(tmp_path: Path) -> None:
    wall = Wall(referee="external")
    packet = packet_of(Command.FORCE_START)
    with record(wall.server, tmp_path / "match.log"):
        for _ in range(20):
            wall.send("referee", packet)
            wall.send("referee", b"garbage")
            sent = wall.tick(5)
            assert "referee" not in {datagram.port for datagram in sent}
    entries = [e for e in read_log(tmp_path / "match.log") if e.kind == LogKind.REFEREE]
    assert [entry.data for entry in entries] == [packet] * 20


def test_packets_of_a_referee_do_not_pile_up() -> None:
    wall = Wall(referee="external", speed=None)
    packet = packet_of(Command.FORCE_START)
    for _ in range(50):
        wall.send("referee", packet)
    assert not wall.server._heard, "nobody listens"
    wall.server.listeners.append(lambda server, sent: None)
    for _ in range(MAX_HEARD + 50):
        wall.send("referee", packet)
    assert len(wall.server._heard) == MAX_HEARD


def test_what_cannot_be_recorded_is_refused(tmp_path: Path) -> None:
    wall = Wall()
    with pytest.raises(ValueError, match=r"record: expected a name ending in .rsr"):
        record(wall.server, tmp_path / "match.mp4").__enter__()
    for name in ("match.rsr.gz", "match.gz"):
        with pytest.raises(ValueError, match=r"record: expected a name ending in .rsr"):
            record(wall.server, tmp_path / name).__enter__()
    with pytest.raises(ValueError, match="record: expected a file in a folder that exists"):
        record(wall.server, tmp_path / "no" / "match.rsr").__enter__()
    with pytest.raises(ValueError, match="record: expected a replay"):
        record(Wall(league="vsss").server, tmp_path / "match.log").__enter__()


def test_a_replay_whose_place_is_gone_is_kept_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    spare = tmp_path / "spare"
    spare.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(spare))
    place = tmp_path / "gone" / "match.rsr"
    place.parent.mkdir()
    wall = Wall(blue="strike")

    def lose() -> None:
        with record(wall.server, place):
            play(wall)
            shutil.rmtree(place.parent)

    with pytest.raises(
        OSError, match=r"record: cannot write .*match\.rsr: .*; the replay is .*spare"
    ):
        lose()
    (kept,) = spare.glob("match-*.rsr")
    assert Replay.load(kept).seconds > 0.0


def lighter_robot() -> simulation_pb2.Command:
    message = simulation_pb2.Command()
    specs = message.config.robot_specs.add(mass=1.5)
    specs.id.id, specs.id.team = 1, simulation_pb2.BLUE
    return message


def test_robots_are_not_exchanged_while_a_replay_is_recorded(tmp_path: Path) -> None:
    wall = Wall()
    with record(wall.server, tmp_path / "match.rsr"):
        wall.tick(20)
        assert wall.control(lighter_robot()) == ["RECORDING"]
        wall.tick(20)
    assert Replay.load(tmp_path / "match.rsr").config.robots[1].mass != 1.5
    with record(wall.server, tmp_path / "match.log"):
        assert wall.control(lighter_robot()) == []
    assert wall.server.session.arena.config.robots[1].mass == 1.5


def test_a_replay_ends_when_it_is_full(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(recording, "MAX_SECONDS", 0.5)
    wall = Wall()
    with record(wall.server, tmp_path / "match.rsr"):
        wall.tick(200)
    assert Replay.load(tmp_path / "match.rsr").seconds == pytest.approx(0.5)
    assert wall.server.session.counts["replay: ticks left out"] >= 98
    (said,) = caplog.messages
    assert said == "record: the replay is full after 0.5 s; a log has no limit"
