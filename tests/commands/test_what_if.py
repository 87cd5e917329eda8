"""`rsoccer what-if`."""

from dataclasses import replace
from pathlib import Path

import pytest

from rsoccer import cli
from rsoccer.replay import Replay, record_replay


@pytest.fixture
def recorded(tmp_path: Path) -> Path:
    teams = {"blue": "chase", "yellow": "zero"}
    replay = record_replay(
        "VSSSelfPlay-v0", teams, 3, 2.0, names=("CHASE", "ZERO"), snapshot_interval=1.0
    )
    return replay.save(tmp_path / "match.rsr")


def test_the_rest_of_a_match_is_played_by_another_policy(
    recorded: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page, saved = tmp_path / "other.html", tmp_path / "other.rsr"
    options = ["--at", "1.25", "--yellow", "chase", "--seconds", "0.5", "--matches", "2"]
    files = ["--html", str(page), "--save", str(saved)]
    assert cli.main(["what-if", str(recorded), *options, *files]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("recorded: CHASE : ZERO 0 : 0 in 0.5 s")
    assert printed[1].startswith("what if:  CHASE : CHASE 0 : 0 in 0.5 s (seed 0)")
    assert printed[3:] == ["mean of 2: 0.00 : 0.00", f"page: {page}", f"replay: {saved}"]
    other = Replay.load(saved)
    assert other.controllers["blue_0"] == other.controllers["yellow_0"] == "chase"
    assert other.seconds == 0.5
    assert page.read_text().startswith("<!doctype html>")


def test_a_replay_without_snapshots_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = record_replay("VSSSelfPlay-v0", {"all": "zero"}, 3, 1.0).save(tmp_path / "match.rsr")
    assert cli.main(["what-if", str(path), "--at", "0.5", "--blue", "ou", "--seconds", "0.1"]) == 0
    assert "no snapshot before this moment" in capsys.readouterr().out


@pytest.mark.parametrize("after", [0, 10])
@pytest.mark.parametrize("snapshots", [True, False])
def test_code_that_the_replay_names_is_not_run(
    *,
    recorded: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    after: int,
    snapshots: bool,
) -> None:
    (tmp_path / "code_of_the_file.py").write_text("open('imported', 'w').close()\n")
    monkeypatch.chdir(tmp_path)
    replay = Replay.load(recorded)
    at = f"{replay.clock[sorted(replay.snapshots)[1] + after]:g}"
    named = {robot: "code_of_the_file:player" for robot in replay.controllers if "blue" in robot}
    changed = replace(replay, controllers={**replay.controllers, **named})
    if not snapshots:
        changed = replace(changed, snapshots={})
    path = changed.save(tmp_path / "changed.rsr")
    assert cli.main(["what-if", str(path), "--at", at, "--yellow", "chase"]) == 2
    assert "code_of_the_file:player" in capsys.readouterr().err
    assert not (tmp_path / "imported").exists()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--at", "1"], "blue: expected another policy of blue or of yellow"),
        (["--at", "9", "--blue", "ou"], "at: expected 0 to 2 s, got 9"),
        (["--at", "1", "--blue", "ou", "--matches", "0"], "matches: expected 1 or more, got 0"),
        (["--at", "1", "--blue", "ou", "--save", "x.txt"], "save: expected a name ending in .rsr"),
        (["--at", "1", "--blue", "unknown"], "unknown policy 'unknown'"),
    ],
)
def test_wrong_words_are_refused(
    recorded: Path, options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["what-if", str(recorded), *options]) == 2
    assert message in capsys.readouterr().err
