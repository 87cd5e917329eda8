"""Stacked observations in RLlib's environment."""

from typing import Any

import numpy as np
import pytest

from tests.helpers import same
from tests.stacks import HISTORY, LIMIT, TASK, WORLDS, expected_stacks

pytest.importorskip("torch")
pytest.importorskip("ray.rllib")

from rsoccer.rllib import SoccerMultiAgentEnv

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning", "ignore::UserWarning")


def test_observations_are_stacks() -> None:
    actions = np.random.default_rng(0).uniform(-1, 1, (LIMIT, WORLDS, 3, 2)).astype(np.float32)
    config: dict[str, Any] = {"task": TASK, "history": HISTORY, "max_steps": LIMIT}
    env = SoccerMultiAgentEnv(config)
    observations, _ = env.reset(seed=4)
    names, stacks = env.possible_agents, expected_stacks(actions)
    for step in range(LIMIT):
        assert env.observation_space.contains(observations)
        observations, *_ = env.step(dict(zip(names, actions[step, 0], strict=True)))
        assert same(np.stack([observations[name] for name in names]), stacks[step + 1][1][0])
