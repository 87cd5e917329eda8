"""Gymnasium's VectorEnv: row i is the single env with its seed, in every autoreset mode."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import numpy as np
import pytest
from gymnasium.spaces import Box, Discrete, MultiDiscrete
from gymnasium.vector import AutoresetMode, SyncVectorEnv

import rsoccer
from rsoccer.envs.single import single_env
from rsoccer.envs.vector import SoccerVectorEnv, vector_env
from rsoccer.frame import Array, Mask
from tests.one_match import shot_at
from tests.solo_learner import DISCRETE, TASKS, hurried, lone, lone_controllers, plain

N = 3
MODES = list(AutoresetMode)


def many(name: str, mode: AutoresetMode | str = "next_step", **options: Any) -> SoccerVectorEnv:  # noqa: ANN401
    return vector_env(name, N, autoreset_mode=mode, **{"max_steps": 9, **lone(name), **options})


def one_by_one(name: str, mode: AutoresetMode, **options: Any) -> SyncVectorEnv:  # noqa: ANN401
    """Gymnasium's own loop over single envs: the reference."""
    settings = {"max_steps": 9, **lone(name), **options}
    return SyncVectorEnv([lambda: single_env(name, **settings)] * N, autoreset_mode=mode)


def draw(envs: SoccerVectorEnv, rng: np.random.Generator) -> Array:
    if isinstance(envs.single_action_space, Discrete):
        return rng.integers(envs.single_action_space.n, size=N)
    return rng.uniform(-1.0, 1.0, (N, envs.task.action_size)).astype(np.float32)


# -- The main property ------------------------------------------------------------------------


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
@pytest.mark.parametrize("name", TASKS)
def test_it_plays_and_tells_what_single_envs_do(name: str, mode: AutoresetMode) -> None:
    ours, theirs = many(name, mode), one_by_one(name, mode)
    rng = np.random.default_rng(0)
    # Ends at different times: world 1 begins a second time, three steps later.
    assert plain(ours.reset(seed=5)) == plain(theirs.reset(seed=5))
    ends, infos_told = 0, 0
    for step in range(32):
        if step == 3:
            late = np.array([False, True, False])
            begun = [each.reset(options={"reset_mask": late}) for each in (ours, theirs)]
            assert plain(begun[0]) == plain(begun[1])
        actions = draw(ours, rng)
        given = ours.step(actions)
        assert plain(given) == plain(theirs.step(actions))
        observations, rewards, terminations, truncations, infos = given
        assert ours.observation_space.contains(observations)
        assert rewards.dtype == np.float64
        ended: Mask = terminations | truncations
        ends, infos_told = ends + int(ended.sum()), infos_told + bool(infos)
        if mode is AutoresetMode.DISABLED and ended.any():
            again = [each.reset(options={"reset_mask": ended.copy()}) for each in (ours, theirs)]
            assert plain(again[0]) == plain(again[1])
    assert ends >= 2 * N, "too few ends were compared"
    assert infos_told >= 2


@pytest.mark.parametrize("name", TASKS)
def test_a_step_is_that_of_matches(name: str) -> None:
    envs = many(name, "same_step", threads=2)
    task = rsoccer.make_task(name, max_steps=9)
    matches = rsoccer.Matches(task, N, controllers=lone_controllers(name))
    observations, expected = envs.reset(seed=4)[0], matches.reset(seed=4)
    rng = np.random.default_rng(1)
    for _ in range(20):
        assert plain(observations) == plain(expected[:, 0])
        actions = draw(envs, rng)
        observations, rewards, _, truncations, infos = envs.step(actions)
        outcome = matches.step(actions[:, None])
        expected = outcome.observations
        assert np.array_equal(rewards, outcome.rewards[:, 0])
        assert np.array_equal(truncations, outcome.truncated)
        for world in np.flatnonzero(outcome.ended):
            assert plain(infos["final_obs"][world]) == plain(outcome.final_observations[world, 0])


@pytest.mark.parametrize("name", DISCRETE)
def test_choices_do_what_single_envs_do(name: str) -> None:
    ours = many(name, discrete=True)
    theirs = one_by_one(name, AutoresetMode.NEXT_STEP, discrete=True)
    assert isinstance(ours.action_space, MultiDiscrete)
    rng = np.random.default_rng(0)
    assert plain(ours.reset(seed=5)) == plain(theirs.reset(seed=5))
    for _ in range(12):
        actions = draw(ours, rng)
        assert plain(ours.step(actions)) == plain(theirs.step(actions))


