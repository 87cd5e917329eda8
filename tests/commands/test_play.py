"""`rsoccer play`."""

import subprocess
import sys
from typing import Any, Self

import pytest

import rsoccer
from rsoccer import cli
from tests.commands.running import run


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Replace the session by a record of the task, the controllers and the robot."""
    session = pytest.importorskip("rsoccer.human.session")
    played: list[Any] = []

    class Recorded:
        def __init__(self, task: rsoccer.Task, *teams: Any, names: Any, **_: Any) -> None:  # noqa: ANN401
            played.append((task.name, *teams, names))

        def __enter__(self) -> Self:
            return self

        def __exit__(self, *_: object) -> None:
            played.append("closed")

        def run(self, seconds: float) -> None:
            played.append(seconds)

    monkeypatch.setattr(session, "Session", Recorded)
    return played


@pytest.mark.parametrize("task", ["VSSSelfPlay-v0", "SSLSelfPlay-v0"])
def test_play_opens_a_window_for_some_seconds(task: str) -> None:
    pytest.importorskip("pygame")
    arguments = ["play", task, "--robot", "yellow_1", "--controllers", "blue=zero", "yellow_0=zero"]
    done = run(*arguments, "--seconds", "1.5", "--width", "128", SDL_VIDEODRIVER="dummy")
    assert (done.returncode, done.stderr) == (0, "")


def test_play_without_a_display_says_so() -> None:
    pytest.importorskip("pygame")
    hidden = dict.fromkeys(("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"), "")
    done = run("play", "VSS-v0", "--seconds", "0.1", "--width", "128", **hidden)
    assert done.returncode == 2
    assert "no display to open a window on" in done.stderr


def test_play_without_pygame_says_so() -> None:
    code = (
        "import sys; sys.modules['pygame'] = None; from rsoccer.cli import main; "
        "sys.exit(main(['play', 'VSS-v0']))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "pip install 'rsoccer[render]'" in done.stderr


def test_play_gives_the_policies_to_the_other_robots(played: list[Any]) -> None:
    arguments = ["play", "VSSSelfPlay-v0", "--robot", "yellow_1", "--policy", "chase"]
    arguments += ["--opponents", "ou", "--controllers", "blue_2=zero", "--seconds", "3"]
    assert cli.main(arguments) == 0
    (name, controllers, robot, names), seconds, end = played
    assert (name, robot, seconds, end) == ("VSSSelfPlay-v0", "yellow_1", 3.0, "closed")
    assert names == ("OU ZERO", "YOU")
    assert controllers == {
        **{f"yellow_{i}": "chase" for i in range(3)},
        **{f"blue_{i}": "ou" for i in range(2)},
        "blue_2": "zero",
    }


def test_play_begins_with_the_first_learner(played: list[Any]) -> None:
    assert cli.main(["play", "SSLContestedPossession-v0", "--controllers", "yellow=zero"]) == 0
    (_, controllers, robot, names), *_ = played
    assert robot == "blue_0"
    assert names == ("YOU", "ZERO")
    assert controllers == {"blue_0": "strike", "yellow_0": "zero"}


def test_play_refuses_two_controllers_of_one_name(capsys: pytest.CaptureFixture[str]) -> None:
    """Formerly only the last one drove."""
    pytest.importorskip("pygame")
    entries = ["yellow_0=zero", "blue_1=ou", "yellow_0=ou"]
    assert cli.main(["play", "VSSSelfPlay-v0", "--controllers", *entries]) == 2
    message = "controllers: expected each name once, got 'yellow_0' 2 times"
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("entry", ["blue_0", "blue_0=", "=zero"])
def test_play_refuses_a_controller_without_a_name_or_policy(
    entry: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pygame")
    assert cli.main(["play", "VSS-v0", "--controllers", entry]) == 2
    assert f"controllers: expected NAME=POLICY, got {entry!r}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--robot", "red_1"], "robot: expected one of"),
        (["--controllers", "red=zero"], "controllers: expected a robot, a team or all"),
        (["--speed", "0"], "speed: expected a positive number"),
    ],
)
def test_play_refuses_wrong_options(
    arguments: list[str], text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pygame")
    assert cli.main(["play", "VSS-v0", *arguments]) == 2
    assert text in capsys.readouterr().err
