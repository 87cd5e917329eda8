"""`rsoccer benchmark`."""

import hashlib
import json
from pathlib import Path

import pytest

from rsoccer import cli

TASK = ["--task", "SSLGoToBall-v0", "--threads", "1", "--no-robust"]


def test_a_policy_is_measured_and_its_file_checked(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "entry.json"
    options = [*TASK, "--out", str(path), "--name", "Mine", "--description", "A script."]
    assert cli.main(["benchmark", "fetch", *options]) == 0
    assert "Mine: 200 matches a row" in capsys.readouterr().out
    first = json.loads(path.read_text())
    assert (first["name"], first["description"]) == ("Mine", "A script.")
    assert cli.main(["benchmark", "--check", str(path), "--replay", "SSLGoToBall-v0"]) == 0
    assert "valid, 1 rows of 1 tasks" in capsys.readouterr().out
    assert cli.main(["benchmark", "fetch", *options]) == 0
    assert json.loads(path.read_text()) == first, "no row was played again"
    unnamed = [*TASK, "--out", str(path)]
    assert cli.main(["benchmark", "fetch", *unnamed]) == 0
    assert json.loads(path.read_text()) == first, "the name stays"
    path.write_text(path.read_text().replace('"wins": 200', '"wins": 199'))
    assert cli.main(["benchmark", "--check", str(path)]) == 2
    assert "expected 200 in all" in capsys.readouterr().err


def test_code_that_an_entry_names_is_not_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["benchmark", "fetch", *TASK, "--out", str(tmp_path / "entry.json")]) == 0
    (tmp_path / "code_of_the_entry.py").write_text(
        "from rsoccer.policies import make_policy\n"
        "open('imported', 'w').close()\n"
        "def player(task):\n    return make_policy('fetch', task)\n"
    )
    monkeypatch.chdir(tmp_path)
    values = json.loads(Path("entry.json").read_text())
    values["policy"] = "code_of_the_entry:player"
    values["digest"] = hashlib.sha256(Path("code_of_the_entry.py").read_bytes()).hexdigest()
    Path("entry.json").write_text(json.dumps(values))
    check = ["--check", "entry.json", "--replay", "SSLGoToBall-v0"]
    assert cli.main(["benchmark", *check]) == 2
    assert "the entry names code, code_of_the_entry:player" in capsys.readouterr().err
    assert cli.main(["benchmark", "fetch", *check]) == 2
    assert "expected that of the entry, code_of_the_entry:player, got" in capsys.readouterr().err
    assert not Path("imported").exists()
    assert cli.main(["benchmark", "code_of_the_entry:player", *check]) == 0
    assert Path("imported").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "policy: expected a policy, or --check"),
        (["fetch", "--check", "a.json"], "replay: expected a task to play again"),
        (["fetch", "--replay", "VSS-v0"], "replay: expected --check with it"),
        (["fetch", "--out", "entry.txt"], "out: expected a name ending in .json"),
        (["match.rsr"], "expected a policy, got the replay"),
        (["fetch", "--task", "VSS-v0"], "expected one that plays one of the tasks"),
        (["--check", "missing.json"], "missing.json"),
    ],
)
def test_wrong_words_are_refused(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["benchmark", *words]) == 2
    assert message in capsys.readouterr().err
