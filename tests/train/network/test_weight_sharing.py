"""Shared weights: the order of robots changes nothing, before and after training."""

from pathlib import Path

import numpy as np
import pytest
import torch
from torch import nn

from rsoccer import list_tasks, make_task
from rsoccer.arrays import Floats
from rsoccer.history import ObservationStack
from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.network.weight_sharing import Indices, WeightSharing, robot_slots
from rsoccer.train.run.trainer import Trainer
from tests.train.short_task import tiny

TASKS = ("VSSMulti-v0", "SSLStaticDefenders-v0")


def swapped(observations: Floats, columns: Indices) -> Floats:
    """Observations with the last robot of a team in the first slot, and the others after it."""
    result = observations.copy()
    result[..., columns] = np.roll(observations[..., columns], 1, axis=-2)
    return result


@pytest.mark.parametrize("task", TASKS)
@pytest.mark.parametrize(("central", "history"), [(False, 1), (True, 1), (True, 2)])
def test_the_order_of_robots_changes_nothing(
    task: str, central: bool, history: int, tmp_path: Path
) -> None:
    changes = {"robot_units": 3, "hidden_sizes": (8, 6, 5), "history": history}
    args = tiny(tmp_path, task=task, central_critic=central, **changes)
    trainer = Trainer(args)
    before = nn.utils.parameters_to_vector(trainer.model.parameters()).detach().clone()
    for _ in range(2):
        trainer.update(trainer.collect_rollout(lambda: None), lambda: None)
    after = nn.utils.parameters_to_vector(trainer.model.parameters()).detach()
    assert not torch.equal(before, after), "nothing was learned"
    actor, critic = trainer.model.actor, trainer.model.critic
    rng = np.random.default_rng(0)
    inputs = rng.normal(size=(5, trainer.stack.size)).astype(np.float32)
    critic_inputs = next(critic.parameters()).shape[1]
    states = rng.normal(size=(5, critic_inputs - inputs.shape[1])).astype(np.float32)
    with torch.no_grad():
        for columns in robot_slots(trainer.task, trainer.stack):
            moved = swapped(inputs, columns)
            assert np.abs(moved - inputs).max() > 1.0
            torch.testing.assert_close(actor(torch.tensor(moved)), actor(torch.tensor(inputs)))
            both = (np.concatenate([states, part], axis=1) for part in (inputs, moved))
            torch.testing.assert_close(*(critic(torch.tensor(part)) for part in both))
        other = rng.permutation(inputs.T).T.copy()
        assert (actor(torch.tensor(other)) - actor(torch.tensor(inputs))).abs().max() > 1e-3


def test_the_exported_policy_is_a_wider_perceptron(tmp_path: Path) -> None:
    args = tiny(tmp_path, task="SSLStaticDefenders-v0", robot_units=3, hidden_sizes=(8, 6))
    network = Network.load(train(args))
    assert [weight.shape[0] for weight, _ in network.layers] == [8 + 6 * 3, 6, 5]
    resumed = tiny(tmp_path, task=args.task, robot_units=3, hidden_sizes=(8, 6), resume=True)
    assert train(resumed)


def test_every_slot_of_a_robot_is_in_its_team() -> None:
    sizes = {}
    for name in list_tasks():
        task = make_task(name)
        try:
            slots = robot_slots(task, ObservationStack.of(task, 1))
        except ValueError as error:
            assert "robot_units must be 0" in str(error)
            continue
        columns = np.concatenate([part.reshape(-1) for part in slots])
        assert len(np.unique(columns)) == len(columns)
        sizes[name] = [len(part) for part in slots]
    assert sizes["VSS-v0"] == [2, 3]
    assert sizes["SSLStaticDefenders-v0"] == [6]
    assert sizes["SSLDribbling-v0"] == [4]
    assert "SSLContestedPossession-v0" not in sizes


def test_the_mean_gradient_of_a_group_replaces_its_gradients(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, task="VSSMulti-v0", robot_units=2))
    slots = robot_slots(trainer.task, trainer.stack)
    sharing = WeightSharing(slots, 2, trainer.task.layout.size, trainer.model)
    size = sum(parameter.numel() for parameter in trainer.model.parameters())
    gradient = torch.randn(size, generator=torch.Generator().manual_seed(1))
    mean = sharing.average(gradient)
    torch.testing.assert_close(mean.sum(), gradient.sum())
    torch.testing.assert_close(sharing.average(mean), mean)
    assert len(set(mean.tolist())) < 0.7 * size


def test_a_task_without_exchangeable_robots_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="robot_units must be 0"):
        train(tiny(tmp_path / "run", task="SSLGoToBall-v0", robot_units=4))
    assert not (tmp_path / "run" / "args.json").exists()
