"""Scripts with learned tactics, and their files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer.files import safetensors_bytes
from rsoccer.lineup import lineup
from rsoccer.policies import make_policy, trained_on
from rsoccer.policies.evolved import SCRIPTS, Evolved, names_of
from rsoccer.policies.network import Network
from rsoccer.policies.tactics import TacticalPolicy
from rsoccer.task import Task

TASKS = {"scripted": "SSLMatch-v0", "keep": "SSLKeepaway-v0"}
"""A task for each script."""


def defaults(script: type[TacticalPolicy]) -> np.ndarray:
    return np.array([tactic.default for tactic in script.TACTICS], np.float32)


def policy_of(script: str, changes: dict[str, str] | None = None) -> Evolved:
    task = rsoccer.make_task(TASKS[script])
    policy = Evolved.of_training(script, task, defaults(SCRIPTS[script]), {})
    policy.metadata |= changes or {}
    return policy


def rows_after(task: Task, policy: Any, steps: int) -> np.ndarray:  # noqa: ANN401
    opponent = "scripted" if task.two_sided else None
    matches = Matches(task, 2, controllers=lineup(task, policy, opponent))
    matches.reset(seed=3)
    for _ in range(steps):
        matches.step(np.zeros((2, 0, matches.action_size), np.float32))
    return matches.frame.rows.copy()


@pytest.mark.parametrize("script", SCRIPTS)
def test_numbers_that_were_set_by_hand_give_the_script(script: str) -> None:
    task = rsoccer.make_task(TASKS[script])
    expected = rows_after(task, make_policy(script, task), 150)
    np.testing.assert_array_equal(rows_after(task, policy_of(script), 150), expected)


@pytest.mark.parametrize("script", SCRIPTS)
def test_each_match_plays_by_its_own_numbers(script: str) -> None:
    task, kind = rsoccer.make_task(TASKS[script]), SCRIPTS[script]
    other = np.array([tactic.most for tactic in kind.TACTICS], np.float32)
    alone = [
        rows_after(task, kind.with_tactics(task, each), 150) for each in (defaults(kind), other)
    ]
    both = rows_after(task, kind.with_tactics(task, np.stack([defaults(kind), other])), 150)
    for match in range(2):
        np.testing.assert_array_equal(both[match], alone[match][match])
    assert (alone[0][1] != alone[1][1]).any()


@pytest.mark.parametrize("script", SCRIPTS)
def test_names_and_ranges_are_sound(script: str) -> None:
    tactics = SCRIPTS[script].TACTICS
    assert len({tactic.name for tactic in tactics}) == len(tactics) > 10
    for tactic in tactics:
        assert 0.0 < tactic.least <= tactic.default <= tactic.most
    assert names_of(SCRIPTS[script]).split() == [tactic.name for tactic in tactics]


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_file_comes_back(script: str, tmp_path: Path) -> None:
    task = rsoccer.make_task(TASKS[script])
    kind = SCRIPTS[script]
    rng = np.random.default_rng(0)
    tactics = [rng.uniform(tactic.least, tactic.most) for tactic in kind.TACTICS]
    varied = {"robot.mass": [0.9, 1.1]}
    policy = Evolved.of_training(script, task, tactics, {}, "rc2021", varied)
    path = tmp_path / "policy.safetensors"
    policy.save(path)
    read = make_policy(path, task)
    assert isinstance(read, Evolved)
    np.testing.assert_array_equal(read.tactics, np.array(tactics, np.float32))
    assert read.sensing == rsoccer.Sensing("rc2021")
    assert read.randomization == varied
    assert (read.forecasts, read.needs_forecast) == (True, False)
    again = tmp_path / "again.safetensors"
    read.save(again)
    assert again.read_bytes() == path.read_bytes()
    found = trained_on(path)
    assert found is not None
    assert found.name == task.name


def test_options_of_the_training_are_those_of_its_task(tmp_path: Path) -> None:
    task = rsoccer.make_task("SSLMatch-v0", half_seconds=20.0, n_blue=3)
    tactics = defaults(SCRIPTS["scripted"])
    path = tmp_path / "policy.safetensors"
    Evolved.of_training("scripted", task, tactics, {"half_seconds": 20.0, "n_blue": 3}).save(path)
    assert Evolved.load(path).task_options == {"half_seconds": 20.0, "n_blue": 3}
    found = trained_on(path)
    assert found is not None
    assert found.n_blue == 3


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"format": "rsoccer-tactics-9"}, "metadata 'format' should be 'rsoccer-tactics-1'"),
        ({"script": "chase"}, "metadata 'script' should be one of .*'scripted'.*, got 'chase'"),
        ({"names": "speed"}, "metadata 'names' should be those of the script"),
        ({"task": ""}, "metadata 'task' should name the task"),
        ({"scores": "[1]"}, "metadata 'scores'"),
        ({"sensing": "fog"}, "metadata 'sensing'"),
    ],
)
def test_wrong_files_are_refused(tmp_path: Path, changes: dict[str, str], message: str) -> None:
    path = tmp_path / "policy.safetensors"
    policy_of("scripted", changes).save(path)
    with pytest.raises(ValueError, match=rf"(?s)policy.safetensors is not a usable.*{message}"):
        make_policy(path, "SSLMatch-v0")


def test_wrong_arrays_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    policy = policy_of("scripted")
    for arrays, message in (
        ({"mean": policy.tactics}, r"expected the array 'tactics', got \['mean'\]"),
        ({"tactics": policy.tactics[1:]}, "tactics: expected 65 numbers, got shape"),
        ({"tactics": policy.tactics * np.float32(9)}, "tactics: expected kick_hysteresis from 0.3"),
    ):
        path.write_bytes(safetensors_bytes(arrays, policy.metadata))
        with pytest.raises(ValueError, match=message):
            Evolved.load(path)
    with pytest.raises(FileNotFoundError, match="does not exist"):
        make_policy(tmp_path / "nothing.safetensors", "SSLMatch-v0")


def test_tactics_have_no_modes_and_are_no_network(tmp_path: Path) -> None:
    path = tmp_path / "policy.safetensors"
    policy_of("scripted").save(path)
    with pytest.raises(ValueError, match="mode: expected none"):
        make_policy(f"{path}:mean", "SSLMatch-v0")
    with pytest.raises(ValueError, match="metadata 'format' should be 'rsoccer-policy-2'"):
        Network.load(path)
    with pytest.raises(ValueError, match="scripted"):
        make_policy(path, "VSSMatch-v0")
