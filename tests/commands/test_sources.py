"""`--simulator` and `--sensing` of all commands that play matches."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rsoccer import cli
from rsoccer.replay import Replay
from rsoccer.sources import make_sensing, make_simulator

SIMULATOR, SENSING = "tests.simulators:Still", "tests.simulators:Blind"
WORDS = {
    "evaluate": ["evaluate", "chase", "--opponents", "zero", "--matches", "2"],
    "tournament": ["tournament", "chase", "zero", "--matches", "2"],
    "watch": ["watch", "chase", "--opponents", "zero", "--seconds", "0.5"],
    "play": ["play", "VSSSelfPlay-v0", "--seconds", "0.01", "--width", "128"],
}
FILES = {"evaluate --save": ("evaluate", "--save", "match.rsr")}
FILES["watch --save"] = ("watch", "--save", "match.rsr")
FILES["watch --video"] = ("watch", "--video", "match.gif")


@pytest.fixture
def used(monkeypatch: pytest.MonkeyPatch) -> set[tuple[str, Any]]:
    """Note which simulators and senses matches are made with."""
    used: set[tuple[str, Any]] = set()

    def simulator(source: Any, *given: Any) -> Any:  # noqa: ANN401
        used.add(("simulator", source))
        return make_simulator(source, *given)

    def sensing(source: Any) -> Any:  # noqa: ANN401
        used.add(("sensing", source))
        return make_sensing(source)

    monkeypatch.setattr("rsoccer.matches.loop.make_simulator", simulator)
    monkeypatch.setattr("rsoccer.matches.loop.make_sensing", sensing)
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    return used


@pytest.mark.parametrize("case", [*WORDS, *FILES])
def test_a_command_plays_with_what_it_names(
    case: str, used: set[tuple[str, Any]], tmp_path: Path
) -> None:
    if case in ("play", "watch --video", "watch"):
        pytest.importorskip("pygame")
    command, *file = FILES.get(case, (case,))
    words = [*WORDS[command], "--simulator", SIMULATOR, "--sensing", SENSING]
    if file:
        words += [file[0], str(tmp_path / file[1])]
    if case == "watch":
        words += ["--speed", "10", "--width", "128"]
    assert cli.main(words) == 0
    assert used == {("simulator", SIMULATOR), ("sensing", SENSING)}


@pytest.mark.parametrize("command", ["evaluate", "watch"])
def test_a_recorded_match_shows_what_the_simulator_did(command: str, tmp_path: Path) -> None:
    file = tmp_path / "match.rsr"
    assert cli.main([*WORDS[command], "--simulator", SIMULATOR, "--save", str(file)]) == 0
    replay = Replay.load(file)
    assert len(replay) > 10
    moved = replay.frame.robots.position - replay.frame.robots.position[0]
    assert np.abs(moved[:200]).max() < 0.02  # a restart of play moves robots later
    assert np.abs(replay.commands).max() > 1.0, "the robots were commanded to move"


@pytest.mark.parametrize("command", WORDS)
@pytest.mark.parametrize(
    ("option", "text", "message"),
    [
        (
            "simulator",
            "still",
            "simulator: expected grsim, firasim, ssl-simulation or a text 'module:name', got ",
        ),
        (
            "simulator",
            "tests.simulators:no",
            "simulator: the module 'tests.simulators' has no 'no'",
        ),
        ("simulator", "tests.simulators:NOTHING", "simulator: expected a simulator, a function"),
        ("sensing", "tests.simulators:NOTHING", "sensing: expected a rsoccer.Sensing"),
    ],
)
def test_a_text_that_names_neither_is_reported_in_a_line(
    command: str, option: str, text: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if command in ("play", "watch"):
        pytest.importorskip("pygame")
    assert cli.main([*WORDS[command], f"--{option}", text]) == cli.WRONG_INPUT
    error = capsys.readouterr().err
    assert error.startswith(f"rsoccer: {message}")
    assert error.count("\n") == 1


def test_train_reports_senses_that_are_none_in_a_line(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["train", "--sensing", "tests.simulators:NOTHING", "--out", "never"]
    assert cli.main(words) == cli.WRONG_INPUT
    assert capsys.readouterr().err.startswith("rsoccer: sensing: expected a rsoccer.Sensing")


@pytest.mark.parametrize("option", ["simulator", "sensing"])
def test_watch_refuses_both_for_a_replay(option: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["watch", "match.rsr", f"--{option}", SIMULATOR]) == cli.WRONG_INPUT
    assert f"{option}: expected none for a replay, got {SIMULATOR}" in capsys.readouterr().err
