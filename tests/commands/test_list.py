"""`rsoccer list`."""

import subprocess
import sys
from pathlib import Path

import pytest

import rsoccer
from rsoccer import cli
from rsoccer.policies import trained, training_conditions
from rsoccer.registry import names as registry_names
from rsoccer.tasks import VssSelfPlay
from tests.policies.networks import network_for


def test_list_names_tasks_options_and_policies(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["list"]) == 0
    printed = capsys.readouterr().out
    for name in [*rsoccer.list_tasks(), "max_steps=1200", "opponent='ou'", "chase", "scripted:0.5"]:
        assert name in printed


def test_list_shows_the_scores_of_trained_policies(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["list"]) == 0
    printed = capsys.readouterr().out
    assert "free_ball=False" in printed
    for name, path in trained.list_trained().items():
        score = trained.list_scores(path)[0]
        assert f"{name}: {score.metric} {score.score:.3f} ({score.low:.3f} to " in printed
    assert trained.list_trained()


def test_list_shows_the_senses_and_varied_numbers_of_a_training(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    network = network_for(rsoccer.make_task("VSS-v0"))
    network.metadata |= training_conditions.written("vsss", {"robot.mass": (0.9, 1.1)})
    network.save(tmp_path / "VSS-v0.safetensors")
    monkeypatch.setattr(trained, "FOLDER", tmp_path)
    assert cli.main(["list"]) == 0
    printed = capsys.readouterr().out
    assert "    VSS-v0: not measured\n" in printed
    assert "    VSS-v0: made for matches with sensing vsss, robot.mass 0.9 to 1.1\n" in printed


def test_a_task_whose_options_have_no_defaults_is_listed(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Formerly it ended the list with a TypeError."""

    class Sized(VssSelfPlay):
        """A match of as many robots as are asked for."""

        def __init__(self, robots: int) -> None:
            super().__init__(n_blue=robots, n_yellow=robots)

    monkeypatch.setattr(registry_names, "_TASKS", dict(registry_names._TASKS))
    rsoccer.register("Sized-v0", Sized)
    assert cli.main(["list"]) == 0
    shown = "Sized-v0: A match of as many robots as are asked for.\n    robots\n"
    assert shown in capsys.readouterr().out


def test_list_and_help_import_no_heavy_package() -> None:
    code = (
        "import sys; from rsoccer.cli import main; main(['list'])\n"
        "try: main(['train', '--help'])\n"
        "except SystemExit: pass\n"
        "sys.exit(','.join({'torch', 'pygame', 'matplotlib', 'PIL'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "--ppo.learning-rate" in done.stdout
