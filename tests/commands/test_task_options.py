"""`--task-options` of the commands that play a task."""

import math
import re
from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.commands.task_options import RANDOMIZATION, named_task
from rsoccer.replay import Replay
from rsoccer.tasks import SslGoToBall

TURNED = ["--task-options", "velocity_frame=robot"]
PLAYED: dict[str, list[str]] = {
    "evaluate": ["best", "--task", "SSLGoToBall-v0", "--matches", "2", *TURNED],
    "watch": ["SSLGoToBall-v0", "--policy", "best", "--save", "match.rsr", *TURNED],
    "tournament": ["best", "ou", "--task", "SSLSelfPlay-v0", "--matches", "2", *TURNED],
}


def test_a_named_task_has_its_options() -> None:
    task = named_task("SSLGoToBall-v0", {"n_opponents": 2})
    assert isinstance(task, SslGoToBall)
    assert task.n_opponents == 2
    assert named_task(None, {}) is None


@pytest.mark.parametrize("command", PLAYED)
def test_a_command_plays_the_task_with_its_options(
    command: str,
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The trained policy fits the default axes alone."""
    monkeypatch.chdir(tmp_path)
    assert cli.main([command, *PLAYED[command]]) != 0
    assert "velocity in the robot's axes" in capsys.readouterr().err


@pytest.mark.parametrize("task", ["VSS-v0", "VSSMulti-v0"])
def test_a_number_in_the_place_of_a_policy_is_one_line(
    task: str, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["evaluate", "chase", "--task", task, "--task-options", "opponent=3", "--matches", "2"]
    assert cli.main(words) == 2
    error = capsys.readouterr().err
    assert error.startswith("rsoccer: task_options: opponent: expected a policy's name ")
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("word", "value"),
    [
        ("0.9,1.1", (0.9, 1.1)),
        ("normal,1.0,0.1", ("normal", 1.0, 0.1)),
        ("log_uniform, 0.5, 2", ("log_uniform", 0.5, 2)),
        ("['normal', 1.0, 0.1]", ["normal", 1.0, 0.1]),
        ("1.5", 1.5),
        ("normal,one,two", "normal,one,two"),
        ("1,inf", (1.0, math.inf)),
        ("inf", math.inf),
    ],
)
def test_distributions_as_words(word: str, value: object) -> None:
    read = RANDOMIZATION.instance_from_str([f"robot.mass={word}"])
    assert read == {"robot.mass": value}


def test_a_number_that_is_none_is_no_kind(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["evaluate", "chase", "--randomization", "robot.mass=nan,1"]) == 2
    message = "rsoccer: randomization['robot.mass']: expected two finite numbers, got (nan, 1.0)"
    assert message in capsys.readouterr().err


def test_a_recorded_match_has_them(tmp_path: Path) -> None:
    path = tmp_path / "match.rsr"
    watch = ["watch", "SSLGoToBall-v0", "--policy", "fetch", "--seconds", "0.5"]
    sizes = []
    for options in ([], ["--task-options", "n_opponents=2"]):
        assert cli.main([*watch, *options, "--save", str(path)]) == 0
        sizes.append(Replay.load(path).rows.shape[1])
    assert sizes[0] < sizes[1], "the state of two more robots"
    assert cli.main(["watch", str(path), "--task-options", "n_opponents=2"]) != 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--task-options", "n_opponents=2"], "task_options: expected --task with them"),
        (["--task", "SSLGoToBall-v0", "--task-options", "no_such=2"], "task_options: .*'no_such'"),
        (["--task", "SSLGoToBall-v0", "--task-options", "n_opponents"], "NAME=VALUE"),
        (["--task", "SSLGoToBall-v0", "--task-options", "n_opponents=99"], "n_opponents"),
    ],
)
def test_wrong_options_are_refused(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    try:
        status = cli.main(["evaluate", "fetch", "--matches", "2", *arguments])
    except SystemExit as error:  # of the parser
        status = int(error.code or 0)
    assert status != 0
    output = capsys.readouterr()
    assert re.search(message, output.err + output.out)
