"""Scores in other simulators: what is kept, gone on with, and printed."""

import json
from pathlib import Path

import pytest

from benches import transfer, transfer_tables
from benches.transfer_places import (
    FORECAST,
    HOME,
    PLACES,
    TRIALS,
    Trial,
    as_played,
    is_forecast,
    likeness,
)
from rsoccer.drive.settings import PEERS
from rsoccer.registry import make_task

GO = "SSLGoToBall-v0, zero"


@pytest.fixture
def still(monkeypatch: pytest.MonkeyPatch) -> Trial:
    """A trial of robots that stand still."""
    trial = Trial("SSLGoToBall-v0", "zero")
    monkeypatch.setattr(transfer, "TRIALS", (trial,))
    monkeypatch.setattr(transfer_tables, "TRIALS", (trial,))
    return trial


def test_places_and_trials_fit() -> None:
    assert {place.peer for place in PLACES.values()} == set(PEERS)
    assert len({trial.name for trial in TRIALS}) == len(TRIALS)
    for name, place in PLACES.items():
        own = [trial for trial in TRIALS if trial.league == place.league]
        assert own, name
        for trial in own:
            task, sensing = likeness(place, trial)
            assert task.name == trial.task
            assert (sensing.forecast == 1.0) == is_forecast(trial)
            assert trial.forecasts == trial.name.endswith(FORECAST)
            there, _ = as_played(place, trial)
            assert there.config == task.config, "the robot and the ball of the place"


def test_results_are_kept_and_gone_on_with(
    still: Trial, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [HOME, "--results", str(tmp_path)]
    transfer.main([*words, "--matches", "3"])
    path = tmp_path / "home.json"
    row = json.loads(path.read_text())[still.name]
    assert row["scores"] == {"all": [0.0, 0.0, 0.0]}
    assert len(row["seconds"]["all"]) == 3
    row["scores"]["all"][0] = 0.5
    path.write_text(json.dumps({still.name: row}))
    with pytest.raises(SystemExit):
        transfer.main([*words, "--matches", "4"])
    assert "--resume" in capsys.readouterr().err
    transfer.main([*words, "--matches", "4", "--resume"])
    assert json.loads(path.read_text())[still.name]["scores"]["all"] == [0.5, 0.0, 0.0, 0.0]


def test_episodes_begin_alike_however_they_are_counted() -> None:
    trial = Trial("SSLGoToBall-v0", "fetch")
    task = make_task(trial.task)
    together = transfer.play(task, trial, range(4), None)
    apart = [transfer.play(task, trial, range(n, n + 2), None) for n in (0, 2)]
    assert together[1] == apart[0][1] + apart[1][1]
    assert len(set(together[1])) > 1


def test_the_table_has_the_lower_end_as_a_part_of_home(still: Trial, tmp_path: Path) -> None:
    for name, scores in (("home", [1.0] * 9 + [0.0]), ("grsim", [1.0] * 100)):
        row = {"scores": {"all": scores}, "seconds": {"all": [1.0] * len(scores)}}
        (tmp_path / f"{name}.json").write_text(json.dumps({still.name: row}))
    printed = transfer_tables.report(tmp_path)
    assert "| grSim | `SSLGoToBall-v0` | zero | 100 | 0.9 (" in printed
    assert "| 1 (0.963 to 1) | 107% | - |" in printed


def test_shares_have_intervals_by_wilson_and_goal_scores_by_a_bootstrap() -> None:
    share = transfer_tables.interval({"all": [1.0] * 90 + [0.0] * 10})
    assert share.low == pytest.approx(0.826, abs=1e-3)
    assert share.high == pytest.approx(0.945, abs=1e-3)
    goals = transfer_tables.interval({"blue": [1.0] * 10, "yellow": [-1.0] * 5 + [1.0] * 5})
    assert goals.mean == pytest.approx(0.5)
    assert goals.low is not None and 0.0 < goals.low < 0.5


def test_unknown_trials_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        transfer.main(["firasim", "--trials", GO])
    assert "unknown ['SSLGoToBall-v0, zero']" in capsys.readouterr().err
