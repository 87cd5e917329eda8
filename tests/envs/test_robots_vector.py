"""Rows of robots for Gymnasium: each match equals a PettingZoo environment, bit for bit."""

import copy
import pickle
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.vector import AutoresetMode
from gymnasium.wrappers import vector as wrappers

import rsoccer
from rsoccer.envs.parallel import parallel_env
from rsoccer.envs.robots_vector import RobotsVectorEnv, robots_vector_env
from rsoccer.envs.vector import vector_env
from tests.helpers import comparable

NAME = "VSSSelfPlay-v0"
ROBOTS = 6
N = 3
LIMIT = 7
MODES = list(AutoresetMode)


def rows(mode: AutoresetMode = AutoresetMode.NEXT_STEP, **options: Any) -> RobotsVectorEnv:  # noqa: ANN401
    """Short matches."""
    return robots_vector_env(NAME, N * ROBOTS, autoreset_mode=mode, max_steps=LIMIT, **options)


def drawn(rng: np.random.Generator) -> np.ndarray[Any, Any]:
    return rng.uniform(-1.0, 1.0, (N * ROBOTS, 2)).astype(np.float32)


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_rows_are_the_robots_of_single_matches(mode: AutoresetMode) -> None:
    envs = rows(mode)
    singles = [parallel_env(NAME, max_steps=LIMIT) for _ in range(N)]
    expected = [match.reset(seed=4 + i)[0] for i, match in enumerate(singles)]
    first, infos = envs.reset(seed=4)
    assert infos == {}
    assert envs.robots == tuple(singles[0].possible_agents)
    np.testing.assert_array_equal(first, np.concatenate([[*each.values()] for each in expected]))
    rng = np.random.default_rng(0)
    for step in range(1, LIMIT + 1):
        actions = drawn(rng)
        by_match = actions.reshape(N, ROBOTS, 2)
        results = [
            match.step(dict(zip(envs.robots, each, strict=True)))
            for match, each in zip(singles, by_match, strict=True)
        ]
        final, rewards, terminated, truncated, _ = (
            np.concatenate([[*result[part].values()] for result in results]) for part in range(5)
        )
        given = envs.step(actions)
        np.testing.assert_array_equal(given[1], rewards)
        np.testing.assert_array_equal(given[2], terminated)
        np.testing.assert_array_equal(given[3], truncated)
        states = np.concatenate([[match.state()] * ROBOTS for match in singles])
        np.testing.assert_array_equal(envs.final_states(), states)
        if step < LIMIT or mode is not AutoresetMode.SAME_STEP:
            np.testing.assert_array_equal(given[0], final)
            np.testing.assert_array_equal(envs.states(), states)
    assert given[3].all()
    infos = given[4]
    if mode is AutoresetMode.SAME_STEP:
        np.testing.assert_array_equal(np.stack(infos["final_obs"]), final)
        assert infos["_final_obs"].all()
        infos = infos["final_info"]
        starts = np.concatenate([[*match.reset()[0].values()] for match in singles])
        np.testing.assert_array_equal(given[0], starts)
    elif mode is AutoresetMode.NEXT_STEP:
        given = envs.step(actions)
        starts = np.concatenate([[*match.reset()[0].values()] for match in singles])
        np.testing.assert_array_equal(given[0], starts)
        assert not given[1].any()
    scores = np.repeat([match.last_metrics["goal_score"] for match in singles], ROBOTS)
    np.testing.assert_array_equal(infos["goal_score"], scores)
    assert infos["steps"].tolist() == [LIMIT] * N * ROBOTS


def test_a_single_learner_is_the_special_case() -> None:
    ours = robots_vector_env("VSS-v0", 3, max_steps=LIMIT)
    theirs = vector_env("VSS-v0", 3, max_steps=LIMIT)
    rng = np.random.default_rng(0)
    assert comparable(ours.reset(seed=1)) == comparable(theirs.reset(seed=1))
    for _ in range(2 * LIMIT):
        actions = rng.uniform(-1.0, 1.0, (3, 2)).astype(np.float32)
        assert comparable(ours.step(actions)) == comparable(theirs.step(actions))


