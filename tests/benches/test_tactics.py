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


def test_passes_are_measured(stored: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tactics, "EPISODES", 12)
    row = tactics.measure_passing("keep", "2 v 1", 1)
    passes, arrived = row["passes"]["mean"], row["arrived"]["mean"]
    assert 0.0 < arrived < 1.0
    assert arrived == pytest.approx(passes / (passes + 1.0), abs=0.05), "each ends with a loss"
    assert row["arrived"]["low"] < arrived < row["arrived"]["high"]
    assert "arrived" not in tactics.measure_passing("keep", "3 v 2", 1)
    stored.write_text(json.dumps({"2 v 1": {"keep": row}}))
    assert tactics.passing_report().count("`keep`") == 1


def test_trials_are_of_tasks_and_policies_that_exist() -> None:
    for trial in tactics.TRIALS:
        task = make_task("SSLMatch-v0", **dict(trial.options))
        make_policy(trial.opponent, task)
    assert len({trial.key for trial in tactics.TRIALS}) == len(tactics.TRIALS)
    for name, options in tactics.PASSING.values():
        for policy in tactics.PASSERS:
            make_policy(policy, make_task(name, **options))
