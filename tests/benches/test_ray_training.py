"""Comparison of training on Ray with the trainer: its runs, what is kept, the extrapolation."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from benches import ray_training
from benches.ray_training import Plan, Points, cores_needed, needed_by_small


@pytest.fixture
def stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "ray_training.json"
    monkeypatch.setattr(ray_training, "FILE", path)
    monkeypatch.setattr(ray_training, "MATCHES", 20)
    monkeypatch.setattr(ray_training, "OPPONENTS", ("zero",))
    return path


class Saved:
    """A policy that writes an empty file."""

    def save(self, path: Path) -> None:
        path.touch()


def test_the_trainer_stops_at_the_limit_and_is_evaluated(
    stored: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--minutes", "0.002", "--worlds", "32", "--out", str(tmp_path / "runs")]
    words += ["--pace", "1000000", "--task-options", "half_seconds=1"]
    ray_training.main(["--only", "trainer", *words])
    (point,) = json.loads((tmp_path / "runs" / "trainer" / "points.json").read_text())
    assert point["minutes"] == 0.002
    assert point["seconds"] >= 0.12
    assert point["decisions"] > 0
    ray_training.main(["--only", "trainer", *words])  # it is over
    ray_training.main(["--only", "evaluate", *words])
    (row,) = json.loads(stored.read_text())["runs"]["trainer"]
    assert row["scores"]["zero"]["matches"] == 20
    assert "| `rsoccer train` | 0.002 |" in capsys.readouterr().out


def test_policies_are_kept_once_and_after_a_resume(tmp_path: Path) -> None:
    plan = Plan(minutes=30.0)
    assert plan.marks == [10.0, 20.0, 30.0]
    points = Points(plan, tmp_path)
    assert not points.add(Saved, 599.0, 10)
    assert not points.add(Saved, 601.0, 20)
    assert not points.add(Saved, 700.0, 30)
    points = Points(plan, tmp_path)
    assert points.add(Saved, 1800.0, 40)
    assert [point["minutes"] for point in points.kept] == [10.0, 30.0]
    assert points.policy(10.0).exists()


def test_schedules_follow_from_the_cores_or_a_pace(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ray_training, "processors", lambda: 4)
    monkeypatch.setitem(ray_training.PACE, "ray", 100)
    assert Plan(minutes=2.0).decisions("ray") == 4 * 100 * 120
    assert Plan(minutes=2.0, pace=50).decisions("ray") == 50 * 120


def test_decisions_of_an_iteration_without_samples_are_none() -> None:
    for main, expected in ((48.0, 48.0), (float("nan"), 0.0)):
        result = {"env_runners": {"num_module_steps_sampled": {"main": main}}}
        assert ray_training.learned(result) == expected
    assert ray_training.learned({"env_runners": {}}) == 0.0


def results(low: float) -> dict[str, Any]:
    score = {"score": low + 0.1, "low": low, "high": low + 0.2}
    point = {"minutes": 10.0, "seconds": 601.0, "decisions": 2e6, "scores": {"zero": score}}
    return {
        "task": "VSSMatch-v0",
        "options": ["half_seconds=30"],
        "minutes": 60.0,
        "runners": 2,
        "machine": {"machine": "a machine", "cores": 2, "date": "2026-01-01"},
        "runs": {"trainer": [point], "ray": [point]},
        "speed": {"decisions_per_second": 1e3, "steps_per_second": 5e3, "robots": 11.0},
    }


def test_the_cores_follow_from_the_numbers(stored: Path) -> None:
    assert needed_by_small(results(-0.1), "zero") is None
    assert needed_by_small(results(0.1), "zero") == 2e6
    days = cores_needed(86.4e6, (3, 6), 1.0, 1000.0, 1.0)
    assert days == pytest.approx(4.0)
    assert cores_needed(86.4e6, (3, 6), 2.0, 1000.0, 2.0) == pytest.approx(4.0)
    assert "not stored" in ray_training.extrapolation()
    assert "No run" in ray_training.report()
    stored.write_text(json.dumps(results(0.1)))
    assert "| `zero` | 2.0 M | 1 |" in ray_training.extrapolation()
    assert "| Ray | 10 | 2.0 M |" in ray_training.report()
    stored.write_text(json.dumps(results(-0.1)))
    assert "not in these runs" in ray_training.extrapolation()
