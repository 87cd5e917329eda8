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
    """Actions (steps, n, robots, 2) of a policy that observes nothing."""
    shape = (n, robots, 2)
    rng = WorldRng.seeded(seed, n)
    memory = policy.new_memory(shape, rng)
    inputs = PolicyInput(shape, None, None)
    return np.array([policy.act(inputs, rng, memory) for _ in range(steps)])


# Tasks of the policies for SSL robots.
SSL_TASKS = {
    "fetch": "SSLGoToBall-v0",
    "hold": "SSLSelfPlay-v0",
    "keep": "SSLKeepaway-v0",
    "passer": "SSLPassEndurance-v1",
    "receive": "SSLPassEndurance-v1",
    "strike": "SSLStaticDefenders-v0",
    "take": "SSLKeepaway-v0",
    "weave": "SSLDribbling-v0",
}


def test_every_name_makes_a_policy() -> None:
    names = policies.list_policies()
    assert names == sorted(names)
    assert {"chase", "ou", "scripted", "uniform", "zero", *SSL_TASKS} <= set(names)
    for name in names:
        task = rsoccer.make_task(SSL_TASKS[name]) if name in SSL_TASKS else TASK
        assert isinstance(policies.make_policy(name, task), Policy)


@pytest.mark.parametrize("name", SSL_TASKS)
def test_ssl_scripts_refuse_other_robots(name: str) -> None:
    with pytest.raises(ValueError, match="robots with a dribbler"):
        policies.make_policy(name, TASK)


def test_a_policy_object_is_returned_as_it_is() -> None:
    policy = OrnsteinUhlenbeck()
    assert policies.make_policy(policy, TASK) is policy


@pytest.mark.parametrize("name", ["chess", "", "out/no_such_file"])
def test_the_error_for_an_unknown_name_lists_the_valid_ones(name: str) -> None:
    with pytest.raises(ValueError, match=r"unknown policy.*'chase', .*'ou', .*'uniform', .*'zero'"):
        policies.make_policy(name, TASK)


@pytest.mark.parametrize("wrong", [3, None, b"chase", ["chase"]])
def test_other_types_are_refused(wrong: Any) -> None:  # noqa: ANN401
    message = re.escape(f"policy: expected a policy, its name or its file, got {wrong!r}")
    with pytest.raises(TypeError, match=message):
        policies.make_policy(wrong, TASK)
    for function in (policies.trained_on, policies.name_of):
        with pytest.raises(TypeError, match=message):
            function(wrong)


def test_the_error_for_a_missing_file_names_it(tmp_path: Path) -> None:
    with pytest.raises((ValueError, OSError), match=r"lost\.safetensors"):
        policies.make_policy(tmp_path / "lost.safetensors", TASK)


def test_zero_stands_still() -> None:
    assert not run(policies.make_policy("zero", TASK), 4, 3).any()


def test_uniform_draws_independent_actions() -> None:
    actions = run(policies.make_policy("uniform", TASK), 50, 200)
    assert actions.min() >= -1.0
    assert actions.max() <= 1.0
    assert np.histogram(actions, 10, (-1, 1))[0].min() > 5500
    assert abs(np.corrcoef(actions[:-1].ravel(), actions[1:].ravel())[0, 1]) < 0.02


@pytest.mark.parametrize("name", ["uniform", "ou"])
def test_noise_does_not_depend_on_the_batch(name: str) -> None:
    policy = policies.make_policy(name, TASK)
    batch = run(policy, 9, 30, seed=5)
    for i in (0, 4, 8):
        assert same(batch[:, i : i + 1], run(policy, 1, 30, seed=5 + i))


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_each_policy_plays_each_task_that_accepts_it(name: str) -> None:
    played = []
    for policy in policies.list_policies():
        try:
            matches = rsoccer.Matches(name, 2, controllers={"all": policy})
        except ValueError as error:
            assert policy in str(error)
            continue
        matches.reset()
        for _ in range(5):
            matches.step(np.zeros((2, 0, matches.action_size), np.float32))
        assert np.isfinite(matches.play.actions).all()
        played.append(policy)
    assert {"zero", "ou", "uniform"} < set(played)
