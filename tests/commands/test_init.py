"""The commands in common."""

import pytest

from rsoccer import cli
from tests.commands.running import run


def test_the_module_runs_as_the_command() -> None:
    done = run("list")
    assert done.returncode == 0
    assert "VSSSelfPlay-v0" in done.stdout


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ([], ["list", "train", "evaluate", "watch", "play", "Robot soccer"]),
        (["train"], ["--samples", "decisions of all learning robots", "--resume"]),
        (
            ["evaluate"],
            [
                "POLICY|TASK",
                "--policy POLICY",
                "--opponents",
                "half of them as blue",
                "--json PATH",
            ],
        ),
        (
            ["watch"],
            [
                "POLICY|TASK|REPLAY",
                "--policy POLICY",
                "--video PATH",
                "needs no display",
                "--html",
                "--save",
            ],
        ),
        (["play"], ["TASK", "--robot ROBOT", "--controllers", "keyboard or gamepad"]),
    ],
)
def test_help_describes_the_options(
    command: list[str], words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as exit_:
        cli.main([*command, "--help"])
    assert exit_.value.code == 0
    printed = " ".join(capsys.readouterr().out.replace("│", " ").split())
    for word in words:
        assert word in printed
