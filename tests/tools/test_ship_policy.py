"""Shipping of a policy: its scores, its command, its refusals."""

import json
import shlex
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer import cli
from rsoccer.commands import train as train_command
from rsoccer.policies import make_policy, trained
from rsoccer.policies.lookahead import Lookahead
from rsoccer.policies.network import Network
from rsoccer.policies.policy_file import Value
from rsoccer.train import Args, NetworkSettings, PpoSettings, train
from tests.policies.networks import network_for
from tests.train.one_update import one_update
from tools.ship_policy import (
    MAX_SIZE,
    add_value,
    command_of,
    options_of,
    ship,
    ship_behind_forecast,
    shipped,
)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder in the place of the package's."""
    (tmp_path / "trained").mkdir()
    monkeypatch.setattr(trained, "FOLDER", tmp_path / "trained")
    return tmp_path / "trained"


def test_a_run_becomes_the_best_policy_of_its_task(
    tmp_path: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("torch")
    options = {"opponent": "zero", "max_steps": 300}
    train(replace(one_update("VSS-v0", tmp_path / "run"), task_options=options))
    path = ship(tmp_path / "run", ["zero", "ou"], starts=10, threads=1)
    assert path == folder / "VSS-v0.safetensors"
    first, second = trained.list_scores(path)
    assert (first.opponent, second.opponent) == ("zero", "ou")
    assert (first.matches, first.metric) == (20, "goal_score"), "ten starts from each side"
    best = trained.load_best_network(rsoccer.make_task("VSS-v0"))
    made = json.loads(best.metadata["training"])
    command = shlex.split(made["command"])
    assert command[:4] == ["rsoccer", "train", "--task", "VSS-v0"]
    for words in (
        "--samples 1",
        "--network.hidden-sizes 8",
        "--task-options opponent=zero max_steps=300",
    ):
        assert f" {words} " in f"{made['command']} "
    assert not {"--out", "--resume", "--progress", "--no-progress"} & set(command)
    assert (made["seed"], made["samples"]) == (0, 12)
    assert made["physics"] == rsoccer.build_info()["physics"]
    trained_network = Network.load(tmp_path / "run" / "policy.safetensors")
    assert list(best.arrays()) == list(trained_network.arrays())
    for name, array in trained_network.arrays().items():
        np.testing.assert_allclose(best.arrays()[name], array, rtol=1e-3, atol=1e-7)
    capsys.readouterr()
    assert ship(tmp_path / "run", ["zero"], starts=10, threads=1) == path
    assert "before:\n    Score(opponent='zero'" in capsys.readouterr().out


def test_other_policies_are_refused(
    tmp_path: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    network = network_for(rsoccer.make_task("SSLGoToBall-v0"))
    network.save(tmp_path / "policy.safetensors")
    with pytest.raises(ValueError, match="starts: expected at least 10, got 9"):
        ship(tmp_path, starts=9)
    with pytest.raises(ValueError, match="run: expected a policy with its layout"):
        ship(tmp_path)
    network.metadata["layout"] = rsoccer.make_task("SSLGoToBall-v0").layout.text
    network.save(tmp_path / "policy.safetensors")
    with pytest.raises(FileNotFoundError, match=r"args\.json"):
        ship(tmp_path)
    (tmp_path / "args.json").write_text('{"task": "SSLGoToBall-v0", "samples": 5, "seed": 2}')
    (tmp_path / "progress.csv").write_text("update,samples\n1,5\n")
    network.set_value(Value([(network.layers[0][0][:1], np.zeros(1, np.float32))], 0.9, 1, 1.0))
    network.save(tmp_path / "policy.safetensors")
    monkeypatch.setattr("tools.ship_policy.MAX_SIZE", 100)
    with pytest.raises(ValueError, match="run: expected a policy of at most 100 bytes"):
        ship(tmp_path, starts=10, threads=1)
    assert list(folder.iterdir()) == []
    monkeypatch.setattr("tools.ship_policy.MAX_SIZE", MAX_SIZE)
    path = ship(tmp_path, starts=10, threads=1)
    assert Network.load(path).value is None, "a lookahead is for VSSS"
    (score,) = trained.list_scores(path)
    assert (score.opponent, score.metric, score.matches) == ("-", "reached", 10)


@pytest.mark.parametrize("task", ["VSS-v0", "SSLDribbling-v0", "SSLGoToBall-v0"])
def test_the_recorded_command_has_the_settings_of_the_run(
    task: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    received: list[Args] = []
    monkeypatch.setattr(train_command, "train", received.append)
    shared = Args(task=task, network=NetworkSettings(robot_units=3))
    varied = Args(task=task, sensing="vsss", randomization={"robot.mass": (0.9, 1.1)})
    for args in (Args.for_task(task), Args(task=task), shared, varied):
        assert cli.main(shlex.split(command_of(args.to_json()))[1:]) == 0
        assert received[-1].to_json() == args.to_json()


def test_the_best_policy_becomes_the_robust_one_behind_a_forecast(folder: Path) -> None:
    task = rsoccer.make_task("VSS-v0")
    network = network_for(task)
    network.metadata["layout"] = task.layout.text
    network.save(folder / "VSS-v0.safetensors", half_precision=True)
    path = ship_behind_forecast("VSS-v0", ["zero"], starts=10, threads=1)
    assert path == folder / "VSS-v0.robust.safetensors"
    robust, best = trained.load_best_network(task, "robust"), trained.load_best_network(task)
    assert robust.needs_forecast
    assert not best.needs_forecast
    for name, array in best.arrays().items():
        np.testing.assert_array_equal(robust.arrays()[name], array)
    scores = trained.list_scores(path)
    assert [score.sensing for score in scores] == ["", "rc2021, forecast=1"]
    with pytest.raises(ValueError, match=r"name: expected one of \['VSS-v0'\], got 'SSLMatch-v0'"):
        ship_behind_forecast("SSLMatch-v0")


def test_a_value_network_is_added_for_the_normalization_of_the_policy(
    folder: Path, tmp_path: Path
) -> None:
    source = Network.load(train(one_update("VSSSelfPlay-v0", tmp_path / "a")))
    critic = replace(
        one_update("VSSSelfPlay-v0", tmp_path / "b"),
        network=NetworkSettings(hidden_sizes=(8,), initial_policy=str(tmp_path / "a.safetensors")),
        ppo=PpoSettings(n_epochs=1, n_minibatches=1, critic_warmup=9),
    )
    source.value = None
    source.metadata.pop("value")
    for name in ("a.safetensors", "trained/VSSSelfPlay-v0.safetensors"):
        source.save(tmp_path / name, half_precision=True)
    run = Network.load(train(critic))
    assert add_value(tmp_path / "b") == [folder / "VSSSelfPlay-v0.safetensors"]
    task = rsoccer.make_task("VSSSelfPlay-v0")
    best = trained.load_best_network(task)
    assert best.metadata.keys() == {*source.metadata, "value"}
    observations = np.random.default_rng(0).normal(size=(20, task.layout.size)).astype(np.float32)
    wanted = run.values(observations)
    assert np.abs(wanted).max() > 0.01
    assert not np.array_equal(run.mean, best.mean)
    np.testing.assert_allclose(best.values(observations), wanted, atol=0.02)
    assert isinstance(make_policy("best:lookahead", task), Lookahead)
    with pytest.raises(ValueError, match="value: expected a run that began with a policy of the p"):
        add_value(tmp_path / "a")


@pytest.mark.parametrize("name", shipped())
def test_policies_are_measured_with_the_opponents_that_they_observe(name: str) -> None:
    policy = trained.load_file(shipped()[name])
    task = rsoccer.make_task(policy.task_name, **options_of(policy))
    make_policy(policy, task)
    with_opponents = {"SSLPassEnduranceMulti-v1:opponents": {"n_opponents": 1}}
    assert options_of(policy) == with_opponents.get(name, {})
