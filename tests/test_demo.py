"""The demonstration of `make demo`, with a short task and a short video."""

import importlib
import json
from pathlib import Path
from typing import Any

import pytest

from rsoccer.registry import names as registry_names
from tests.train.short_task import NAME, register_all


def test_the_demo_writes_policies_metrics_and_pictures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for package in ("torch", "pygame", "imageio_ffmpeg", "matplotlib"):
        pytest.importorskip(package)
    demo: Any = importlib.import_module("rsoccer.demo")
    monkeypatch.setattr(registry_names, "_TASKS", dict(registry_names._TASKS))
    register_all()
    record_replay = demo.record_replay

    def record_briefly(*args: Any, **options: Any) -> Any:  # noqa: ANN401
        return record_replay(*args, **{**options, "seconds": 0.5})

    monkeypatch.setattr(demo, "TASK", NAME)
    monkeypatch.setattr(demo, "record_replay", record_briefly)
    metrics = demo.demo(tmp_path, samples=1, matches=2)  # rounded up to one update
    printed = capsys.readouterr().out
    assert json.loads((tmp_path / "metrics.json").read_text()) == metrics
    assert [evaluation["matches"] for evaluation in metrics["evaluations"]] == [2] * 4
    assert list(metrics["seconds"]) == ["training", "evaluation", "pictures"]
    assert (tmp_path / "untrained.safetensors").is_file()
    for name in ("policy.safetensors", "curve.png", "match.mp4", "match.html"):
        assert (tmp_path / name).stat().st_size > 1000
        assert str(tmp_path / name) in printed


def test_the_command_line_explains_itself_and_refuses_other_words(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Formerly `--help` trained for a minute."""
    for package in ("torch", "pygame", "imageio_ffmpeg", "matplotlib"):
        pytest.importorskip(package)
    demo: Any = importlib.import_module("rsoccer.demo")
    folders: list[Path] = []
    monkeypatch.setattr(demo, "demo", folders.append)
    for words, status in ((["--help"], 0), (["--samples", "1"], 2)):
        with pytest.raises(SystemExit) as stopped:
            demo.main(words)
        assert stopped.value.code == status
    assert "--out" in capsys.readouterr().out
    assert not folders
    demo.main([])
    demo.main(["--out", "elsewhere"])
    assert folders == [Path("out/demo"), Path("elsewhere")]
