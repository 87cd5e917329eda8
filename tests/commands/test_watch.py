"""`rsoccer watch`."""

from pathlib import Path
from typing import Any

import pytest

from rsoccer import Matches, Sensing, cli
from rsoccer.replay import Recorder, Replay, record_replay
from tests.commands.running import run


@pytest.mark.parametrize("name", ["match.mp4", "match.gif"])
def test_watch_writes_a_video_without_a_display(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pygame")
    file = tmp_path / name
    arguments = ["watch", "chase", "--seconds", "0.5", "--width", "128", "--video", str(file)]
    assert cli.main(arguments) == 0
    assert str(file) in capsys.readouterr().out
    assert file.stat().st_size > 1000


def test_watch_keeps_the_tasks_own_opponents(filmed: list[Any]) -> None:
    arguments = ["watch", "strike", "--task", "SSLContestedPossession-v0", "--video", "never.mp4"]
    assert cli.main(arguments) == 0
    assert cli.main([*arguments, "--opponents", "zero"]) == 0
    assert cli.main(["watch", "scripted", "--video", "never.mp4"]) == 0
    (_, default, names), (_, changed, _), (task, controllers, _) = filmed
    assert default == {"blue_0": "strike", "yellow_0": "hold"}
    assert names == ("STRIKE", "HOLD")
    assert changed == {"blue_0": "strike", "yellow_0": "zero"}
    assert task == "VSSSelfPlay-v0"
    assert set(controllers.values()) == {"scripted", "ou"}


def test_whole_matches_are_watched_between_sides_that_obey_the_referee(filmed: list[Any]) -> None:
    for task in ("SSLMatch-v0", "VSSMatch-v0"):
        assert cli.main(["watch", task, "--video", "never.mp4"]) == 0
        assert cli.main(["watch", task, "--opponents", "zero", "--video", "never.mp4"]) == 0
        (name, default, names), (_, changed, _) = filmed[-2:]
        assert (name, names) == (task, ("BEST", "SCRIPTED"))
        assert set(default.values()) == {"best", "scripted"}
        assert set(changed.values()) == {"best", "zero"}


def test_watch_opens_a_window() -> None:
    pytest.importorskip("pygame")
    arguments = ["watch", "chase", "--opponents", "zero", "--seconds", "0.5", "--speed", "10"]
    done = run(*arguments, "--width", "128", SDL_VIDEODRIVER="dummy")
    assert (done.returncode, done.stderr) == (0, "")


def test_watch_saves_a_replay_and_plays_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pygame")
    saved, page, video = (tmp_path / f"match.{kind}" for kind in ("rsr", "html", "gif"))
    made = ["watch", "chase", "--seconds", "0.5", "--snapshots", "0.25", "--save", str(saved)]
    assert cli.main(made) == 0
    replay = Replay.load(saved)
    assert (replay.seconds, replay.names, list(replay.snapshots)) == (
        0.5,
        ("CHASE", "OU"),
        [0, 10, 20],
    )
    assert f"replay: {saved} (" in capsys.readouterr().out
    played = ["watch", str(saved), "--video", str(video), "--html", str(page), "--width", "128"]
    assert cli.main(played) == 0
    printed = capsys.readouterr().out
    assert printed.splitlines() == [f"page: {page}", f"video: {video}"]
    assert video.stat().st_size > 1000
    assert page.read_text() == replay.to_html()


def test_watch_leaves_out_ghosts_on_request(tmp_path: Path) -> None:
    pytest.importorskip("pygame")
    saved = tmp_path / "match.rsr"
    match = ["watch", "chase", "--seconds", "0.5", "--sensing", "vsss"]
    assert cli.main([*match, "--save", str(saved)]) == 0
    assert Replay.load(saved).sensing == Sensing("vsss")
    for name, options in {"replay": ["watch", str(saved)], "match": match}.items():
        shown, plain = (tmp_path / f"{name}_{kind}.gif" for kind in ("shown", "plain"))
        small = ["--width", "128"]
        assert cli.main([*options, *small, "--video", str(shown)]) == 0
        assert cli.main([*options, *small, "--no-ghosts", "--video", str(plain)]) == 0
        assert shown.read_bytes() != plain.read_bytes()


def test_watch_plays_a_replay_in_a_window(tmp_path: Path) -> None:
    pytest.importorskip("pygame")
    saved = record_replay(controllers={"all": "zero"}, seconds=0.3).save(tmp_path / "match.rsr")
    done = run("watch", str(saved), "--speed", "10", "--width", "128", SDL_VIDEODRIVER="dummy")
    assert (done.returncode, done.stderr, done.stdout) == (0, "", "")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--html", "match.txt"], "html: expected a name ending in .html, got match.txt"),
        (["--save", "match.html"], "save: expected a name ending in .rsr, got match.html"),
        (["--save", "absent/match.rsr"], "save: expected a file in a folder that exists"),
        (
            ["--save", "match.rsr", "--snapshots", "0"],
            " snapshots: expected a positive number, got 0",
        ),
        (["--save", "match.rsr", "--snapshots", "-1"], " snapshots: expected a positive number"),
        (["--snapshots", "5"], "snapshots: expected none without --save, got 5.0"),
    ],
)
def test_watch_refuses_files_that_it_cannot_write(
    options: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["watch", "chase", *options]) == 2
    assert message in capsys.readouterr().err


def test_watch_refuses_bad_replays_and_options_of_matches(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "match.rsr"
    file.write_bytes(b"something else")
    assert cli.main(["watch", str(file)]) == 2
    assert "match.rsr is not a usable replay: magic" in capsys.readouterr().err
    assert cli.main(["watch", str(file), "--opponents", "ou"]) == 2
    assert "opponents: expected none for a replay, got ou" in capsys.readouterr().err
    for words in (["--seed", "5"], ["--seconds", "3"]):
        assert cli.main(["watch", str(file), *words]) == 2
        expected = f"{words[0][2:]}: expected no other than the replay's own"
        assert expected in capsys.readouterr().err


def test_watch_saves_a_replay_of_one_frame(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    matches = Matches("VSS-v0", autoreset="disabled")
    recorder = Recorder(matches)
    matches.reset()
    recorder.begin()
    recorder.replay().save(tmp_path / "one.rsr")
    saved = tmp_path / "again.rsr"
    assert cli.main(["watch", str(tmp_path / "one.rsr"), "--save", str(saved)]) == 0
    assert len(Replay.load(saved)) == 1
    assert f"replay: {saved} (" in capsys.readouterr().out


@pytest.mark.parametrize("speed", ["0", "-1", "nan"])
def test_watch_refuses_a_speed_that_is_not_positive(
    speed: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["watch", "--speed", speed]) == 2
    assert "speed" in capsys.readouterr().err
