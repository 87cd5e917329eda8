"""Gymnasium's wrappers around one match: several at once, on every task."""

import gymnasium
import numpy as np
import pytest
from gymnasium import wrappers

from rsoccer.envs.single import single_env
from tests.single_learner import TASKS, draw, learner_options, short_env


@pytest.mark.parametrize("name", TASKS)
def test_wrappers_do_not_change_the_match(name: str) -> None:
    inner = single_env(name, max_steps=9, **learner_options(name))
    four = np.full(inner.task.action_size, 4.0, np.float32)
    env: gymnasium.Env[np.ndarray, np.ndarray] = wrappers.RecordEpisodeStatistics(inner)
    env = wrappers.RescaleAction(env, -four, four)
    env = wrappers.NormalizeReward(wrappers.NormalizeObservation(env))
    bare = short_env(name, max_steps=9)
    rng = np.random.default_rng(0)
    for seed in range(3):
        env.reset(seed=seed)
        bare.reset(seed=seed)
        total, steps, ended = 0.0, 0, False
        while not ended:
            action = draw(bare, rng)
            observation, _, *given, info = env.step(action * 4)
            _, reward, *expected, expected_info = bare.step(action)
            total, steps = total + reward, steps + 1
            assert given == expected
            assert np.isfinite(observation).all()
            ended = any(expected)
        statistics = info.pop("episode")
        assert info == expected_info
        assert statistics["l"] == steps
        assert statistics["r"] == pytest.approx(total)
        assert inner._matches.frame.rows.tolist() == bare._matches.frame.rows.tolist()
