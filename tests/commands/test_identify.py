"""`rsoccer identify`."""

import io
import json
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

from rsoccer import RobotModel, cli
from rsoccer.commands import identify as command
from rsoccer.identify import record, write_log


def test_identify_prints_numbers_and_writes_models(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log, model = tmp_path / "log.csv", tmp_path / "model.json"
    write_log(record("vss_440rpm", sensing="vsss", seed=2), log)
    assert cli.main(["identify", str(log), "--out", str(model)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["number", "value", "95%", "interval", "unit"]
    assert lines[1].split()[0] == "latency"
    assert "not identified:" in lines
    assert lines[-1] == f"models: {model}"
    assert RobotModel(str(model)).name == "vss_440rpm"
    content = json.loads(model.read_text())
    assert 0.04 < content["sensing"]["delay"] < 0.08
    options = ["--task-options", f"robot={model}", "--sensing", str(model)]
    words = ["evaluate", "chase", "--task", "VSS-v0", "--matches", "2", *options]
    assert cli.main(words) == 0
    assert "chase" in capsys.readouterr().out


def test_the_program_is_printed_or_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["identify", "--program"]) == 0
    printed = capsys.readouterr().out
    assert printed.splitlines()[0] == "time,v_x,v_y,v_theta,kick_v_x"
    path = tmp_path / "program.csv"
    words = ["identify", "--program", "--robot", "vss_440rpm", "--rate", "30", "--out", str(path)]
    assert cli.main(words) == 0
    first, *rows = path.read_text().splitlines()
    assert first == "time,left,right"
    assert rows[1].startswith("0.0333,")


def test_a_slower_program_is_shorter_and_waits_for_the_ball(
    capsys: pytest.CaptureFixture[str],
) -> None:
    def rows(*options: str) -> np.ndarray:
        assert cli.main(["identify", "--program", *options]) == 0
        text = capsys.readouterr().out
        return np.genfromtxt(io.StringIO(text), delimiter=",", skip_header=1)

    slow = rows("--max-speed", "1.5", "--max-angular-velocity", "3", "--pause", "5")
    usual = rows()
    assert np.hypot(usual[:, 1], usual[:, 2]).max() > 3.0
    assert np.hypot(slow[:, 1], slow[:, 2]).max() <= 1.5 + 1e-6
    assert np.abs(slow[:, 3]).max() <= 3.0 + 1e-6
    kicks = [each[each[:, 4] > 0, 0] for each in (usual, slow)]
    pauses = [np.diff(times)[np.diff(times) > 1.0].min() for times in kicks]
    assert pauses[1] - pauses[0] == pytest.approx(4.5, abs=0.1)


def test_every_option_is_of_the_fit_or_of_the_program_or_of_both() -> None:
    common = {"robot", "out", "program", "imports"}
    own = {*command._OF_FIT, *command._OF_PROGRAM}
    assert not own & common
    assert own | common == {each.name for each in fields(command.Identify)}


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "expected one file or more"),
        (["gone.csv"], "gone.csv does not exist"),
        (["gone.csv", "--out", "model.txt"], "ending in .json"),
        (["gone.csv", "--program"], "expected none with --program"),
        (["--program", "--robot", "nobody"], "nobody"),
        (["--program", "--clocks", "2"], "clocks: expected none with --program"),
        (["gone.csv", "--rate", "30"], "rate: expected none without --program"),
        (["gone.csv", "--pause", "1"], "pause: expected none without --program"),
        (["--program", "--rate", "0"], "rate"),
        (["--program", "--max-speed", "0"], "max_speed: expected"),
        (["--program", "--max-angular-velocity", "-1"], "max_angular_velocity: expected"),
        (["--program", "--pause", "0"], "pause: expected"),
    ],
)
def test_wrong_words_are_refused(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["identify", *words]) == 2
    assert message in capsys.readouterr().err
