"""Agents in the form of CleanRL's scripts as policies, against the agents themselves."""

from typing import Any

import gymnasium
import numpy as np
import pytest
import torch
from torch import Tensor, nn

import rsoccer
from rsoccer.policies.libraries import from_cleanrl
from rsoccer.registry import make_task

TASK = "VSSMulti-v0"
SIZE, ACTION = make_task(TASK).layout.size, make_task(TASK).action_size


class PpoAgent(nn.Module):
    """The parts of `ppo_continuous_action.py`."""

    def __init__(self) -> None:
        super().__init__()
        self.actor_mean = nn.Sequential(nn.Linear(SIZE, 32), nn.Tanh(), nn.Linear(32, ACTION))
        self.actor_logstd = nn.Parameter(torch.full((1, ACTION), -0.5))
        self.critic = nn.Linear(SIZE, 1)


class SacActor(nn.Module):
    """The actor of `sac_continuous_action.py`."""

    action_scale: Tensor

    def __init__(self, activation: Any = torch.relu, scale: float = 1.0) -> None:  # noqa: ANN401
        super().__init__()
        self.fc1, self.fc2 = nn.Linear(SIZE, 32), nn.Linear(32, 16)
        self.fc_mean, self.fc_logstd = nn.Linear(16, ACTION), nn.Linear(16, ACTION)
        self.activation = activation
        self.register_buffer("action_scale", torch.full((ACTION,), scale))

    def forward(self, x: Tensor) -> tuple[Tensor, Tensor]:
        x = self.activation(self.fc2(self.activation(self.fc1(x))))
        log_std = torch.tanh(self.fc_logstd(x))
        return self.fc_mean(x), -5 + 0.5 * (2 + 5) * (log_std + 1)


class Td3Actor(nn.Module):
    """The actor of `td3_continuous_action.py`."""

    def __init__(self) -> None:
        super().__init__()
        self.fc1, self.fc2 = nn.Linear(SIZE, 32), nn.Linear(32, 16)
        self.fc_mu = nn.Linear(16, ACTION)

    def forward(self, x: Tensor) -> Tensor:
        return torch.tanh(self.fc_mu(torch.relu(self.fc2(torch.relu(self.fc1(x))))))


class Discrete(nn.Module):
    """The parts of `ppo.py` and of `dqn.py`, for a task with nine choices."""

    def __init__(self, name: str, choices: int) -> None:
        super().__init__()
        size = make_task("VSS-v0").layout.size
        layers = nn.Sequential(nn.Linear(size, 32), nn.ReLU(), nn.Linear(32, choices))
        self.add_module(name, layers)


def observations(size: int = SIZE) -> np.ndarray:
    return np.random.default_rng(0).uniform(-3.0, 3.0, (50, size)).astype(np.float32)


def test_a_normalization_of_ones_own_applies() -> None:
    agent, inputs = PpoAgent(), observations()
    mean, std = np.linspace(-1.0, 1.0, SIZE), np.linspace(0.1, 2.0, SIZE)
    for clip in (10.0, 1.5):
        network = from_cleanrl(agent, TASK, mean=mean, std=std, clip=clip)
        normalized = ((inputs - mean) / std).clip(-clip, clip).astype(np.float32)
        assert np.abs(normalized).max() == clip
        expected = agent.actor_mean(torch.from_numpy(normalized)).clamp(-1, 1).detach()
        np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)


def test_gaussians_of_ppo() -> None:
    torch.manual_seed(0)
    agent, inputs = PpoAgent(), observations()
    network = from_cleanrl(agent, TASK)
    expected = agent.actor_mean(torch.from_numpy(inputs)).clamp(-1, 1).detach()
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    assert network.action_std == pytest.approx(np.exp([-0.5] * ACTION))


