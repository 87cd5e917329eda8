"""Stacked observations in the environments for trainer libraries."""

import numpy as np
import pytest

from rsoccer.arrays import Floats
from tests.helpers import same
from tests.stacks import HISTORY, LIMIT, STEPS, TASK, WORLDS, expected_stacks


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
