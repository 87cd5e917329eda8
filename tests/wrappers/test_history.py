"""Stacked observations in the environments for trainer libraries."""

from typing import Any

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Floats
from tests.helpers import same
from tests.stacks import HandStack

TASK, WORLDS, HISTORY, LIMIT, STEPS = "VSSMulti-v0", 2, 3, 5, 12


def expected_stacks(actions: Floats) -> list[tuple[Floats, Floats]]:
    """Observations after a reset with seed 4 and after each step, and those before new episodes."""
    plain = Matches(TASK, WORLDS, max_steps=LIMIT)
    hand = HandStack(HISTORY, plain.action_size)  # all matches end at the time limit
    hand.begin(plain.reset(seed=4))
    stacks = [(hand.value, hand.value)]
    for each in actions:
        outcome = plain.step(each)
        hand.step(each, outcome.final_observations)
        final = hand.value
        if outcome.ended.any():
            assert outcome.ended.all()
            hand.begin(outcome.observations)
        stacks.append((hand.value, final))
    return stacks


@pytest.fixture
def actions() -> Floats:
    """Actions (steps, n, agents, action)."""
    shape = (STEPS, WORLDS, 3, 2)
    return np.random.default_rng(0).uniform(-1, 1, shape).astype(np.float32)


def test_stable_baselines3(actions: Floats) -> None:
    pytest.importorskip("stable_baselines3")
    from rsoccer.sb3 import SoccerVecEnv, SoccerVecNormalize

    envs = SoccerVecEnv(TASK, WORLDS, history=HISTORY, max_steps=LIMIT)
    stacks = expected_stacks(actions)
    envs.seed(4)
    size = envs.observation_space.shape[0]
    assert same(envs.reset(), stacks[0][0].reshape(-1, size))
    for each, (observations, final) in zip(actions, stacks[1:], strict=True):
        given, _, ends, infos = envs.step(each.reshape(-1, 2))
        assert same(given, observations.reshape(-1, size))
        assert envs.observation_space.contains(given[0])
        for row in np.flatnonzero(ends):
            assert same(infos[row]["terminal_observation"], final.reshape(-1, size)[row])
    assert SoccerVecNormalize(envs).reset().shape == given.shape


def test_torchrl(actions: Floats) -> None:
    torch = pytest.importorskip("torch")
    pytest.importorskip("torchrl")
    from torchrl.envs.utils import check_env_specs

    from rsoccer.torchrl import SoccerEnv

    env = SoccerEnv(TASK, WORLDS, history=HISTORY, max_steps=LIMIT)
    check_env_specs(env, seed=1)
    env.set_seed(4)
    data = env.reset()
    stacks = expected_stacks(actions)
    for each, (observations, _), (_, final) in zip(actions, stacks, stacks[1:], strict=False):
        assert same(data["blue", "observation"].numpy(), observations)
        data["blue", "action"] = torch.from_numpy(each)
        before, data = env.step_and_maybe_reset(data)
        assert same(before["next", "blue", "observation"].numpy(), final)


def test_rllib(actions: Floats) -> None:
    pytest.importorskip("torch")
    pytest.importorskip("ray.rllib")
    from rsoccer.rllib import SoccerMultiAgentEnv

    config: dict[str, Any] = {"task": TASK, "history": HISTORY, "max_steps": LIMIT}
    env = SoccerMultiAgentEnv(config)
    observations, _ = env.reset(seed=4)
    names, stacks = env.possible_agents, expected_stacks(actions)
    for step in range(LIMIT):
        assert env.observation_space.contains(observations)
        observations, *_ = env.step(dict(zip(names, actions[step, 0], strict=True)))
        assert same(np.stack([observations[name] for name in names]), stacks[step + 1][1][0])
