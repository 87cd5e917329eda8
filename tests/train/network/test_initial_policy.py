"""Runs that begin with the weights of a trained policy."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.history import ObservationStack
from rsoccer.policies import make_policy
from rsoccer.policies.network import Network
from rsoccer.train.network import initial_policy
from rsoccer.train.run.trainer import Trainer
from tests.policies.networks import random_network
from tests.train.one_update import one_update

TASK = "SSLGoToBall-v0"


def best() -> Network:
    policy = make_policy("best", TASK)
    assert isinstance(policy, Network)
    return policy


def trainer(folder: Path, history: int = 1, **network: Any) -> Trainer:  # noqa: ANN401  (any field)
    args = one_update(TASK, folder)
    settings: dict[str, Any] = {"hidden_sizes": (128, 128), "initial_policy": "best", **network}
    ppo = dataclasses.replace(args.ppo, critic_warmup=1)
    changed = dataclasses.replace(args.network, **settings)
    return Trainer(dataclasses.replace(args, history=history, network=changed, ppo=ppo))


@pytest.mark.parametrize("history", [1, 3])
def test_a_run_begins_as_the_policy_plays(history: int, tmp_path: Path) -> None:
    task = rsoccer.make_task(TASK)
    stack = ObservationStack.of(task, history)
    observations = np.random.default_rng(0).normal(size=(7, stack.size)).astype(np.float32)
    run = trainer(tmp_path, history)
    found = run.network().mean_actions(observations)
    wanted = best().mean_actions(observations[:, : task.layout.size])
    assert wanted.std() > 0.1
    np.testing.assert_allclose(found, wanted, atol=2e-6)
    run.close()


def test_inputs_that_the_run_does_not_read_have_no_weights(tmp_path: Path) -> None:
    """The policy that is saved has no mask, so it must not read them either."""
    run = trainer(tmp_path, masked_observations=("ball",))
    network, layout = run.network(), run.task.layout
    ball = layout.blocks["ball"].columns
    weights = network.layers[0][0]
    assert not weights[:, ball].any()
    assert np.count_nonzero(weights) == weights.size - weights[:, ball].size
    observations = np.random.default_rng(0).normal(size=(7, layout.size)).astype(np.float32)
    before = network.mean_actions(observations)
    observations[:, ball] += 1.0
    np.testing.assert_array_equal(network.mean_actions(observations), before)
    run.close()


def test_past_observations_are_normalized_as_the_current_one() -> None:
    task = rsoccer.make_task(TASK)
    stack, size = ObservationStack.of(task, 3), task.layout.size
    mean, std = initial_policy.widened_normalization(best(), stack)
    assert mean.shape == std.shape == (stack.size,)
    np.testing.assert_array_equal(mean[size : 2 * size], best().mean)
    np.testing.assert_array_equal(std[2 * size : 3 * size], best().std)
    assert (mean[3 * size :] == 0.0).all()
    assert (std[3 * size :] == 1.0).all()


def test_the_policy_stays_while_the_value_network_warms_up(tmp_path: Path) -> None:
    run = trainer(tmp_path)
    actor = [part.clone() for part in run.model.actor.parameters()]
    critic = [part.clone() for part in run.model.critic.parameters()]
    for update in range(2):
        run.update(run.collect_rollout(lambda: None), lambda: None)
        stays = all(
            (a == b).all() for a, b in zip(actor, run.model.actor.parameters(), strict=True)
        )
        assert stays == (update == 0)
        learned = zip(critic, run.model.critic.parameters(), strict=True)
        assert any((a != b).any() for a, b in learned)
    run.close()


def test_policies_that_do_not_fit_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"initial_policy: expected layers of \[8, 5\] units.*128"):
        trainer(tmp_path, hidden_sizes=(8,))
    with pytest.raises(ValueError, match="initial_policy: expected a trained policy, got 'fetch'"):
        trainer(tmp_path, initial_policy="fetch")
    with pytest.raises(ValueError, match=r"network\.initial_policy: .*does not exist"):
        trainer(tmp_path, initial_policy=str(tmp_path / "none.safetensors"))
    long = trainer(tmp_path, 2)
    long.network().save(tmp_path / "long.safetensors")
    long.close()
    with pytest.raises(ValueError, match="at most the run's history of 1, got one of 2"):
        trainer(tmp_path, initial_policy=str(tmp_path / "long.safetensors"))


@pytest.mark.parametrize(("kind", "activation"), [("gaussian", "relu"), ("squashed", "tanh")])
def test_other_networks_than_the_trainers_are_refused(
    kind: str, activation: str, tmp_path: Path
) -> None:
    path = tmp_path / "other.safetensors"
    random_network(kind, activation).save(path)
    task = rsoccer.make_task("VSS-v0")
    with pytest.raises(ValueError, match=f"tanh layers .* got {activation} layers .* {kind!r}"):
        initial_policy.load(str(path), task, ObservationStack.of(task, 1))
