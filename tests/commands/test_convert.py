"""`rsoccer convert`."""

from pathlib import Path

import numpy as np
import pytest

from rsoccer import cli
from rsoccer.protocols.logs import read_index, read_log
from rsoccer.replay import Replay, record_replay


@pytest.fixture
def replay(tmp_path: Path) -> Path:
    made = record_replay("SSLSelfPlay-v0", {"all": "strike"}, seconds=0.5)
    return made.save(tmp_path / "a.rsr")


def error(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    assert cli.main(["convert", *arguments]) == cli.WRONG_INPUT
    return capsys.readouterr().err


def test_replays_become_logs_and_logs_replays(
    replay: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log, back = tmp_path / "a.log", tmp_path / "b.rsr"
    options = ["--start", "100", "--index", "--blue-on-positive-half"]
    assert cli.main(["convert", str(replay), str(log), *options]) == 0
    assert "log: " in capsys.readouterr().out
    assert next(iter(read_log(log))).time == 100 * 10**9
    assert read_index(log) is not None
    options = ["--time-step", "0.05", "--blue-on-positive-half"]
    assert cli.main(["convert", str(log), str(back), *options]) == 0
    assert "(0.5 s)" in capsys.readouterr().out
    found, made = Replay.load(back), Replay.load(replay)
    assert found.config.time_step == pytest.approx(0.05)
    np.testing.assert_allclose(found.frame.ball.position[0], made.frame.ball.position[0], atol=1e-3)


def test_wrong_files_are_refused(
    replay: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log, none = str(tmp_path / "a.log"), str(tmp_path / "none.rsr")
    text = "target: expected one of the two files to be a replay (.rsr)"
    assert text in error([str(replay), none], capsys)
    assert text in error([log, log], capsys)
    assert "does not exist" in error([none, log], capsys)
    assert "expected a name ending in .log or .gz" in error([str(replay), f"{log}x"], capsys)
    assert "No such file" in error([log, none], capsys)
    Path(log).write_text("nothing")
    assert "expected a file that begins with SSL_LOG_FILE" in error([log, none], capsys)


def test_options_of_the_other_direction_are_refused(
    replay: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = str(tmp_path / "a.log")
    for options, text in [
        (["--time-step", "0.05"], "time_step: expected none in this direction, got 0.05"),
        (["--field", "ssl_a"], "field: expected none in this direction, got ssl_a"),
    ]:
        assert text in error([str(replay), log, *options], capsys)
    back = str(tmp_path / "b.rsr")
    for options, text in [
        (["--index"], "index: expected none"),
        (["--start", "3"], "start: expected none"),
    ]:
        assert text in error([log, back, *options], capsys)
