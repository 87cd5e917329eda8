"""Policies by "module:name"."""

import json
from pathlib import Path

import pytest

import rsoccer
from rsoccer import cli, policies
from rsoccer.commands.subject import team_name
from rsoccer.policies.network import Network
from rsoccer.policies.own_code import is_module_text
from rsoccer.replay import ReplayError, record_replay
from tests.policies.networks import network_for

CODE = """
import numpy as np
import rsoccer
from rsoccer.policies import make_policy

class Forward(rsoccer.Policy):
    observes = "nothing"

    def act(self, inputs, rng, memory):
        return np.ones(inputs.action_shape, np.float32)

forward = Forward()
number = 3.0

def team(task):
    return make_policy("chase", task)

def picky(task):
    raise ValueError("another league")

def broken(task):
    return 1 / 0

def empty(task):
    return None

class holder:
    inner = Forward
"""
TASK = "VSSSelfPlay-v0"


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    (tmp_path / "own_teams.py").write_text(CODE)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.path", [str(tmp_path), *__import__("sys").path])
    monkeypatch.delitem(__import__("sys").modules, "own_teams", raising=False)
    return "own_teams"


@pytest.mark.parametrize("name", ["Forward", "forward", "holder.inner"])
def test_a_class_and_an_object_are_policies(module: str, name: str) -> None:
    made = policies.make_policy(f"{module}:{name}", TASK)
    assert type(made).__name__ == "Forward"


def test_a_function_makes_a_policy_that_plays_as_by_its_name(module: str) -> None:
    own = rsoccer.evaluate(f"{module}:team", "ou", matches=4, threads=1)
    named = rsoccer.evaluate("chase", "ou", matches=4, threads=1)
    assert (own.score, own.returns) == (named.score, named.returns)
    assert (own.policy, own.task) == (f"{module}:team", TASK)


def test_code_is_an_opponent_and_plays_tournaments(module: str) -> None:
    forward, team = f"{module}:Forward", f"{module}:team"
    env = rsoccer.parallel_env(TASK, controllers={"yellow": forward})
    assert env.possible_agents == ["blue_0", "blue_1", "blue_2"]
    result = rsoccer.tournament([forward, team], matches=2, threads=1)
    assert {standing.policy for standing in result.standings} == {forward, team}


@pytest.mark.parametrize(
    ("name", "error", "message"),
    [
        ("number", ValueError, "expected 'own_teams:number' to name a Policy.*3.0"),
        ("picky", ValueError, "'own_teams:picky': its maker raises ValueError: another league"),
        ("broken", RuntimeError, "'own_teams:broken': its maker raises ZeroDivisionError"),
        ("empty", ValueError, "expected its maker to return a Policy, got None"),
        ("missing", ImportError, "'own_teams' has no 'missing'"),
    ],
)
def test_other_things_are_refused(
    module: str, name: str, error: type[Exception], message: str
) -> None:
    with pytest.raises(error, match=message):
        policies.make_policy(f"{module}:{name}", TASK)


@pytest.mark.parametrize(
    "text", ["best:mean", "best:robust", "scripted:0.5", "a/b:c", "x.safetensors:mean", "plain"]
)
def test_other_names_are_no_code(text: str) -> None:
    assert not is_module_text(text)
    assert is_module_text("package.module:name")


def test_commands_take_code(module: str, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["evaluate", f"{module}:team", "--opponents", f"{module}:forward"]
    assert cli.main([*arguments, "--matches", "2", "--threads", "1"]) == 0
    assert f"{module}:team" in capsys.readouterr().out
    assert team_name(f"{module}:team") == "TEAM"
    assert policies.file_of(f"{module}:team") is None
    assert policies.trained_on(f"{module}:team") is None


def test_no_file_decides_which_code_runs(module: str, tmp_path: Path) -> None:
    teams = {"blue": f"{module}:team", "yellow": "zero"}
    replay = record_replay(TASK, teams, seconds=0.1, snapshot_interval=1.0)
    with pytest.raises(ReplayError, match=r"policies for \['blue_0'.*as arguments"):
        replay.resume(0)
    replay.resume(0, controllers=teams)
    task = rsoccer.make_task("VSSMulti-v0", opponent=f"{module}:team")
    recorded = record_replay(task, {"all": "zero"}, seconds=0.1, snapshot_interval=1.0)
    with pytest.raises(ReplayError, match=r"task: expected .*own_teams:team"):
        recorded.resume(0)
    network, path = network_for(task), tmp_path / "policy.safetensors"
    options = {"task_options": json.dumps({"opponent": f"{module}:team"})}
    Network(network.arrays(), {**network.metadata, **options}).save(path)
    with pytest.raises(ValueError, match=r"trained beside the code own_teams:team"):
        policies.trained_on(path)
