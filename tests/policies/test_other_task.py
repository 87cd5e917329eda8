"""Policies in tasks that they were not trained on."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Array, Floats
from rsoccer.history import ObservationStack
from rsoccer.policies import make_policy
from rsoccer.policies.network import Network
from rsoccer.policies.other_task import fitted
from rsoccer.policies.policy_file import Value
from rsoccer.task import Task
from rsoccer.train.network import initial_policy

TASKS: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("VSSSelfPlay-v0", "VSSMatch-v0", {}),
    ("VSSSelfPlay-v0", "VSSMatch-v0", {"n_blue": 5, "n_yellow": 5, "field": "vss_5v5"}),
    ("VSSSelfPlay-v0", "VSSMatch-v0", {"n_blue": 2, "n_yellow": 2}),
    ("SSLSelfPlay-v0", "SSLMatch-v0", {"n_blue": 3, "n_yellow": 3}),
    ("SSLSelfPlay-v0", "SSLMatch-v0", {}),
    ("SSLGoToBall-v0", "SSLPassEndurance-v1", {}),
)


def best(task: str) -> Network:
    policy = make_policy("best", task)
    assert isinstance(policy, Network)
    return policy


def common(source: Task, target: Task) -> list[tuple[Array, Array]]:
    """Columns of equal numbers of both tasks, written out by block."""
    pairs = []
    for name, block in source.layout.blocks.items():
        if name not in target.layout.blocks:
            continue
        other = target.layout.blocks[name]
        old = np.arange(source.layout.size)[block.columns].reshape(block.shape)
        new = np.arange(target.layout.size)[other.columns].reshape(other.shape)
        if name == "body_positions":
            teammates = [task.layout.blocks["teammates"].shape[0] for task in (source, target)]
            pairs.append((old[: 1 + min(teammates)], new[: 1 + min(teammates)]))
            old, new = old[1 + teammates[0] :], new[1 + teammates[1] :]
        rows = min(len(old), len(new))
        if rows == 0:
            continue
        width = min(old[0].size, new[0].size)
        pairs.append(
            (old[:rows].reshape(rows, -1)[:, :width], new[:rows].reshape(rows, -1)[:, :width])
        )
    return pairs


@pytest.mark.parametrize(("name", "target", "options"), TASKS)
def test_numbers_that_both_tasks_have_act_alike(
    name: str, target: str, options: dict[str, Any]
) -> None:
    policy, source = best(name), rsoccer.make_task(name)
    task = rsoccer.make_task(target, **options)
    other = fitted(policy, task)
    assert (other.observation_size, other.action_size) == (task.layout.size, task.action_size)
    rng = np.random.default_rng(0)
    old: Floats = np.tile(policy.mean, (5, 1))  # rows that the other task lacks count as the mean
    new = rng.normal(size=(5, task.layout.size)).astype(np.float32)
    pairs = common(source, task)
    assert sum(columns.size for columns, _ in pairs) > 30
    for before, after in pairs:
        values = rng.normal(size=(5, before.size)).astype(np.float32)
        old[:, before.ravel()], new[:, after.ravel()] = values, values
    wanted = policy.mean_actions(old)
    assert wanted.std() > 0.05
    found = other.mean_actions(new)
    np.testing.assert_allclose(found[:, : policy.action_size], wanted, atol=1e-5)
    assert (found[:, policy.action_size :] == 0.0).all()


def test_the_value_network_is_taken_along() -> None:
    source, task = rsoccer.make_task("VSSSelfPlay-v0"), rsoccer.make_task("VSSMatch-v0")
    plain, rng = best("VSSSelfPlay-v0"), np.random.default_rng(0)
    weights = rng.normal(size=(1, source.layout.size)).astype(np.float32)
    value = Value([(weights, np.ones(1, np.float32))], 0.95, 3, 2.0)
    policy = Network.from_layers(source, plain.layers, mean=plain.mean, std=plain.std, value=value)
    old: Floats = np.tile(policy.mean, (5, 1))
    new = rng.normal(size=(5, task.layout.size)).astype(np.float32)
    for before, after in common(source, task):
        values = rng.normal(size=(5, before.size)).astype(np.float32)
        old[:, before.ravel()], new[:, after.ravel()] = values, values
    other = fitted(policy, task)
    np.testing.assert_allclose(other.values(new), policy.values(old), rtol=1e-4, atol=1e-4)
    assert other.value is not None
    assert other.value.text == value.text


def test_a_history_is_taken_along_with_each_of_its_parts() -> None:
    task = rsoccer.make_task("VSSMatch-v0")
    plain, source = best("VSSSelfPlay-v0"), rsoccer.make_task("VSSSelfPlay-v0")
    stack = ObservationStack.of(source, 5)
    policy = Network.from_layers(
        source,
        initial_policy.widened_layers(plain, stack),
        history=5,
        sensing="rc2021",
        randomization={"robot.mass": (0.9, 1.1)},
        shield="vsss",
    )
    policy.layers[0][0][:] += np.random.default_rng(1).normal(size=policy.layers[0][0].shape) / 50
    other = fitted(policy, task)
    assert (other.history, other.stack) == (policy.history, ObservationStack.of(task, 5))
    assert other.sensing == policy.sensing
    assert other.randomization == policy.randomization
    assert other.shield is not None
    rng = np.random.default_rng(0)
    pairs = [(a.ravel(), b.ravel()) for a, b in common(source, task)]
    old = np.tile(policy.mean, (5, 1))
    new = rng.normal(size=(5, other.observation_size)).astype(np.float32)
    for nth in range(policy.history):
        for before, after in pairs:
            values = rng.normal(size=(5, before.size)).astype(np.float32)
            old[:, before + nth * source.layout.size] = values
            new[:, after + nth * task.layout.size] = values
    actions = rng.normal(size=(5, 2 * (policy.history - 1))).astype(np.float32)
    old[:, policy.history * source.layout.size :] = actions
    new[:, policy.history * task.layout.size :] = actions
    wanted = policy.mean_actions(old)
    assert wanted.std() > 0.05
    np.testing.assert_allclose(other.mean_actions(new), wanted, atol=1e-5)


def test_runs_begin_with_the_policy_of_another_task(tmp_path: Path) -> None:
    task = rsoccer.make_task("VSSMatch-v0")
    stack = ObservationStack.of(task, 1)
    by_name = initial_policy.load_for_task("VSSSelfPlay-v0", task, stack)
    best("VSSSelfPlay-v0").save(tmp_path / "a.safetensors")
    by_file = initial_policy.load_for_task(str(tmp_path / "a.safetensors"), task, stack)
    for array, other in zip(by_name.arrays().values(), by_file.arrays().values(), strict=True):
        np.testing.assert_array_equal(array, other)
    own = rsoccer.make_task("VSSSelfPlay-v0")
    same = initial_policy.load_for_task("best", own, ObservationStack.of(own, 1))
    np.testing.assert_array_equal(same.layers[0][0], best("VSSSelfPlay-v0").layers[0][0])


@pytest.mark.parametrize(
    ("name", "target", "message"),
    [
        ("SSLGoToBall-v0", "VSS-v0", "network.initial_policy: expected a policy of the league of"),
        ("VSSNone-v0", "VSS-v0", "network.initial_policy: "),
        ("none.safetensors", "VSS-v0", "network.initial_policy: .*does not exist"),
    ],
)
def test_other_policies_are_refused(name: str, target: str, message: str) -> None:
    task = rsoccer.make_task(target)
    with pytest.raises(ValueError, match=message):
        initial_policy.load_for_task(name, task, ObservationStack.of(task, 1))
