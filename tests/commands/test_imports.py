"""A task, policies and a robot of one's own on the command line."""

import json
from pathlib import Path
from typing import get_args

import pytest

from rsoccer import cli
from tests.own_things import run_in, write_module


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["list", "--import", "mine"], "Duel-v0: One robot against one that turns."),
        (["list", "--import=mine", "--import", "other"], "other, "),
        (["evaluate", "Duel-v0", "--policy", "spin:0.5", "--matches", "2"], "spin:0.5  Spin"),
        (["evaluate", "spin", "--task", "VSS-v0", "--opponents", "spin", "--matches", "2"], "spin"),
        (["tournament", "spin", "ou", "--matches", "2"], "spin"),
        (
            ["watch", "Duel-v0", "--opponents", "spin", "--seconds", "0.2", "--save", "a.rsr"],
            "a.rsr",
        ),
    ],
)
def test_every_command_imports_modules(words: list[str], expected: str, tmp_path: Path) -> None:
    write_module(tmp_path)
    (tmp_path / "other.py").write_text(
        "import rsoccer, rsoccer.policies.noise as noise\n"
        "rsoccer.register_policy('other', lambda task: noise.Zero())\n"
    )
    imports = [] if words[0] == "list" else ["--import", "mine"]
    done = run_in(tmp_path, *words, *imports)
    assert done.returncode == 0, done.stderr
    assert expected in done.stdout


def test_an_unknown_name_says_how_to_import(tmp_path: Path) -> None:
    write_module(tmp_path)
    for words in (["watch", "Duel-v0"], ["evaluate", "spin"]):
        done = run_in(tmp_path, *words)
        assert done.returncode == 2
        assert "--import MODULE" in done.stderr
        assert done.stderr.count("\n") == 1


def test_every_command_describes_the_option(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tyro")
    from rsoccer.commands import command_type

    names = [get_args(each)[1].name for each in get_args(command_type([]))]
    assert {"train", "distill", "convert", "drive"} < set(names)
    for name in names:
        with pytest.raises(SystemExit):
            cli.main([name, "--help"])
        assert "--import MODULE" in capsys.readouterr().out, name


def test_a_run_records_its_modules_and_its_robot(tmp_path: Path) -> None:
    """Formerly a task of one's own, a robot by numbers and a policy object stopped the training."""
    pytest.importorskip("torch")
    write_module(tmp_path)
    own = ["--task", "Duel-v0", "--import", "mine", "--task-options", "robot=heavy.json"]
    small = ["--rollout.worlds", "16", "--run.no-progress", "--run.ladder-matches", "2"]
    small += ["--out", "out"]
    done = run_in(tmp_path, "train", *own, *small, "--samples", "1e3", "--opponents", "spin", "1")
    assert done.returncode == 0, done.stderr
    saved = json.loads((tmp_path / "out" / "args.json").read_text())
    assert (saved["imports"], saved["samples"]) == (["mine"], 1000)
    assert saved["task_options"]["robot"]["RobotModel"]["mass"] == 0.21
    (tmp_path / "heavy.json").unlink()
    done = run_in(
        tmp_path, "train", "--resume", "--samples", "2e3", "--run.no-progress", "--out", "out"
    )
    assert done.returncode == 0, done.stderr
    shown = ["watch", "out/policy.safetensors", "--seconds", "0.2", "--save", "a.rsr"]
    done = run_in(tmp_path, *shown, "--import", "mine")
    assert done.returncode == 0, done.stderr
    done = run_in(tmp_path, *shown)
    assert "unknown task 'Duel-v0'" in done.stderr


def test_training_goes_on_where_a_policy_object_is_the_default(tmp_path: Path) -> None:
    """Formerly the names of policies were sorted with the object among them."""
    pytest.importorskip("torch")
    write_module(tmp_path)
    words = ["--task", "Duel-v0", "--import", "mine", "--samples", "100", "--rollout.worlds", "16"]
    done = run_in(tmp_path, "train", *words, "--run.no-progress", "--run.ladder-matches", "2")
    assert done.returncode == 0, done.stderr