def test_the_number_of_rows_or_of_matches_is_given() -> None:
    assert robots_vector_env(NAME).num_envs == ROBOTS
    assert robots_vector_env(NAME, worlds=4).num_envs == 4 * ROBOTS
    assert robots_vector_env(NAME, 4, learner="yellow_2").robots == ("yellow_2",)
    own = robots_vector_env(NAME, controllers={"yellow": "ou"}, worlds=2)
    assert (own.robots, own.num_envs) == (("blue_0", "blue_1", "blue_2"), 6)
    with pytest.raises(ValueError, match=r"expected a multiple of the 6 robots .* got 64"):
        robots_vector_env(NAME, 64)
    with pytest.raises(ValueError, match="num_envs and worlds: expected one of them, got 6 and 1"):
        robots_vector_env(NAME, 6, worlds=1)
    with pytest.raises(ValueError, match=r"^worlds: expected at least 1, got 0"):
        robots_vector_env(NAME, worlds=0)
    with pytest.raises(ValueError, match=r"^num_envs: expected at least 1, got 0"):
        gymnasium.make_vec("rsoccer/VSS-v0", num_envs=0)
    with pytest.raises(ValueError, match="at least one learner, got none"):
        robots_vector_env(NAME, 6, controllers={"all": "ou"})


def test_discrete_rows_take_integers() -> None:
    envs = robots_vector_env("VSSMulti-v0", 6, discrete=True)
    envs.reset(seed=0)
    assert envs.action_space.shape == (6,)
    observations = envs.step(envs.action_space.sample())[0]
    assert envs.observation_space.contains(observations)


def test_a_mask_selects_whole_matches() -> None:
    envs = rows(AutoresetMode.DISABLED)
    before, _ = envs.reset(seed=0)
    mask = np.repeat([False, True, False], ROBOTS)
    after, _ = envs.reset(options={"reset_mask": mask})
    assert (before != after).any(axis=1).tolist() == mask.tolist()
    mask[0] = True
    with pytest.raises(ValueError, match=r"equal values for the 6 robots .* matches \[0\]"):
        envs.reset(options={"reset_mask": mask})
    for _ in range(LIMIT):
        envs.step(drawn(np.random.default_rng(0)))
    with pytest.raises(RuntimeError, match=r"end of the episode in worlds \[0, 1, 2\]"):
        envs.step(drawn(np.random.default_rng(0)))


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_gymnasiums_statistics_are_by_row(mode: AutoresetMode) -> None:
    envs = wrappers.RecordEpisodeStatistics(rows(mode))
    envs.reset(seed=0)
    rewards = np.zeros(N * ROBOTS)
    rng = np.random.default_rng(0)
    for _ in range(LIMIT):
        given = envs.step(drawn(rng))
        rewards += given[1]
    episode = given[4]["episode"]
    np.testing.assert_allclose(episode["r"], rewards, rtol=1e-5)
    assert episode["l"].tolist() == [LIMIT] * N * ROBOTS
    assert len(np.unique(episode["r"])) > N


def test_images_are_shared_by_the_robots_of_a_match() -> None:
    pytest.importorskip("pygame")
    envs = robots_vector_env(NAME, worlds=2, render_mode="rgb_array")
    envs.reset(seed=0)
    images = envs.render()
    assert images is not None
    assert len(images) == envs.num_envs
    assert images[0] is images[ROBOTS - 1]
    assert (images[0] != images[ROBOTS]).any()


def test_a_copy_continues_with_the_same_future() -> None:
    envs = rows(AutoresetMode.SAME_STEP)
    envs.reset(seed=0)
    twins = [copy.deepcopy(envs), pickle.loads(pickle.dumps(envs))]
    for _ in range(2 * LIMIT):
        actions = drawn(np.random.default_rng(0))
        given = comparable(envs.step(actions))
        assert all(comparable(twin.step(actions)) == given for twin in twins)


def test_the_package_has_it() -> None:
    assert rsoccer.robots_vector_env is robots_vector_env
