import json
from pathlib import Path

import pytest

from tools import write_readme
from tools.keep_demo import training

EVALUATION = {
    "opponent": "out/demo/untrained.safetensors",
    "matches": 400,
    "wins": 300,
    "draws": 60,
    "losses": 40,
    "score": 0.65,
    "low": 0.6,
    "high": 0.7,
}


def test_the_speed_is_a_median_and_the_shares_are_of_the_whole_time(tmp_path: Path) -> None:
    lines = ["samples_per_second,time_physics,time_learning", "100,0.2,0.7", "300,0.4,0.4"]
    lines.append("200,0.3,0.6")
    (tmp_path / "progress.csv").write_text("\n".join(lines) + "\n")
    (tmp_path / "args.json").write_text(json.dumps({"rollout.action_repeat": 3}))
    found = training(tmp_path)
    assert found["samples_per_second"] == 200
    assert found["agent_steps_per_second"] == 600
    assert found["shares"] == {
        "physics": pytest.approx((6 * 0.2 + 2 * 0.4 + 3 * 0.3) / 11),
        "learning": pytest.approx((6 * 0.7 + 2 * 0.4 + 3 * 0.6) / 11),
    }


def test_the_readme_shows_the_kept_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    kept = {
        "samples": 4_000_000,
        "seconds": {"training": 151.7},
        "evaluations": [EVALUATION],
        "training": {
            "samples_per_second": 26_543.0,
            "agent_steps_per_second": 79_629.0,
            "shares": {"physics": 0.31},
        },
        "machine": {"machine": "Some CPU", "cores": 2, "date": "2026-01-31"},
    }
    path = tmp_path / "demo.json"
    monkeypatch.setattr(write_readme, "DEMO", path)
    assert write_readme.demo() == ""
    path.write_text(json.dumps(kept))
    text = write_readme.demo()
    assert "| untrained | 400 | 300 | 60 | 40 | +0.65 | +0.60 to +0.70 |" in text
    assert "26,500 decisions, which are 79,600 control steps of robots" in text
    assert "physics 31%" in text
