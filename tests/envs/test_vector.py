"""Gymnasium's VectorEnv: row i equals a single env with its seed, in every autoreset mode."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import numpy as np
import pytest
from gymnasium.spaces import Box, Discrete, MultiDiscrete
from gymnasium.vector import AutoresetMode

import rsoccer
from rsoccer.arrays import Array, Mask
from rsoccer.envs.single import single_env
from rsoccer.envs.vector import SoccerVectorEnv, vector_env
from tests.helpers import comparable
from tests.parallel_matches import shot_at
from tests.single_learner import (
    DISCRETE,
    TASKS,
    learner_controllers,
    learner_options,
    one_by_one,
    short_env,
    without_times,
)

N = 3
MODES = list(AutoresetMode)


def many(name: str, mode: AutoresetMode | str = "next_step", **options: Any) -> SoccerVectorEnv:  # noqa: ANN401
    return vector_env(
        name, N, autoreset_mode=mode, **{"max_steps": 9, **learner_options(name), **options}
    )


def draw(envs: SoccerVectorEnv, rng: np.random.Generator) -> Array:
    if isinstance(envs.single_action_space, Discrete):
        return rng.integers(envs.single_action_space.n, size=N)
    return rng.uniform(-1.0, 1.0, (N, envs.task.action_size)).astype(np.float32)


# -- The main property ------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
@pytest.mark.parametrize("name", TASKS)
def test_results_equal_those_of_single_envs(name: str, mode: AutoresetMode) -> None:
    ours, theirs = many(name, mode), one_by_one(name, N, mode, max_steps=9)
    rng = np.random.default_rng(0)
    # Episodes end at different times: world 1 is reset again three steps later.
    assert comparable(ours.reset(seed=5)) == comparable(theirs.reset(seed=5))
    ends, infos_with_metrics = 0, 0
    for step in range(32):
        if step == 3:
            mask = np.array([False, True, False])
            begun = [each.reset(options={"reset_mask": mask}) for each in (ours, theirs)]
            assert comparable(begun[0]) == comparable(begun[1])
        actions = draw(ours, rng)
        given = ours.step(actions)
        *arrays, theirs_infos = theirs.step(actions)
        assert comparable(given) == comparable([*arrays, without_times(theirs_infos)])
        observations, rewards, terminations, truncations, infos = given
        assert ours.observation_space.contains(observations)
        assert rewards.dtype == np.float64
        ended: Mask = terminations | truncations
        ends, infos_with_metrics = ends + int(ended.sum()), infos_with_metrics + bool(infos)
        if mode is AutoresetMode.DISABLED and ended.any():
            again = [each.reset(options={"reset_mask": ended.copy()}) for each in (ours, theirs)]
            assert comparable(again[0]) == comparable(again[1])
    assert ends >= 2 * N, "too few ends were compared"
    assert infos_with_metrics >= 2


@pytest.mark.parametrize("name", TASKS)
def test_results_equal_those_of_matches(name: str) -> None:
    envs = many(name, "same_step", threads=2)
    task = rsoccer.make_task(name, max_steps=9)
    matches = rsoccer.Matches(task, N, controllers=learner_controllers(name))
    observations, expected = envs.reset(seed=4)[0], matches.reset(seed=4)
    rng = np.random.default_rng(1)
    for _ in range(20):
        assert comparable(observations) == comparable(expected[:, 0])
        actions = draw(envs, rng)
        observations, rewards, _, truncations, infos = envs.step(actions)
        outcome = matches.step(actions[:, None])
        expected = outcome.observations
        assert np.array_equal(rewards, outcome.rewards[:, 0])
        assert np.array_equal(truncations, outcome.truncated)
        for world in np.flatnonzero(outcome.ended):
            assert comparable(infos["final_obs"][world]) == comparable(
                outcome.final_observations[world, 0]
            )


@pytest.mark.parametrize("name", DISCRETE)
def test_discrete_actions_equal_those_of_single_envs(name: str) -> None:
    ours = many(name, discrete=True)
    theirs = one_by_one(name, N, AutoresetMode.NEXT_STEP, max_steps=9, discrete=True)
    assert isinstance(ours.action_space, MultiDiscrete)
    rng = np.random.default_rng(0)
    assert comparable(ours.reset(seed=5)) == comparable(theirs.reset(seed=5))
    for _ in range(12):
        actions = draw(ours, rng)
        assert comparable(ours.step(actions)) == comparable(theirs.step(actions))


# -- Seeds ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_each_match_may_have_its_own_seed(name: str) -> None:
    """After any history; matches without a seed continue their streams."""
    seeds: list[int | None] = [9, 2**64 + 1, 0]
    ours, theirs = many(name), one_by_one(name, N, AutoresetMode.NEXT_STEP, max_steps=9)
    rng = np.random.default_rng(0)
    ours.reset(seed=77)
    ours.step(draw(ours, rng))
    assert comparable(ours.reset(seed=seeds)) == comparable(theirs.reset(seed=seeds))
    for _ in range(12):
        actions = draw(ours, rng)
        assert comparable(ours.step(actions)) == comparable(theirs.step(actions))
    mixed = [None, 4, None]
    assert comparable(ours.reset(seed=mixed)) == comparable(theirs.reset(seed=mixed))
    assert comparable(ours.reset()) == comparable(theirs.reset())


def test_a_seed_affects_only_the_matches_that_are_reset() -> None:
    ours = many("VSS-v0")
    theirs = one_by_one("VSS-v0", N, AutoresetMode.NEXT_STEP, max_steps=9)
    mask = np.array([True, False, True])
    for each in (ours, theirs):
        each.reset(seed=1)
    before = ours.reset(seed=1)[0]
    given = ours.reset(seed=50, options={"reset_mask": mask})
    assert comparable(given) == comparable(theirs.reset(seed=50, options={"reset_mask": mask}))
    assert comparable(given[0][1]) == comparable(before[1])
    assert comparable(given[0][2]) != comparable(before[2])


def test_unseeded_environments_differ_and_report_their_seed() -> None:
    first, second = many("VSS-v0"), many("VSS-v0")
    assert comparable(first.reset()) != comparable(second.reset())
    again = many("VSS-v0")
    seed = second.np_random_seed
    assert comparable(again.reset(seed=seed)) == comparable(second.reset(seed=seed))
    single = short_env("VSS-v0")
    assert seed is not None
    assert comparable(single.reset(seed=seed + 2)[0]) == comparable(again.reset(seed=seed)[0][2])
    again.reset(seed=[1, 2, 3])
    assert again.np_random_seed == -1


# -- Copies and metadata ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "copied"),
    [(name, lambda envs: pickle.loads(pickle.dumps(envs))) for name in TASKS]
    + [
        ("SSLDribbling-v0", lambda envs: cloudpickle.loads(cloudpickle.dumps(envs))),
        ("SSLDribbling-v0", copy.deepcopy),
    ],
    ids=[*TASKS, "cloudpickle", "deepcopy"],
)
def test_a_copy_continues_with_the_same_matches(
    name: str, copied: Callable[[SoccerVectorEnv], SoccerVectorEnv]
) -> None:
    envs, rng = many(name), np.random.default_rng(0)
    envs.reset(seed=5)
    for _ in range(4):
        envs.step(draw(envs, rng))
    twin = copied(envs)
    for _ in range(15):
        actions = draw(envs, rng)
        assert comparable(envs.step(actions)) == comparable(twin.step(actions))


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_metadata(mode: AutoresetMode) -> None:
    for given in (mode, mode.name.lower(), mode.value):
        envs = many("VSS-v0", given)
        assert envs.autoreset_mode is envs.metadata["autoreset_mode"] is mode
    assert envs.metadata["render_fps"] == 40
    assert (envs.num_envs, envs.render_mode, envs.closed) == (N, None, False)
    assert (envs.task.name, envs.learner) == ("VSS-v0", "blue_0")
    single = single_env("VSS-v0")
    assert envs.single_observation_space == single.observation_space
    assert envs.single_action_space == single.action_space
    assert isinstance(envs.observation_space, Box)
    assert envs.observation_space.shape == (N, envs.task.layout.size)
    assert envs.action_space.shape == (N, 2)
    envs.close()
    assert envs.closed


def test_results_belong_to_the_caller() -> None:
    envs, twin = many("VSS-v0", "same_step"), many("VSS-v0", "same_step")
    rng, ends = np.random.default_rng(0), 0
    for each in (envs, twin):
        each.reset(seed=0, options={"frame": shot_at(1)})
    for _ in range(20):
        actions = draw(envs, rng)
        given = envs.step(actions)
        assert comparable(given) == comparable(twin.step(actions))
        infos = given[4]
        for array in given[:4]:
            array[:] = 1
        if "final_obs" in infos:
            ends += 1
            for last in infos["final_obs"][infos["_final_obs"]]:
                last[:] = 7.0
    assert ends >= 2
