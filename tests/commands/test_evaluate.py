"""`rsoccer evaluate`."""

import json
from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.commands import evaluate as evaluate_command
from rsoccer.replay import Replay


def test_evaluate_prints_a_table_and_writes_results(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "results.json"
    arguments = [
        "evaluate",
        "chase",
        "--opponents",
        "zero",
        "ou",
        "--matches",
        "4",
        "--json",
        str(file),
    ]
    assert cli.main(arguments) == 0
    task, _, header, *rows = capsys.readouterr().out.splitlines()
    assert task == "VSSSelfPlay-v0"
    assert header.split()[:2] == ["policy", "opponent"]
    assert [row.split()[:3] for row in rows] == [["chase", "zero", "4"], ["chase", "ou", "4"]]
    zero, ou = json.loads(file.read_text())
    assert (zero["opponent"], ou["opponent"]) == ("zero", "ou")
    assert zero["wins"] + zero["draws"] + zero["losses"] == 4


def test_evaluate_writes_the_last_match(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page, saved = tmp_path / "match.html", tmp_path / "match.rsr"
    options = ["--matches", "2", "--html", str(page), "--save", str(saved)]
    assert cli.main(["evaluate", "fetch", "--task", "SSLGoToBall-v0", *options]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[-2:] == [f"page: {page}", f"replay: {saved}"]
    replay = Replay.load(saved)
    assert (replay.task, replay.names, len(replay.episodes)) == ("SSLGoToBall-v0", ("FETCH", ""), 1)
    assert page.read_text().startswith("<!doctype html>")


def test_evaluate_checks_the_output_folder_before_it_plays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(evaluate_command, "evaluate", lambda *_, **__: pytest.fail("it played"))
    assert cli.main(["evaluate", "chase", "--json", str(tmp_path / "no" / "r.json")]) == 2
    assert "json" in capsys.readouterr().err
