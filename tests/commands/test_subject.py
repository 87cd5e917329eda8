"""The policy and the task that the words of a command name."""

from pathlib import Path
from typing import Any

import pytest

import rsoccer
from rsoccer import cli
from rsoccer.commands.subject import team_name
from rsoccer.policies import trained
from tests.policies.networks import network_for


@pytest.mark.parametrize(
    ("words", "task", "policy"),
    [
        (["VSSSelfPlay-v0", "--policy", "best"], "VSSSelfPlay-v0", "best"),
        (["VSS-v0", "--policy", "best:mean"], "VSS-v0", "best:mean"),
        (["best", "--task", "VSSMulti-v0"], "VSSMulti-v0", "best"),
        (["--policy", "chase", "--task", "VSS-v0"], "VSS-v0", "chase"),
        (["--policy", "chase"], "VSSSelfPlay-v0", "chase"),
        (["best"], "VSSSelfPlay-v0", "best"),
        (["VSS-v0"], "VSS-v0", "best"),
        (["--task", "VSS-v0"], "VSS-v0", "best"),
        ([], "VSSSelfPlay-v0", "best"),
    ],
)
def test_watch_takes_a_task_and_a_policy_in_either_form(
    words: list[str], task: str, policy: str, filmed: list[Any]
) -> None:
    assert cli.main(["watch", *words, "--video", "never.mp4"]) == 0
    ((played, controllers, names),) = filmed
    assert (played, controllers["blue_0"]) == (task, policy)
    assert names[0] == policy.upper()


def test_a_task_without_a_trained_policy_is_played_by_a_script(
    filmed: list[Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(trained, "FOLDER", tmp_path)
    for task in ("VSSMulti-v0", "SSLStaticDefenders-v0"):
        assert cli.main(["watch", task, "--video", "never.mp4"]) == 0
    assert [controllers["blue_0"] for _, controllers, _ in filmed] == ["scripted", "strike"]


def test_takers_are_not_played_by_the_policy_of_keepers(filmed: list[Any]) -> None:
    options = ["--task-options", "learners=takers"]
    assert cli.main(["watch", "SSLKeepaway-v0", *options, "--video", "never.mp4"]) == 0
    ((_, controllers, _),) = filmed
    assert (controllers["blue_0"], controllers["yellow_0"]) == ("keep", "take")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["VSS-v0", "--task", "VSSMulti-v0"], "task: expected one task, got VSS-v0 and VSSMulti"),
        (["chase", "--policy", "ou"], "policy: expected a task before --policy ou, got chase"),
        (["VSS-v7"], "unknown task 'VSS-v7': expected one of"),
        (["VSS-v0", "--policy", "VSS-v0"], "unknown policy 'VSS-v0'"),
    ],
)
@pytest.mark.parametrize("command", ["watch", "evaluate"])
def test_contradictions_are_refused(
    command: str, words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main([command, *words]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


def test_evaluate_needs_a_policy_or_a_task(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["evaluate"]) == 2
    assert "policy: expected a policy or a task, got none" in capsys.readouterr().err


def test_evaluate_takes_a_task_and_a_policy_in_either_form(
    capsys: pytest.CaptureFixture[str],
) -> None:
    rows = []
    for words in (["best", "--task", "VSS-v0"], ["VSS-v0", "--policy", "best"], ["VSS-v0"]):
        assert cli.main(["evaluate", *words, "--matches", "2"]) == 0
        task, _, _, row = capsys.readouterr().out.splitlines()
        assert task == "VSS-v0"
        rows.append(row)
    assert len(set(rows)) == 1
    assert rows[0].split()[:3] == ["best", "ou", "2"]


def test_watch_and_evaluate_play_the_task_that_the_file_names(
    filmed: list[Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "policy.safetensors"
    network_for(rsoccer.make_task("SSLPassEndurance-v1")).save(file)
    assert cli.main(["watch", f"{file}:mean", "--video", "never.mp4"]) == 0
    ((task, controllers, names),) = filmed
    assert task == "SSLPassEndurance-v1"
    assert controllers == {"blue_0": f"{file}:mean", "blue_1": "receive"}
    assert names[1] == ""
    capsys.readouterr()
    assert cli.main(["evaluate", str(file), "--matches", "3"]) == 0
    task, _, header, row = capsys.readouterr().out.splitlines()
    assert task == "SSLPassEndurance-v1"
    assert header.split()[:4] == ["policy", "opponent", "matches", "received"]
    assert row.split()[:3] == [str(file), "-", "3"]


@pytest.mark.parametrize(
    ("player", "shown"),
    [("scripted:0.5", "SCRIPTED:0.5"), ("ou", "OU"), ("out/mine/policy.safetensors", "MINE")],
)
def test_the_scoreboard_names_the_policies(player: str, shown: str) -> None:
    assert team_name(player) == shown