def test_squashed_gaussians_of_sac() -> None:
    torch.manual_seed(0)
    actor, inputs = SacActor(), observations()
    network = from_cleanrl(actor, TASK)
    mean, log_std = actor(torch.from_numpy(inputs))
    expected = torch.tanh(mean).detach()
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    assert network.head.deviation is not None
    std = network.head.deviation.of(network.outputs(inputs)[:, ACTION:])
    np.testing.assert_allclose(std, log_std.exp().detach(), rtol=1e-4)


def test_deterministic_actors() -> None:
    torch.manual_seed(0)
    actor, inputs = Td3Actor(), observations()
    network = from_cleanrl(actor, TASK)
    expected = actor(torch.from_numpy(inputs)).detach()
    np.testing.assert_allclose(network.mean_actions(inputs), expected, rtol=0, atol=2e-6)
    assert network.mode == "mean"


@pytest.mark.parametrize(("name", "head"), [("actor", "categorical"), ("network", "greedy")])
def test_discrete_agents(name: str, head: str) -> None:
    task = make_task("VSS-v0", discrete=True)
    assert task.action_table is not None
    torch.manual_seed(0)
    agent, inputs = Discrete(name, len(task.action_table)), observations(task.layout.size)
    network = from_cleanrl(agent, task)
    rows = getattr(agent, name)(torch.from_numpy(inputs)).argmax(dim=1)
    assert len(set(rows.tolist())) > 1
    assert np.array_equal(network.mean_actions(inputs), task.action_table[rows])
    assert network.head.kind == head


def test_the_normalization_of_gymnasium_is_part_of_the_policy() -> None:
    envs = gymnasium.make_vec("rsoccer/VSSMulti-v0", num_envs=24)
    plain = envs.reset(seed=0)[0]
    wrapped = gymnasium.wrappers.vector.NormalizeObservation(envs)
    wrapped.reset(seed=0)
    for _ in range(5):
        wrapped.step(wrapped.action_space.sample())
    wrapped.update_running_mean = False
    normalized, _ = wrapped.reset(seed=0)
    agent = PpoAgent()
    network = from_cleanrl(agent, envs=wrapped)
    expected = agent.actor_mean(torch.from_numpy(normalized).float().clamp(-10, 10))
    np.testing.assert_allclose(
        network.mean_actions(plain), expected.clamp(-1, 1).detach(), rtol=0, atol=1e-5
    )
    assert not np.allclose(plain, normalized)
    assert (network.task_name, float(network.clip)) == (TASK, 10.0)
    assert rsoccer.evaluate(network, "zero", matches=2).matches == 2


def test_senses_and_varied_numbers_of_the_environments_stay_with_the_policy() -> None:
    conditions: dict[str, Any] = {
        "sensing": "vsss, forecast=1",
        "randomization": {"robot.mass": (0.9, 1.1)},
    }
    envs = gymnasium.make_vec("rsoccer/VSSMulti-v0", num_envs=24, **conditions)
    network = from_cleanrl(PpoAgent(), envs=gymnasium.wrappers.vector.NormalizeObservation(envs))
    assert network.needs_forecast
    assert network.randomization == {"robot.mass": [0.9, 1.1]}
    one = gymnasium.vector.SyncVectorEnv(
        [lambda: gymnasium.make("rsoccer/VSSMulti-v0", learner="blue_0", **conditions)]
    )
    assert from_cleanrl(PpoAgent(), envs=one).needs_forecast
    assert not from_cleanrl(PpoAgent(), "VSSMulti-v0").needs_forecast


def test_other_agents_are_refused() -> None:
    with pytest.raises(ValueError, match=r"agent: expected one with the parts .*, got 0"):
        from_cleanrl(nn.Sequential(nn.Linear(SIZE, ACTION)), TASK)
    with pytest.raises(ValueError, match="expected ReLU after fc1 and fc2"):
        from_cleanrl(SacActor(torch.tanh), TASK)
    with pytest.raises(ValueError, match=r"expected an action_scale of 1\.0, got \[2\.0"):
        from_cleanrl(SacActor(scale=2.0), TASK)
    with pytest.raises(ValueError, match="task: expected the task"):
        from_cleanrl(PpoAgent())
