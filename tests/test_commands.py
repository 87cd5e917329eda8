"""Commands: what they print, write, and pass on."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import rsoccer
from rsoccer import cli, commands
from rsoccer.policies import trained
from rsoccer.replay import Replay, record_replay
from rsoccer.train import Args, task_settings
from tests.policies.networks import network_for


def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """Run a command in a new process, as a shell does."""
    return subprocess.run(
        [sys.executable, "-m", "rsoccer", *arguments],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, **environment},
        check=False,
    )


# -- list -------------------------------------------------------------------------------------


def test_list_names_tasks_options_and_policies(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["list"]) == 0
    printed = capsys.readouterr().out
    for name in [*rsoccer.list_tasks(), "max_steps=1200", "opponent='ou'", "chase", "scripted:0.5"]:
        assert name in printed


def test_list_shows_the_scores_of_trained_policies(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["list"]) == 0
    printed = capsys.readouterr().out
    assert "free_ball=False" in printed
    for name, path in trained.list_trained().items():
        score = trained.list_scores(path)[0]
        assert f"{name}: {score.metric} {score.score:.3f} ({score.low:.3f} to " in printed
    assert trained.list_trained()


def test_list_and_help_import_no_heavy_package() -> None:
    code = (
        "import sys; from rsoccer.cli import main; main(['list'])\n"
        "try: main(['train', '--help'])\n"
        "except SystemExit: pass\n"
        "sys.exit(','.join({'torch', 'pygame', 'matplotlib', 'PIL'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "--learning-rate" in done.stdout


def test_the_module_runs_as_the_command() -> None:
    done = run("list")
    assert done.returncode == 0
    assert "VSSSelfPlay-v0" in done.stdout


# -- help -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ([], ["list", "train", "evaluate", "watch", "play", "Robot soccer"]),
        (["train"], ["--samples", "decisions to learn from", "--resume"]),
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


# -- evaluate ---------------------------------------------------------------------------------


def test_evaluate_prints_a_table_and_writes_results(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "results.json"
    arguments = [
        "evaluate",
        "chase",
        "--opponents",
        "zero",
        "ou",
        "--matches",
        "4",
        "--json",
        str(file),
    ]
    assert cli.main(arguments) == 0
    task, _, header, *rows = capsys.readouterr().out.splitlines()
    assert task == "VSSSelfPlay-v0"
    assert header.split()[:2] == ["policy", "opponent"]
    assert [row.split()[:3] for row in rows] == [["chase", "zero", "4"], ["chase", "ou", "4"]]
    zero, ou = json.loads(file.read_text())
    assert (zero["opponent"], ou["opponent"]) == ("zero", "ou")
    assert zero["wins"] + zero["draws"] + zero["losses"] == 4


def test_evaluate_writes_the_last_match(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page, saved = tmp_path / "match.html", tmp_path / "match.rsr"
    options = ["--matches", "2", "--html", str(page), "--save", str(saved)]
    assert cli.main(["evaluate", "fetch", "--task", "SSLGoToBall-v0", *options]) == 0
    printed = capsys.readouterr().out.splitlines()
    assert printed[-2:] == [f"page: {page}", f"replay: {saved}"]
    replay = Replay.load(saved)
    assert (replay.task, replay.names, len(replay.episodes)) == ("SSLGoToBall-v0", ("FETCH", ""), 1)
    assert page.read_text().startswith("<!doctype html>")


def test_evaluate_checks_the_output_folder_before_it_plays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(commands, "evaluate", lambda *_, **__: pytest.fail("it played"))
    assert cli.main(["evaluate", "chase", "--json", str(tmp_path / "no" / "r.json")]) == 2
    assert "json" in capsys.readouterr().err


# -- train ------------------------------------------------------------------------------------


def test_train_passes_its_options_on(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Any] = []

    def record(args: commands.Train) -> Path:
        received.append(args)
        return args.out / "policy.safetensors"

    monkeypatch.setattr(commands, "train", record)
    options = ["--out", "there", "--samples", "5", "--hidden-sizes", "8", "9", "--seed", "3"]
    assert cli.main(["train", *options, "--no-progress"]) == 0
    (args,) = received
    assert (args.out, args.samples, args.hidden_sizes) == (Path("there"), 5, (8, 9))
    assert (args.progress, args.resume, args.seed) == (False, False, 3)
    assert json.dumps(args.to_json())
    assert "there/policy.safetensors" in capsys.readouterr().out


def test_train_takes_options_of_the_task(monkeypatch: pytest.MonkeyPatch) -> None:
    received: list[Any] = []
    monkeypatch.setattr(commands, "train", received.append)
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
    monkeypatch.setattr(commands, "train", received.append)
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


@pytest.mark.parametrize("words", [["--task", "VSS-v0"], ["--task=VSS-v0"]])
def test_train_starts_from_the_recommended_settings(
    words: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    received: list[Any] = []
    monkeypatch.setattr(commands, "train", received.append)
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


# -- watch ------------------------------------------------------------------------------------


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


@pytest.fixture
def filmed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Any]:
    """Replace the video by a record of the task, the controllers and the names of the teams."""
    record, video = pytest.importorskip("rsoccer.render.record"), tmp_path / "never.mp4"
    filmed: list[Any] = []

    def film(task: rsoccer.Task, controllers: Any, *_: Any, names: Any, **__: Any) -> Any:  # noqa: ANN401
        filmed.append((task.name, controllers, names))
        return iter([]), 40.0

    monkeypatch.setattr(record, "film_match", film)
    monkeypatch.setattr("rsoccer.render.video.write_video", lambda *_: video)
    return filmed


def test_watch_keeps_the_tasks_own_opponents(filmed: list[Any]) -> None:
    arguments = ["watch", "strike", "--task", "SSLContestedPossession-v0", "--video", "never.mp4"]
    assert cli.main(arguments) == 0
    assert cli.main([*arguments, "--opponent", "zero"]) == 0
    assert cli.main(["watch", "scripted", "--video", "never.mp4"]) == 0
    (_, default, names), (_, changed, _), (task, controllers, _) = filmed
    assert default == {"blue_0": "strike", "yellow_0": "hold"}
    assert names == ("STRIKE", "HOLD")
    assert changed == {"blue_0": "strike", "yellow_0": "zero"}
    assert task == "VSSSelfPlay-v0"
    assert set(controllers.values()) == {"scripted", "ou"}


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
    network_for(rsoccer.make_task("SSLPassEndurance-v0")).save(file)
    assert cli.main(["watch", f"{file}:mean", "--video", "never.mp4"]) == 0
    ((task, controllers, names),) = filmed
    assert task == "SSLPassEndurance-v0"
    assert controllers == {"blue_0": f"{file}:mean", "blue_1": "receive"}
    assert names[1] == ""
    capsys.readouterr()
    assert cli.main(["evaluate", str(file), "--matches", "3"]) == 0
    task, _, header, row = capsys.readouterr().out.splitlines()
    assert task == "SSLPassEndurance-v0"
    assert header.split()[:4] == ["policy", "opponent", "matches", "received"]
    assert row.split()[:3] == [str(file), "-", "3"]


def test_watch_opens_a_window() -> None:
    pytest.importorskip("pygame")
    arguments = ["watch", "chase", "--opponent", "zero", "--seconds", "0.5", "--speed", "10"]
    done = run(*arguments, "--width", "128", SDL_VIDEODRIVER="dummy")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("player", "shown"),
    [("scripted:0.5", "SCRIPTED:0.5"), ("ou", "OU"), ("out/mine/policy.safetensors", "MINE")],
)
def test_the_scoreboard_names_the_policies(player: str, shown: str) -> None:
    assert vars(commands)["_team_name"](player) == shown


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
        (["--save", "match.rsr", "--snapshots", "0"], "snapshot_interval: expected a positive"),
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
    assert cli.main(["watch", str(file), "--opponent", "ou"]) == 2
    assert "opponent: expected none for a replay, got ou" in capsys.readouterr().err


@pytest.mark.parametrize("speed", ["0", "-1", "nan"])
def test_watch_refuses_a_speed_that_is_not_positive(
    speed: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["watch", "--speed", speed]) == 2
    assert "speed" in capsys.readouterr().err


# -- play -------------------------------------------------------------------------------------


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


def test_play_without_pygame_says_so(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    loaded = [name for name in sys.modules if name.startswith(("rsoccer.render", "rsoccer.human"))]
    for name in loaded:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "pygame", None)
    assert cli.main(["play", "VSS-v0"]) == 2
    assert "pip install 'rsoccer[render]'" in capsys.readouterr().err


@pytest.fixture
def played(monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """Replace the session by a record of the task, the controllers and the robot."""
    session = pytest.importorskip("rsoccer.human.session")
    played: list[Any] = []

    class Recorded:
        def __init__(self, task: rsoccer.Task, *teams: Any, names: Any, **_: Any) -> None:  # noqa: ANN401
            played.append((task.name, *teams, names))

        def run(self, seconds: float) -> None:
            played.append(seconds)

    monkeypatch.setattr(session, "Session", Recorded)
    return played


def test_play_gives_the_policies_to_the_other_robots(played: list[Any]) -> None:
    arguments = ["play", "VSSSelfPlay-v0", "--robot", "yellow_1", "--policy", "chase"]
    arguments += ["--opponent", "ou", "--controllers", "blue_2=zero", "--seconds", "3"]
    assert cli.main(arguments) == 0
    (name, controllers, robot, names), seconds = played
    assert (name, robot, seconds) == ("VSSSelfPlay-v0", "yellow_1", 3.0)
    assert names == ("OU ZERO", "YOU")
    assert controllers == {
        **{f"yellow_{i}": "chase" for i in range(3)},
        **{f"blue_{i}": "ou" for i in range(2)},
        "blue_2": "zero",
    }


def test_play_begins_with_the_first_learner(played: list[Any]) -> None:
    assert cli.main(["play", "SSLContestedPossession-v0", "--controllers", "yellow=zero"]) == 0
    (_, controllers, robot, names), _ = played
    assert robot == "blue_0"
    assert names == ("YOU", "ZERO")
    assert controllers == {"blue_0": "strike", "yellow_0": "zero"}


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
