"""Central critic: its inputs are states of the match and observations; the policy has none."""

from itertools import pairwise
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest
import torch

import rsoccer
from rsoccer import LEARN, Matches
from rsoccer.arrays import Floats
from rsoccer.policies.network import Network
from rsoccer.train import train
from rsoccer.train.ppo.batch import Batch
from rsoccer.train.ppo.mirror import with_reflections
from rsoccer.train.rollout.central_inputs import CentralInputs
from rsoccer.train.rollout.transition import Transition, repeat_action
from rsoccer.train.run import checkpoint
from rsoccer.train.run.trainer import Trainer
from tests.train.rollout.test_transition import NEVER, FakeMatches
from tests.train.runs import digest, run_until
from tests.train.short_task import NAME, tiny

CENTRAL: dict[str, Any] = {"central_critic": True}


class FakeStates(FakeMatches):
    """States are 10 x step + world, as rewards and observations are."""

    def states(self) -> Floats:
        values = np.arange(3).astype(np.float32) + np.float32(10 * self.steps)
        return np.repeat(values[:, None], 5, axis=1)


def test_states_are_the_last_ones_of_the_episode() -> None:
    # World 0 terminates in the first step, world 1 is truncated in the second.
    matches = cast("Matches", FakeStates([1, NEVER, NEVER], [NEVER, 2, NEVER]))
    actions = np.ones((3, 2, 2), np.float32)
    transition = repeat_action(matches, actions, 4, with_states=True)
    assert transition.states is not None
    assert transition.states.shape == (3, 5)
    assert transition.states[:, 0].tolist() == [10.0, 21.0, 42.0]
    assert repeat_action(matches, actions, 1).states is None


def recorded(args: Any, monkeypatch: pytest.MonkeyPatch) -> tuple[Trainer, Batch, list[Any]]:  # noqa: ANN401
    """Trainer and its second batch, with states before and after each decision."""
    trainer, seen = Trainer(args), []
    trainer.collect_rollout(lambda: None)
    collector = trainer.collector

    def record(matches: Matches, *rest: Any, **options: Any) -> Transition:  # noqa: ANN401
        before = matches.states()
        transition = repeat_action(matches, *rest, **options)
        seen.append((before, transition.states))
        return transition

    monkeypatch.setattr("rsoccer.train.rollout.collector.repeat_action", record)
    assert collector.central is not None
    mean, std = (part.copy() for part in collector.central.rms.as_float32())
    batch = trainer.collect_rollout(lambda: None)
    return trainer, batch, [(mean, std), *seen]


@pytest.mark.parametrize("solo_fraction", [0.0, 0.34])
def test_inputs_are_the_state_and_the_robots_observation(
    solo_fraction: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    args = tiny(tmp_path, solo_fraction=solo_fraction, **CENTRAL)
    trainer, batch, ((mean, std), *seen) = recorded(args, monkeypatch)
    matches = trainer.collector.matches
    assert len(matches.agents) == (1 if solo_fraction else 3)
    assert batch.central_inputs is not None
    size = matches.state_size
    states, observations = batch.critic_inputs[:, :size], batch.critic_inputs[:, size:]
    assert torch.equal(observations, batch.observations)
    expected = np.concatenate([before for before, _ in seen])
    expected = ((expected - mean) / std).clip(-10, 10).repeat(len(matches.agents), axis=0)
    np.testing.assert_allclose(states.numpy(), expected, atol=1e-5)
    assert np.abs(expected).max() > 0.5
    ended = [(after != later).any() for (_, after), (later, _) in pairwise(seen)]
    assert any(ended), "no episode ended"


def test_the_policy_stays_decentralized(tmp_path: Path, finished: Path) -> None:
    policy = Network.load(train(tiny(tmp_path, **CENTRAL)))
    task = rsoccer.make_task(NAME)
    policy.check_fits(task, task.layout.size)
    plain = Network.load(finished / "policy.safetensors")
    assert plain.metadata.pop("value"), "a value network that reads no more than a robot observes"
    plain.value = None
    assert policy.metadata == plain.metadata
    assert policy.arrays().keys() == plain.arrays().keys()
    saved = checkpoint.load(tmp_path / checkpoint.FILE_NAME).arrays
    state_size = Matches(task, 1).state_size
    assert saved["model.critic.0.weight"].shape[1] == state_size + task.layout.size
    assert saved["model.actor.0.weight"].shape[1] == task.layout.size


MIRRORED = {
    **{"mirror_augmentation": True, "task": "VSS-v0", "task_options": {"max_steps": 30}},
    "samples": 6 * 8 * 6,
}


@pytest.mark.parametrize("changes", [{}, MIRRORED], ids=["self-play", "mirrored"])
def test_a_resumed_run_equals_the_uninterrupted_one(
    changes: dict[str, Any], tmp_path: Path
) -> None:
    settings = {**CENTRAL, **changes}
    one, other = tmp_path / "one", tmp_path / "other"
    train(tiny(one, **settings))
    for checks in (5, 3 * 13 + 10):
        folder = other / str(checks)
        folder.mkdir(parents=True)
        run_until(tiny(folder, **settings), checks)
        train(tiny(folder, resume=True, **settings))
        assert digest(folder) == digest(one)
    saved = checkpoint.load(one / checkpoint.FILE_NAME).arrays
    assert {"run.states", "state_rms.mean"} <= set(saved)


def test_reflected_samples_have_reflected_states(tmp_path: Path) -> None:
    trainer = Trainer(tiny(tmp_path, mirror_augmentation=True, **CENTRAL))
    trainer.collect_rollout(lambda: None)
    batch = trainer.collect_rollout(lambda: None)
    both = with_reflections(batch, trainer.task, trainer.stack, trainer.evaluator)
    reflected, size = both.critic_inputs[len(batch) :], trainer.collector.matches.state_size
    assert torch.equal(reflected[:, size:], both.observations[len(batch) :])
    kept, negated = [
        (reflected[:, :size] == sign * batch.critic_inputs[:, :size]).all(0) for sign in (1, -1)
    ]
    assert (kept | negated).all() and kept.any() and negated.any()


def test_values_depend_on_robots_that_are_not_observed(tmp_path: Path) -> None:
    """A minibatch keeps its states, and the loss reaches the weights of the states."""
    trainer = Trainer(tiny(tmp_path, **CENTRAL))
    batch = trainer.collect_rollout(lambda: None)
    indices = torch.tensor([5, 2])
    assert torch.equal(batch.select(indices).critic_inputs, batch.critic_inputs[indices])
    size = trainer.collector.matches.state_size
    weights = next(trainer.model.critic.parameters())
    before = weights[:, :size].detach().clone()
    trainer.update(batch, lambda: None)
    assert (weights[:, :size].detach() != before).any(dim=0).float().mean() > 0.8


def test_all_controllers_learning_gives_each_robot_the_same_state() -> None:
    matches = Matches(NAME, 2, controllers={"all": LEARN}, autoreset="disabled")
    matches.reset()
    inputs = CentralInputs(matches.task, symmetric=False)
    rows = inputs.join(matches.states(), torch.arange(12.0)[:, None])
    assert torch.equal(rows[0, :-1], rows[5, :-1]) and not torch.equal(rows[5], rows[6])
    assert rows[:, -1].tolist() == list(range(12))
