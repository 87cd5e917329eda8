"""`rsoccer evolve`: its options are the settings, recommended ones by default."""

import dataclasses
import json
import shlex
from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.commands import evolve as evolve_command
from rsoccer.train.evolution import EvolveArgs
from rsoccer.train.evolution.settings import STATE_FILE
from tools.ship_policy import command_of


@pytest.mark.parametrize("task", ["SSLMatch-v0", "SSLKeepaway-v0"])
def test_defaults_are_those_recommended_for_the_task(
    task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    assert cli.main(["evolve", "--task", task]) == 0
    assert received[0].to_json() == EvolveArgs.for_task(task).to_json()


def test_the_recorded_command_has_the_settings_of_the_run(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    changed = EvolveArgs("SSLMatch-v0", sensing="rc2021, delay=0.1", matches=20, first="best")
    for args in (changed, EvolveArgs.for_task("SSLMatch-v0", seed=3)):
        command = command_of(args.to_json())
        assert command.startswith("rsoccer evolve --task SSLMatch-v0 --script scripted ")
        assert cli.main(shlex.split(command)[1:]) == 0
        assert received[-1].to_json() == args.to_json()


def test_resuming_takes_the_settings_of_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Formerly all options had to be repeated."""
    received: list[EvolveArgs] = []
    monkeypatch.setattr(evolve_command, "evolve", received.append)
    own = ["--matches", "20", "--task-options", "n_blue=2", "--opponents", "zero"]
    own += ["--randomization", "robot.mass=0.9,1.1", "--sensing", "rc2021"]
    out = ["--out", str(tmp_path)]
    assert cli.main(["evolve", "--task", "SSLMatch-v0", *out, *own]) == 0
    (before,) = received
    (tmp_path / STATE_FILE).write_text(json.dumps({"settings": before.to_json()}))
    assert cli.main(["evolve", "--resume", *out]) == 0
    assert cli.main(["evolve", f"--out={tmp_path}", "--generations", "30", "--resume"]) == 0
    assert cli.main(["evolve", *out, "--resume", "--no-resume"]) == 0
    _, resumed, longer, new = received
    assert resumed.to_json() == dataclasses.replace(before, resume=True).to_json()
    assert longer.to_json() == dataclasses.replace(before, resume=True, generations=30).to_json()
    assert new.to_json() == EvolveArgs.for_task(EvolveArgs.task, out=tmp_path).to_json()


@pytest.mark.parametrize("content", [None, "{", "[]", "{}", '{"settings": {"matches": 7}}'])
def test_resuming_without_usable_settings_reports_the_state(
    content: str | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("safetensors")
    if content is not None:
        (tmp_path / STATE_FILE).write_text(content)
    assert cli.main(["evolve", "--out", str(tmp_path), "--resume"]) == 2
    assert f"resume: {'expected the state' if content is None else ''}" in capsys.readouterr().err
