"""An evolution: its policy, its log, how it resumes, and what it refuses."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.policies.evolved import Evolved
from rsoccer.policies.ssl.team import ScriptedSsl
from rsoccer.train.evolution import EvolveArgs, evolve, run
from rsoccer.train.evolution.settings import STATE_FILE
from rsoccer.train.evolution.strategy import Strategy

OPTIONS = {"half_seconds": 2.0, "halves": 1, "n_blue": 2, "n_yellow": 2}


def args(folder: Path, **changes: Any) -> EvolveArgs:  # noqa: ANN401  (any field)
    settings = {"task_options": OPTIONS, "generations": 2, "matches": 4, "opponents": ("zero",)}
    return EvolveArgs("SSLMatch-v0", out=folder, **{**settings, **changes})


def rows(folder: Path) -> list[dict[str, str]]:
    with (folder / "progress.csv").open() as file:
        return list(csv.DictReader(file))


def test_a_policy_and_a_log_are_written(tmp_path: Path) -> None:
    varied = {"robot.mass": [0.9, 1.1]}
    given = args(tmp_path / "run", sensing="rc2021", randomization=varied, step_size=20.0, seed=3)
    path = evolve(given)
    policy = Evolved.load(path)
    assert (policy.task_name, policy.task_options) == ("SSLMatch-v0", OPTIONS)
    assert policy.sensing == rsoccer.Sensing("rc2021")
    assert policy.randomization == varied
    settings = json.loads((tmp_path / "run" / "args.json").read_text())
    assert settings == given.to_json()
    assert [row["generation"] for row in rows(tmp_path / "run")] == ["1", "2"]
    assert [row["samples"] for row in rows(tmp_path / "run")] == ["8", "16"]
    assert {"zero as blue", "zero as yellow"} < set(rows(tmp_path / "run")[0])
    found = rsoccer.evaluate(path, "zero", matches=2)
    assert found.matches == 2


def test_wrong_numbers_are_refused_before_anything_is_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"randomization: expected one of .*, got 'robot.mas'"):
        evolve(args(tmp_path / "run", randomization={"robot.mas": [0.9, 1.1]}))
    assert not (tmp_path / "run").exists()


def test_a_run_that_is_older_than_a_setting_goes_on(tmp_path: Path) -> None:
    evolve(args(tmp_path / "run", generations=1))
    path = tmp_path / "run" / STATE_FILE
    saved = json.loads(path.read_text())
    del saved["settings"]["randomization"]
    path.write_text(json.dumps(saved))
    evolve(args(tmp_path / "run", resume=True))
    assert len(rows(tmp_path / "run")) == 2


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        (None, "damaged or not the state of an evolution"),
        ([], "damaged or not the state of an evolution"),
        ({}, "damaged or not the state of an evolution: 'generation'"),
        ({"settings": []}, "damaged or not the state of an evolution"),
        ({"policy_files": {"zero": "1"}}, "other policies of the same names"),
        ({"generation": "x"}, "generation: expected a whole number, got 'x'"),
        ({"generation": -1}, "generation: expected at least 0, got -1"),
        ({"mean": "x"}, "damaged or not the state of an evolution"),
        ({"mean": [1.0]}, "mean: expected [0-9]+ finite numbers, those of scripted, got \\[1.0\\]"),
        ({"step": [float("nan")] * 65}, "step: expected [0-9]+ finite numbers"),
    ],
)
def test_states_that_are_damaged_are_refused_by_the_name_of_the_file(
    changes: Any,  # noqa: ANN401  (JSON)
    message: str,
    tmp_path: Path,
) -> None:
    evolve(args(tmp_path / "run", generations=1))
    path = tmp_path / "run" / STATE_FILE
    saved = {**json.loads(path.read_text()), **changes} if changes else changes
    for text in [json.dumps(saved), ""] if changes is None else [json.dumps(saved)]:
        path.write_text(text)
        with pytest.raises(ValueError, match=f"resume: .*{STATE_FILE}.* {message}"):
            evolve(args(tmp_path / "run", resume=True))


def test_a_run_that_is_killed_before_its_first_generation_can_resume(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killed(*_: object) -> None:
        raise KeyboardInterrupt

    with monkeypatch.context() as patched, pytest.raises(KeyboardInterrupt):
        patched.setattr(Evolved, "save", killed)
        evolve(args(tmp_path / "run"))
    evolve(args(tmp_path / "run", resume=True))
    assert len(rows(tmp_path / "run")) == 2


def test_a_run_that_goes_on_is_the_same_as_one_without_a_stop(tmp_path: Path) -> None:
    whole = evolve(args(tmp_path / "whole", step_size=20.0, opponents=("scripted:0.3",)))
    parts = args(tmp_path / "parts", step_size=20.0, opponents=("scripted:0.3",), generations=1)
    evolve(parts)
    path = evolve(replace(parts, generations=2, resume=True, threads=2))
    found, expected = Evolved.load(path).tactics, Evolved.load(whole).tactics
    np.testing.assert_array_equal(found, expected)
    defaults = [tactic.default for tactic in ScriptedSsl.TACTICS]
    assert not np.allclose(found, defaults), "some match had another score"
    assert len(rows(tmp_path / "parts")) == 2
    whole_log, parts_log = (
        [{name: each for name, each in row.items() if name != "seconds"} for row in rows(folder)]
        for folder in (tmp_path / "whole", tmp_path / "parts")
    )
    assert whole_log == parts_log
    other = evolve(args(tmp_path / "o", step_size=20.0, opponents=("scripted:0.3",), seed=1))
    assert (Evolved.load(other).tactics != expected).any()


@pytest.mark.parametrize("stopped_at", [1, 2])
def test_a_generation_that_was_stopped_before_its_state_is_played_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stopped_at: int
) -> None:
    given = args(tmp_path / "run", step_size=20.0)
    keep = run._keep

    def stop(args: EvolveArgs, strategy: Strategy, generation: int, files: dict[str, str]) -> None:
        if generation == stopped_at:
            raise KeyboardInterrupt
        keep(args, strategy, generation, files)

    monkeypatch.setattr(run, "_keep", stop)
    with pytest.raises(KeyboardInterrupt):
        evolve(given)
    stopped = Evolved.load(tmp_path / "run" / "policy.safetensors").tactics
    monkeypatch.undo()
    path = evolve(replace(given, resume=True, generations=stopped_at))
    np.testing.assert_array_equal(Evolved.load(path).tactics, stopped)
    evolve(replace(given, resume=True))
    assert [row["generation"] for row in rows(tmp_path / "run")] == ["1", "2"]


def test_opponents_with_other_content_are_refused(tmp_path: Path) -> None:
    opponent = evolve(args(tmp_path / "a", generations=1))
    given = args(tmp_path / "b", generations=1, opponents=(str(opponent),))
    evolve(given)
    Evolved.of_training(
        "scripted", rsoccer.make_task("SSLMatch-v0"), [t.most for t in ScriptedSsl.TACTICS], {}
    ).save(opponent)
    with pytest.raises(ValueError, match="other policies of the same names"):
        evolve(replace(given, generations=2, resume=True))


def test_options_of_models_are_kept_as_texts(tmp_path: Path) -> None:
    robot = rsoccer.RobotModel("ssl_generic", max_speed=2.0)
    options = {**OPTIONS, "robot": robot, "reward_weights": {"goal": 3.0}}
    given = args(tmp_path / "run", task_options=options, generations=1)
    path = evolve(given)
    policy = Evolved.load(path)
    evolve(replace(given, generations=2, resume=True))
    assert policy.task_options == given.task_options
    found = rsoccer.evaluate(path, "zero", matches=2)
    assert found.matches == 2


def test_it_begins_with_the_tactics_of_a_file(tmp_path: Path) -> None:
    first = evolve(args(tmp_path / "a", step_size=20.0, opponents=("scripted:0.3",)))
    second = evolve(args(tmp_path / "b", generations=1, step_size=1e-9, first=str(first)))
    np.testing.assert_allclose(Evolved.load(second).tactics, Evolved.load(first).tactics, rtol=1e-5)
    with pytest.raises(ValueError, match="first: expected tactics of scripted, got zero"):
        evolve(args(tmp_path / "c", first="zero"))


def test_wrong_settings_are_refused_before_anything_changes(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="matches must be an even number, got 3"):
        args(tmp_path, matches=3)
    with pytest.raises(ValueError, match="script must be one of"):
        args(tmp_path, script="chase")
    out = tmp_path / "out"
    with pytest.raises(ValueError, match="scripted"):
        evolve(replace(args(out), task="VSSMatch-v0", task_options={}))
    with pytest.raises(ValueError, match="opponents: expected none in SSLGoToBall-v0"):
        evolve(replace(args(out), task="SSLGoToBall-v0", task_options={}))
    with pytest.raises(ValueError, match="unknown policy 'nobody'"):
        evolve(args(out, opponents=("nobody",)))
    with pytest.raises(ValueError, match="resume: expected the state of a run"):
        evolve(args(out, resume=True))
    assert not out.exists()
    (tmp_path / "train").mkdir()
    (tmp_path / "train" / "progress.csv").touch()
    with pytest.raises(ValueError, match=r"out: .* holds a run \(progress.csv\)"):
        evolve(args(tmp_path / "train"))
    evolve(args(out, generations=1))
    with pytest.raises(ValueError, match=r"out: .* holds a run .*; set resume, or another folder"):
        evolve(args(out))
    with pytest.raises(ValueError, match="other settings: seed was 0, is 1"):
        evolve(args(out, resume=True, seed=1))
