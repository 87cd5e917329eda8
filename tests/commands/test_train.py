"""`rsoccer train`: the settings that it passes on."""

import json
from pathlib import Path
from typing import Any

import pytest

from rsoccer import cli
from rsoccer.commands import train as train_command
from rsoccer.train import Args, task_settings


def test_train_passes_its_options_on(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Any] = []

    def record(args: Args) -> Path:
        received.append(args)
        return args.out / "policy.safetensors"

    monkeypatch.setattr(train_command, "train", record)
    options = ["--out", "there", "--samples", "5", "--hidden-sizes", "8", "9", "--seed", "3"]
    assert cli.main(["train", *options, "--no-progress"]) == 0
    (args,) = received
    assert (args.out, args.samples, args.hidden_sizes) == (Path("there"), 5, (8, 9))
    assert (args.progress, args.resume, args.seed) == (False, False, 3)
    assert json.dumps(args.to_json())
    assert "there/policy.safetensors" in capsys.readouterr().out


def test_train_takes_options_of_the_task(monkeypatch: pytest.MonkeyPatch) -> None:
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    words = ["n_blue=2", "opponent=scripted:0.5", "reward_weights={'goal': 3}", "discrete=False"]
    assert cli.main(["train", "--task-options", *words, "--final-action-std", "0.3"]) == 0
    assert received[0].task_options == {
        "n_blue": 2,
        "opponent": "scripted:0.5",
        "reward_weights": {"goal": 3},
        "discrete": False,
    }
    assert received[0].final_action_std == 0.3
    assert cli.main(["train"]) == 0
    assert received[1].task_options == {}


@pytest.mark.parametrize("task", ["VSSMulti-v0", "VSS-v0"])
def test_train_takes_policies_with_their_shares(task: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Formerly a recommended mix of opponents could not be replaced."""
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    recommended = {"VSS-v0": {"opponents": {"ou": 2.0, "zero": 1.0}}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", recommended)
    assert (
        cli.main(["train", "--task", task, "--opponents", "chase", "1", "scripted:0.5", "3"]) == 0
    )
    assert received[0].opponents == {"chase": 1.0, "scripted:0.5": 3.0}
    assert cli.main(["train", "--task", task, "--opponents"]) == 0
    assert received[1].opponents == {}
    assert cli.main(["train", "--task", task]) == 0
    assert received[2].opponents == recommended.get(task, {}).get("opponents", {})


def test_train_refuses_policies_without_shares(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.main(["train", "--opponents", "ou"])
    assert "pairs of POLICY and SHARE" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "option", "name"),
    [
        (["--opponents", "ou", "1", "zero", "1", "ou", "5"], "--opponents", "'ou'"),
        (["--teammates", "zero", "1", "zero", "1", "zero", "1"], "--teammates", "'zero'"),
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
    settings = {"gamma": 0.5, "hidden_sizes": (7, 7), "task_options": {"opponent": "chase"}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", {"VSS-v0": settings})
    assert cli.main(["train", *words]) == 0
    assert cli.main(["train", "--hidden-sizes", "9", *words]) == 0
    assert cli.main(["train"]) == 0
    first, second, third = received
    assert (first.task, first.gamma, first.hidden_sizes) == ("VSS-v0", 0.5, (7, 7))
    assert first.task_options == {"opponent": "chase"}
    assert (second.gamma, second.hidden_sizes) == (0.5, (9,))
    assert (third.task, third.gamma) == ("VSSSelfPlay-v0", Args.gamma)
    with pytest.raises(SystemExit):
        cli.main(["train", *words, "--help"])
    assert "(default: 0.5)" in capsys.readouterr().out


def test_train_refuses_an_option_without_a_value(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.main(["train", "--task-options", "n_blue"])
    assert "expected NAME=VALUE" in capsys.readouterr().err


@pytest.mark.parametrize(("word", "value"), [("--", True), ("--no-", False)])
@pytest.mark.parametrize("recommended", [True, False])
def test_a_switch_has_both_forms_whatever_is_recommended(
    word: str, value: bool, recommended: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[Any] = []
    monkeypatch.setattr(train_command, "train", received.append)
    settings = {"VSS-v0": {"mirror_augmentation": recommended}}
    monkeypatch.setattr(task_settings, "TASK_SETTINGS", settings)
    assert cli.main(["train", "--task", "VSS-v0", f"{word}mirror-augmentation"]) == 0
    assert received[0].mirror_augmentation is value
