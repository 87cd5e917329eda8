import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import rsoccer
from rsoccer import cli, commands
from tests.policies.test_network_chance import fitting


def run(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own, as a shell would start it."""
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


def test_heavy_packages_stay_out_of_the_way() -> None:
    code = (
        "import sys; from rsoccer.cli import main; main(['list'])\n"
        "try: main(['train', '--help'])\n"
        "except SystemExit: pass\n"
        "sys.exit(','.join({'torch', 'pygame', 'matplotlib', 'PIL'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    assert "--learning-rate" in done.stdout


def test_the_module_is_the_command() -> None:
    done = run("list")
    assert done.returncode == 0
    assert "VSSSelfPlay-v0" in done.stdout


# -- help -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ([], ["list", "train", "evaluate", "watch", "Robot soccer"]),
        (["train"], ["--samples", "decisions to learn from", "--resume"]),
        (["evaluate"], ["POLICY", "--opponents", "half of them as blue", "--json PATH"]),
        (["watch"], ["POLICY", "--video PATH", "needs no display"]),
    ],
)
def test_help_reads_well(
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
    given = [
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
    assert cli.main(given) == 0
    task, _, header, *rows = capsys.readouterr().out.splitlines()
    assert task == "VSSSelfPlay-v0"
    assert header.split()[:2] == ["policy", "opponent"]
    assert [row.split()[:3] for row in rows] == [["chase", "zero", "4"], ["chase", "ou", "4"]]
    zero, ou = json.loads(file.read_text())
    assert (zero["opponent"], ou["opponent"]) == ("zero", "ou")
    assert zero["wins"] + zero["draws"] + zero["losses"] == 4


def test_evaluate_checks_where_results_shall_go_before_it_plays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(commands, "evaluate", lambda *_, **__: pytest.fail("it played"))
    assert cli.main(["evaluate", "chase", "--json", str(tmp_path / "no" / "r.json")]) == 2
    assert "json" in capsys.readouterr().err


# -- train ------------------------------------------------------------------------------------


def test_train_hands_over_what_it_was_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    told: list[Any] = []

    def note(args: commands.Train) -> Path:
        told.append(args)
        return args.out / "policy.safetensors"

    monkeypatch.setattr(commands, "train", note)
    given = ["train", "--out", "there", "--samples", "5", "--hidden-sizes", "8", "9", "--no-progress"]
    assert cli.main([*given, "--seed", "3"]) == 0
    (args,) = told
    assert (args.out, args.samples, args.hidden) == (Path("there"), 5, (8, 9))
    assert (args.progress, args.resume, args.seed) == (False, False, 3)
    assert json.dumps(args.to_json())
    assert "there/policy.safetensors" in capsys.readouterr().out


# -- watch ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["match.mp4", "match.gif"])
def test_watch_films_without_a_display(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("pygame")
    file = tmp_path / name
    given = ["watch", "chase", "--seconds", "0.5", "--width", "128", "--video", str(file)]
    assert cli.main(given) == 0
    assert str(file) in capsys.readouterr().out
    assert file.stat().st_size > 1000


@pytest.fixture
def filmed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[Any]:
    """What `watch` asks to be filmed: the task, its drivers, and names on the board."""
    record, video = pytest.importorskip("rsoccer.render.record"), tmp_path / "never.mp4"
    told: list[Any] = []

    def film(task: rsoccer.Task, controllers: Any, *_: Any, names: Any, **__: Any) -> Any:  # noqa: ANN401
        told.append((task.name, controllers, names))
        return iter([]), 40.0

    monkeypatch.setattr(record, "film_match", film)
    monkeypatch.setattr("rsoccer.render.video.write_video", lambda *_: video)
    return told


def test_watch_put_ou_in_the_place_of_the_tasks_own_robots(filmed: list[Any]) -> None:
    given = ["watch", "strike", "--task", "SSLContestedPossession-v0", "--video", "never.mp4"]
    assert cli.main(given) == 0
    assert cli.main([*given, "--opponent", "zero"]) == 0
    assert cli.main(["watch", "scripted", "--video", "never.mp4"]) == 0
    (_, own, names), (_, other, _), (task, both, _) = filmed
    assert own == {"blue_0": "strike", "yellow_0": "hold"}
    assert names == ("STRIKE", "HOLD")
    assert other == {"blue_0": "strike", "yellow_0": "zero"}
    assert task == "VSSSelfPlay-v0"
    assert set(both.values()) == {"scripted", "ou"}


def test_watch_and_evaluate_asked_for_the_task_that_the_file_names(
    filmed: list[Any], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "policy.safetensors"
    fitting(rsoccer.make_task("SSLPassEndurance-v0")).save(file)
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


def test_watch_plays_in_a_window() -> None:
    pytest.importorskip("pygame")
    given = ["watch", "chase", "--opponent", "zero", "--seconds", "0.5", "--speed", "10"]
    done = run(*given, "--width", "128", SDL_VIDEODRIVER="dummy")
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize(
    ("player", "shown"),
    [("scripted:0.5", "SCRIPTED:0.5"), ("ou", "OU"), ("out/mine/policy.safetensors", "MINE")],
)
def test_the_score_board_names_who_plays(player: str, shown: str) -> None:
    assert vars(commands)["_team_name"](player) == shown


@pytest.mark.parametrize("speed", ["0", "-1", "nan"])
def test_watch_refuses_to_stand_still(speed: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["watch", "--speed", speed]) == 2
    assert "speed" in capsys.readouterr().err
