"""Measurements of learned tactics: what is played, kept and shown."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from benches import tactics
from rsoccer.policies import make_policy
from rsoccer.registry import make_task


@pytest.fixture
def stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "tactics.json"
    monkeypatch.setattr(tactics, "FILE", path)
    monkeypatch.setattr(tactics, "MATCHES", 20)
    monkeypatch.setattr(tactics, "HALF_SECONDS", 1.0)
    return path


def test_results_are_kept_and_shown(stored: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["scripted", "--trials", "6 v 6, scripted:0.5", "--threads", "1"]
    tactics.main(words)
    found = json.loads(stored.read_text())
    assert list(found) == ["6 v 6, scripted:0.5"]
    row = found["6 v 6, scripted:0.5"]["scripted"]
    assert row["matches"] == row["wins"] + row["draws"] + row["losses"] == 20
    assert "| 6 v 6 | `scripted:0.5` | `scripted` |" in capsys.readouterr().out
    before = stored.read_bytes()
    tactics.main(words)
    assert stored.read_bytes() == before, "what the file has is not played again"


def test_trials_are_of_tasks_and_policies_that_exist() -> None:
    for trial in tactics.TRIALS:
        task = make_task("SSLMatch-v0", **dict(trial.options))
        make_policy(trial.opponent, task)
    assert len({trial.key for trial in tactics.TRIALS}) == len(tactics.TRIALS)
