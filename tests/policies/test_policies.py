import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer import policies
from rsoccer.policies.base import Policy, PolicyInput
from rsoccer.policies.noise import OrnsteinUhlenbeck
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssSelfPlay
from tests.helpers import same

TASK = VssSelfPlay()


def run(policy: Policy, n: int, steps: int, robots: int = 3, seed: int = 0) -> np.ndarray:
    """Actions (steps, n, robots, 2) of a policy that sees nothing."""
    shape = (n, robots, 2)
    rng = WorldRng.seeded(seed, n)
    memory = policy.new_memory(shape, rng)
    seen = PolicyInput(shape, None, None)
    return np.array([policy.act(seen, rng, memory) for _ in range(steps)])


# Tasks for policies that do not drive two wheels.
TASKS = {
    "fetch": "SSLGoToBall-v0",
    "hold": "SSLSelfPlay-v0",
    "passer": "SSLPassEndurance-v0",
    "receive": "SSLPassEndurance-v0",
    "strike": "SSLStaticDefenders-v0",
    "weave": "SSLDribbling-v0",
}


def test_names() -> None:
    names = policies.names()
    assert names == sorted(names)
    assert {"chase", "ou", "scripted", "uniform", "zero", *TASKS} <= set(names)
    for name in names:
        task = rsoccer.make_task(TASKS[name]) if name in TASKS else TASK
        assert isinstance(policies.make(name, task), Policy)


@pytest.mark.parametrize("name", TASKS)
def test_scripts_for_ssl_refuse_other_robots(name: str) -> None:
    with pytest.raises(ValueError, match="robots with a dribbler"):
        policies.make(name, TASK)


def test_a_policy_is_itself() -> None:
    policy = OrnsteinUhlenbeck()
    assert policies.make(policy, TASK) is policy


@pytest.mark.parametrize("name", ["chess", "", "out/no_such_file"])
def test_an_unknown_name_is_told_with_the_valid_ones(name: str) -> None:
    with pytest.raises(ValueError, match=r"unknown policy.*'chase', .*'ou', .*'uniform', .*'zero'"):
        policies.make(name, TASK)


@pytest.mark.parametrize("wrong", [3, None, b"chase", ["chase"]])
def test_what_is_no_policy_is_named(wrong: Any) -> None:  # noqa: ANN401
    message = re.escape(f"policy: expected a policy, its name or its file, got {wrong!r}")
    with pytest.raises(TypeError, match=message):
        policies.make(wrong, TASK)
    for ask in (policies.trained_on, policies.name_of):
        with pytest.raises(TypeError, match=message):
            ask(wrong)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises((ValueError, OSError), match=r"lost\.safetensors"):
        policies.make(tmp_path / "lost.safetensors", TASK)


def test_zero_stands_still() -> None:
    assert not run(policies.make("zero", TASK), 4, 3).any()


def test_uniform_draws_every_action_afresh() -> None:
    actions = run(policies.make("uniform", TASK), 50, 200)
    assert actions.min() >= -1.0
    assert actions.max() <= 1.0
    assert np.histogram(actions, 10, (-1, 1))[0].min() > 5500
    assert abs(np.corrcoef(actions[:-1].ravel(), actions[1:].ravel())[0, 1]) < 0.02


@pytest.mark.parametrize("name", ["uniform", "ou"])
def test_noise_is_the_same_in_any_batch(name: str) -> None:
    policy = policies.make(name, TASK)
    many = run(policy, 9, 30, seed=5)
    for i in (0, 4, 8):
        assert same(many[:, i : i + 1], run(policy, 1, 30, seed=5 + i))
