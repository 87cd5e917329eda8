"""The task that a policy was trained on, with the options that matter in play."""

from pathlib import Path

import numpy as np
import pytest

import rsoccer
from rsoccer import policies
from rsoccer.policies.network import Network
from rsoccer.task import Task
from rsoccer.tasks import SslStaticDefenders


def save(path: Path, task: Task, **task_options: object) -> Path:
    size = (task.action_size, task.layout.size)
    layers = [(np.zeros(size, np.float32), np.zeros(size[0], np.float32))]
    Network.from_layers(task, layers, task_options=task_options).save(path)
    return path


@pytest.mark.parametrize("name", rsoccer.list_tasks())
def test_training_options_are_options_of_the_task(name: str) -> None:
    task = rsoccer.make_task(name)
    assert "reward_weights" in task.training_options
    assert all(hasattr(task, option) for option in task.training_options)
    is_training = [option for option in ("random_start", "random_holder") if hasattr(task, option)]
    assert set(is_training) <= set(task.training_options)


def test_options_of_play_are_those_of_the_training(tmp_path: Path) -> None:
    options = {"n_opponents": 2, "velocity_frame": "robot"}
    task = rsoccer.make_task("SSLStaticDefenders-v0", **options)
    training = {"random_start": True, "reward_weights": {"failed": -0.3}}
    path = save(tmp_path / "policy.safetensors", task, **options, **training)
    found = policies.trained_on(path)
    assert isinstance(found, SslStaticDefenders)
    assert (found.n_opponents, found.velocity_frame) == (2, "robot")
    assert not found.random_start
    assert found.reward_weights == SslStaticDefenders().reward_weights
    assert rsoccer.evaluate(path, matches=2, worlds=2).matches == 2


def test_actions_of_another_meaning_are_refused(tmp_path: Path) -> None:
    task = rsoccer.make_task("SSLGoToBall-v0")
    turned = rsoccer.make_task("SSLGoToBall-v0", velocity_frame="robot")
    path = save(tmp_path / "policy.safetensors", task)
    policies.make_policy(path, task)
    for policy in (path, "best"):
        with pytest.raises(ValueError, match="velocity in the robot's axes"):
            policies.make_policy(policy, turned)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ('["n_opponents"]', "'task_options' should be a JSON object"),
        ('{"n_opponents": 2', "'task_options' should be a JSON object"),
        ('{"no_such": 2}', "policy: trained on a task with other options.*'no_such'"),
        ('{"n_opponents": 99}', "n_opponents"),
    ],
)
def test_wrong_options_are_refused(options: str, message: str, tmp_path: Path) -> None:
    path = save(tmp_path / "policy.safetensors", rsoccer.make_task("SSLGoToBall-v0"))
    network = Network.load(path)
    network.metadata["task_options"] = options
    network.save(path)
    with pytest.raises(ValueError, match=message):
        policies.trained_on(path)


def test_a_missing_policy_of_the_training_is_named(tmp_path: Path) -> None:
    lost = str(tmp_path / "lost.safetensors")
    path = save(tmp_path / "policy.safetensors", rsoccer.make_task("VSS-v0"), opponent=lost)
    with pytest.raises(ValueError, match=r"trained beside the policy .*lost.safetensors.*a task"):
        rsoccer.evaluate(path, matches=2)
    assert rsoccer.evaluate(path, matches=2, task="VSS-v0", worlds=2).matches == 2