# -- Seeds ------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_each_match_may_have_a_seed_of_its_own(name: str) -> None:
    """Whatever was played before; where there is none, its streams go on."""
    seeds: list[int | None] = [9, 2**64 + 1, 0]
    ours, theirs = many(name), one_by_one(name, AutoresetMode.NEXT_STEP)
    rng = np.random.default_rng(0)
    ours.reset(seed=77)
    ours.step(draw(ours, rng))
    assert plain(ours.reset(seed=seeds)) == plain(theirs.reset(seed=seeds))
    for _ in range(12):
        actions = draw(ours, rng)
        assert plain(ours.step(actions)) == plain(theirs.step(actions))
    mixed = [None, 4, None]
    assert plain(ours.reset(seed=mixed)) == plain(theirs.reset(seed=mixed))
    assert plain(ours.reset()) == plain(theirs.reset())


def test_a_seed_reaches_only_the_matches_that_begin() -> None:
    ours = many("VSS-v0")
    theirs = one_by_one("VSS-v0", AutoresetMode.NEXT_STEP)
    mask = np.array([True, False, True])
    for each in (ours, theirs):
        each.reset(seed=1)
    before = ours.reset(seed=1)[0]
    given = ours.reset(seed=50, options={"reset_mask": mask})
    assert plain(given) == plain(theirs.reset(seed=50, options={"reset_mask": mask}))
    assert plain(given[0][1]) == plain(before[1])
    assert plain(given[0][2]) != plain(before[2])


def test_unseeded_environments_differ_and_tell_their_seed() -> None:
    first, second = many("VSS-v0"), many("VSS-v0")
    assert plain(first.reset()) != plain(second.reset())
    again = many("VSS-v0")
    seed = second.np_random_seed
    assert plain(again.reset(seed=seed)) == plain(second.reset(seed=seed))
    single = hurried("VSS-v0")
    assert seed is not None
    assert plain(single.reset(seed=seed + 2)[0]) == plain(again.reset(seed=seed)[0][2])
    again.reset(seed=[1, 2, 3])
    assert again.np_random_seed == -1


# -- Copies, and what is told about itself ----------------------------------------------------


@pytest.mark.parametrize(
    ("name", "copied"),
    [(name, lambda envs: pickle.loads(pickle.dumps(envs))) for name in TASKS]
    + [
        ("SSLDribbling-v0", lambda envs: cloudpickle.loads(cloudpickle.dumps(envs))),
        ("SSLDribbling-v0", copy.deepcopy),
    ],
    ids=[*TASKS, "cloudpickle", "deepcopy"],
)
def test_a_copy_goes_on_with_the_same_matches(
    name: str, copied: Callable[[SoccerVectorEnv], SoccerVectorEnv]
) -> None:
    envs, rng = many(name), np.random.default_rng(0)
    envs.reset(seed=5)
    for _ in range(4):
        envs.step(draw(envs, rng))
    twin = copied(envs)
    for _ in range(15):
        actions = draw(envs, rng)
        assert plain(envs.step(actions)) == plain(twin.step(actions))


@pytest.mark.parametrize("mode", MODES, ids=lambda mode: mode.name)
def test_facts_about_itself(mode: AutoresetMode) -> None:
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
    assert envs.observation_space.shape == (N, envs.task.observation_size)
    assert envs.action_space.shape == (N, 2)
    envs.close()
    assert envs.closed


def test_what_is_returned_belongs_to_the_caller() -> None:
    envs, twin = many("VSS-v0", "same_step"), many("VSS-v0", "same_step")
    rng, ends = np.random.default_rng(0), 0
    for each in (envs, twin):
        each.reset(seed=0, options={"frame": shot_at(1)})
    for _ in range(20):
        actions = draw(envs, rng)
        given = envs.step(actions)
        assert plain(given) == plain(twin.step(actions))
        infos = given[4]
        for array in given[:4]:
            array[:] = 1
        if "final_obs" in infos:
            ends += 1
            for last in infos["final_obs"][infos["_final_obs"]]:
                last[:] = 7.0
    assert ends >= 2
