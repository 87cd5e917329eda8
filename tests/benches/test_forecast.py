"""The benchmark of policies with delays and a forecast."""

import json
from pathlib import Path

import pytest

from benches import forecast
from rsoccer import Sensing


def test_each_delay_has_its_forecasts() -> None:
    conditions = forecast.conditions()
    assert conditions[forecast.EXACT] is None
    for name in forecast.DELAYS:
        late, own, both = (
            conditions[name + end] for end in ("", forecast.FORECAST, forecast.FORECAST_ALL)
        )
        assert late is not None and own is not None and both is not None
        assert (late.forecast, own.forecast, both.forecast) == (0.0, 1.0, 1.0)
        assert (own.forecast_others, both.forecast_others) == (0.0, 1.0)
        assert own.command_delay == both.command_delay == late.command_delay
        assert late.command_delay + late.delay > 0.0
    assert conditions["rc2021"] == Sensing("rc2021")


def test_scores_are_kept_and_printed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "results.json"
    late = "commands 25 ms late"
    words = ["--policy", "zero", "--matches", "2", "--tasks", "VSS-v0", "--results", str(path)]
    forecast.main([*words, "--conditions", forecast.EXACT])
    kept = json.loads(path.read_text())
    kept["VSS-v0"][forecast.EXACT] = {"score": 0.5, "low": 0.25, "high": 0.75}
    path.write_text(json.dumps(kept))
    capsys.readouterr()
    forecast.main([*words, "--conditions", forecast.EXACT, late])
    results = json.loads(path.read_text())["VSS-v0"]
    assert results[forecast.EXACT] == {"score": 0.5, "low": 0.25, "high": 0.75}, "kept"
    assert set(results) == {forecast.EXACT, late}
    printed = capsys.readouterr().out
    assert f"| {forecast.EXACT} | 0.5 (0.25 to 0.75) |" in printed
    assert late in printed


def test_unknown_conditions_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        forecast.main(["--conditions", "early"])
    assert "unknown ['early']" in capsys.readouterr().err
