"""`rsoccer train`: the settings that it passes on."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import pytest

from rsoccer import cli
from rsoccer.commands import train as train_command
from rsoccer.train import Args, PpoSettings, RunSettings, task_settings


def test_train_passes_its_options_on(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Any] = []

    def record(args: Args) -> Path:
        received.append(args)
        return args.out / "policy.safetensors"

    monkeypatch.setattr(train_command, "train", record)
    options = [
        "--out",
        "there",
        "--samples",
        "5",
        "--network.hidden-sizes",
        "8",
        "9",
        "--seed",
        "3",
    ]
    assert cli.main(["train", *options, "--run.no-progress"]) == 0
    (args,) = received
    assert (args.out, args.samples, args.network.hidden_sizes) == (Path("there"), 5, (8, 9))
    assert (args.run.progress, args.resume, args.seed) == (False, False, 3)
    assert json.dumps(args.to_json())
    assert "there/policy.safetensors" in capsys.readouterr().out


def test_train_takes_options_of_the_task(monkeypatch: pytest.MonkeyPatch) -> None:
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    words = ["n_blue=2", "opponent=scripted:0.5", "reward_weights={'goal': 3}", "discrete=False"]
    assert cli.main(["train", "--task-options", *words, "--network.final-action-std", "0.3"]) == 0
    assert received[0].task_options == {
        "n_blue": 2,
        "opponent": "scripted:0.5",
        "reward_weights": {"goal": 3},
        "discrete": False,
    }
    assert received[0].network.final_action_std == 0.3
    assert cli.main(["train"]) == 0
    assert received[1].task_options == {}


@pytest.mark.parametrize("task", ["VSSMulti-v0", "VSS-v0"])
def test_train_takes_policies_with_their_shares(task: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Formerly a recommended mix of opponents could not be replaced."""
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    recommended = {"VSS-v0": {"opponents.fixed": {"ou": 2.0, "zero": 1.0}}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", recommended)
    words = ["--opponents", "chase", "1", "scripted:0.5", "3"]
    assert cli.main(["train", "--task", task, *words]) == 0
    assert received[0].opponents.fixed == {"chase": 1.0, "scripted:0.5": 3.0}
    assert cli.main(["train", "--task", task, "--opponents"]) == 0
    assert received[1].opponents.fixed == {}
    assert cli.main(["train", "--task", task]) == 0
    assert received[2].opponents.fixed == recommended.get(task, {}).get("opponents.fixed", {})


def test_train_refuses_policies_without_shares(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.main(["train", "--opponents", "ou"])
    assert "pairs of POLICY and SHARE" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "option", "name"),
    [
        (["--opponents", "ou", "1", "zero", "1", "ou", "5"], "--opponents", "'ou'"),
        (["--task-options", "max_steps=100", "max_steps=200"], "--task-options", "'max_steps'"),
    ],
)
def test_train_refuses_repeated_names(
    words: list[str], option: str, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Formerly only the last one counted."""
    with pytest.raises(SystemExit) as exit_:
        cli.main(["train", *words])
    assert exit_.value.code == 2
    printed = capsys.readouterr().err
    assert option in printed
    assert f"expected each name once, got {name}" in " ".join(printed.replace("│", "").split())


@pytest.mark.parametrize("words", [["--task", "VSS-v0"], ["--task=VSS-v0"]])
def test_train_starts_from_the_recommended_settings(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    settings = {
        "ppo.gamma": 0.5,
        "network.hidden_sizes": (7, 7),
        "task_options": {"opponent": "chase"},
    }
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", {"VSS-v0": settings})
    assert cli.main(["train", *words]) == 0
    assert cli.main(["train", "--network.hidden-sizes", "9", *words]) == 0
    assert cli.main(["train"]) == 0
    first, second, third = received
    assert (first.task, first.ppo.gamma, first.network.hidden_sizes) == ("VSS-v0", 0.5, (7, 7))
    assert first.task_options == {"opponent": "chase"}
    assert (second.ppo.gamma, second.network.hidden_sizes) == (0.5, (9,))
    assert (third.task, third.ppo.gamma) == ("VSSSelfPlay-v0", PpoSettings.gamma)
    with pytest.raises(SystemExit):
        cli.main(["train", *words, "--help"])
    assert "(default: 0.5)" in capsys.readouterr().out


def test_train_refuses_an_option_without_a_value(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.main(["train", "--task-options", "n_blue"])
    assert "expected NAME=VALUE" in capsys.readouterr().err


@pytest.mark.parametrize(("word", "value"), [("--ppo.", True), ("--ppo.no-", False)])
@pytest.mark.parametrize("recommended", [True, False])
def test_a_switch_has_both_forms_whatever_is_recommended(
    word: str, value: bool, recommended: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    settings = {"VSS-v0": {"ppo.mirror_augmentation": recommended}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", settings)
    assert cli.main(["train", "--task", "VSS-v0", f"{word}mirror-augmentation"]) == 0
    assert received[0].ppo.mirror_augmentation is value


def test_resuming_takes_the_settings_of_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Formerly all options had to be repeated."""
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    own = (
        "--network.hidden-sizes",
        "9",
        "--opponents",
        "ou",
        "2",
        "--task-options",
        "n_blue=2",
    )
    began = ["--task", "VSS-v0", "--samples", "5", "--overwrite", "--run.no-progress", *own]
    out = ["--out", str(tmp_path)]
    assert cli.main(["train", *out, *began]) == 0
    (before,) = received
    (tmp_path / "args.json").write_text(json.dumps(before.to_json()))
    assert cli.main(["train", "--resume", *out]) == 0
    assert cli.main(["train", f"--out={tmp_path}", "--samples", "7", "--resume"]) == 0
    assert cli.main(["train", *out, "--resume", "--no-resume"]) == 0
    _, resumed, longer, new = received
    assert before.task == "VSS-v0"
    assert resumed == dataclasses.replace(before, resume=True, overwrite=False, run=RunSettings())
    assert longer == dataclasses.replace(resumed, samples=7)
    assert (new.task, new.network) == (Args.task, Args.for_task(Args.task).network)


@pytest.mark.parametrize(
    "content", [None, "{", "[]", '{"n_brains": 2}', '{"ppo.gamma": 7}', '{"gamma": 0.9}']
)
def test_resuming_without_usable_settings_has_the_recommended_ones(
    content: str | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The error is that of the checkpoint."""
    pytest.importorskip("torch")
    if content is not None:
        (tmp_path / "args.json").write_text(content)
    assert cli.main(["train", "--out", str(tmp_path), "--resume"]) == 2
    assert "there is no run to resume" in capsys.readouterr().err
