"""Gymnasium's wrappers give the same results as around its own loop over single envs."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.wrappers import vector as wrappers

from rsoccer.envs.robots_vector import robots_vector_env
from rsoccer.envs.vector import vector_env
from tests.helpers import comparable
from tests.single_learner import learner_options, one_by_one, without_times

N = 3
NAMES = ["VSS-v0", "SSLPassEndurance-v1"]  # two suffice: wrappers do not depend on the task
MODES = list(AutoresetMode)

Envs = VectorEnv[Any, Any, Any]
Wrap = Callable[[Envs], Envs]


def both(name: str, mode: AutoresetMode, wrap: Wrap) -> list[Envs]:
    ours = vector_env(name, N, autoreset_mode=mode, max_steps=7, **learner_options(name))
    return [wrap(ours), wrap(one_by_one(name, N, mode, max_steps=7))]


def rescaled(envs: Envs) -> Envs:
    four = np.full(envs.single_action_space.shape or (), 4.0, np.float32)
    return wrappers.RescaleAction(envs, -four, four)


def played(envs: Envs, mode: AutoresetMode, high: float = 1.0) -> list[Any]:
    """Results of some episodes except their wall time; all matches are reset together."""
    rng = np.random.default_rng(0)
    transcript = [comparable(envs.reset(seed=3))]
    for _ in range(24):
        actions = rng.uniform(-high, high, envs.action_space.shape or ())
        *arrays, infos = envs.step(actions.astype(np.float32))
        transcript.append(comparable([*arrays, without_times(infos)]))
        if mode is AutoresetMode.DISABLED and (arrays[2] | arrays[3]).any():
            transcript.append(comparable(envs.reset()))
    return transcript


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
@pytest.mark.parametrize(
    ("wrap", "high"),
    [
        (wrappers.RecordEpisodeStatistics, 1.0),
        (wrappers.NormalizeReward, 1.0),
        (rescaled, 4.0),
    ],
    ids=["RecordEpisodeStatistics", "NormalizeReward", "RescaleAction"],
)
def test_wrappers_work_in_every_mode(
    name: str, mode: AutoresetMode, wrap: Wrap, high: float
) -> None:
    ours, theirs = both(name, mode, wrap)
    assert played(ours, mode, high) == played(theirs, mode, high)


@pytest.mark.parametrize("name", NAMES)
def test_observations_can_be_normalized(name: str) -> None:
    mode = AutoresetMode.NEXT_STEP  # the wrapper refuses the others
    ours, theirs = both(name, mode, wrappers.NormalizeObservation)
    assert played(ours, mode) == played(theirs, mode)


def test_statistics_restart_only_in_the_matches_that_are_reset() -> None:
    """Not compared: Gymnasium's loop removes the mask from the options before its wrapper."""
    envs = wrappers.RecordEpisodeStatistics(vector_env("VSS-v0", 2, max_steps=9))
    envs.reset(seed=0)
    actions = np.zeros((2, 2), np.float32)
    for _ in range(3):
        envs.step(actions)
    envs.reset(options={"reset_mask": np.array([False, True])})
    assert envs.episode_lengths.tolist() == [3, 0]


def test_episode_statistics_come_with_our_metrics() -> None:
    envs = wrappers.RecordEpisodeStatistics(vector_env("VSS-v0", 2, max_steps=9))
    envs.reset(seed=0)
    for _ in range(9):
        infos = envs.step(np.zeros((2, 2), np.float32))[4]
    assert infos["episode"]["l"].tolist() == infos["steps"].tolist() == [9, 9]
    assert infos["_goal_score"].all()


def test_the_statistics_of_episodes_are_where_scripts_for_the_same_step_read_them() -> None:
    """CleanRL's scripts for Gymnasium 1.1 read them, without a wrapper around all rows."""
    envs = robots_vector_env("VSSMulti-v0", 6, autoreset_mode="same_step", max_steps=40)
    envs.reset(seed=0)
    total = np.zeros(6)
    rng = np.random.default_rng(0)
    for _ in range(40):
        actions = rng.uniform(-1, 1, (6, 2)).astype(np.float32)
        _, rewards, _, truncated, infos = envs.step(actions)
        total += rewards
    assert truncated.all()
    final = infos["final_info"]
    assert final["_episode"].tolist() == [True] * 6
    assert final["episode"]["l"].tolist() == [40] * 6
    np.testing.assert_allclose(final["episode"]["r"], total, rtol=1e-6)
    assert np.ptp(total) > 0
