"""An ONNX file as an opponent in training."""

from pathlib import Path

from rsoccer.train import train
from tests.policies.networks import network_for
from tests.train.runs import progress
from tests.train.short_task import ShortSelfPlay, tiny


def test_a_run_meets_an_onnx_file(tmp_path: Path) -> None:
    file = tmp_path / "other.onnx"
    network_for(ShortSelfPlay()).save_onnx(file)
    train(tiny(tmp_path / "run", fixed={str(file): 1.0}, latest_fraction=0.0, past_fraction=0.0))
    columns = [name for name in progress(tmp_path / "run")[-1] if "other" in name]
    assert any(name.startswith("episode_") for name in columns)
