"""What `make demo` runs, of a short task and with a short film."""

import importlib
import json
from pathlib import Path
from typing import Any

import pytest

from rsoccer import registry
from tests.train.short_task import NAME, register_all


def test_it_leaves_policies_figures_and_pictures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for package in ("torch", "pygame", "imageio_ffmpeg", "matplotlib"):
        pytest.importorskip(package)
    demo: Any = importlib.import_module("rsoccer.demo")
    monkeypatch.setattr(registry, "_TASKS", dict(registry._TASKS))
    register_all()
    record = demo.record_match

    def record_shortly(*given: Any, **options: Any) -> Any:  # noqa: ANN401
        return record(*given, **{**options, "seconds": 0.5})

    monkeypatch.setattr(demo, "TASK", NAME)
    monkeypatch.setattr(demo, "record_match", record_shortly)
    metrics = demo.demo(tmp_path, samples=1, matches=2)  # rounded up to one update
    said = capsys.readouterr().out
    assert json.loads((tmp_path / "metrics.json").read_text()) == metrics
    assert [evaluation["matches"] for evaluation in metrics["evaluations"]] == [2] * 4
    assert list(metrics["seconds"]) == ["training", "evaluation", "pictures"]
    assert (tmp_path / "untrained.safetensors").is_file()
    for name in ("policy.safetensors", "curve.png", "match.mp4"):
        assert (tmp_path / name).stat().st_size > 1000
        assert str(tmp_path / name) in said
