"""PettingZoo's environments: results, spaces, metadata and images."""

import importlib
import warnings
from typing import Any

import numpy as np
import pytest

from rsoccer.envs.aec import env
from rsoccer.envs.parallel import parallel_env
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, TASKS, random_actions, shot_at

with warnings.catch_warnings():
    # PettingZoo's tests import a path that PettingZoo itself has deprecated.
    warnings.simplefilter("ignore", DeprecationWarning)
    official: Any = importlib.import_module("pettingzoo.test")


# -- PettingZoo's own tests -------------------------------------------------------------------


@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_accepts_the_parallel_env(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    match = parallel_env(name)
    official.parallel_api_test(match, num_cycles=60)
    assert match.max_cycles == 60, "the test's time limit was ignored"
    official.parallel_seed_test(lambda: parallel_env(name), num_cycles=50)
    assert "Passed" in capsys.readouterr().out


def test_pettingzoo_accepts_long_matches() -> None:
    official.parallel_api_test(parallel_env(SELF_PLAY), num_cycles=1200)


@pytest.mark.parametrize("name", TASKS)
def test_pettingzoo_accepts_the_aec_env(name: str) -> None:
    official.api_test(env(name, max_cycles=30), num_cycles=100)
    official.seed_test(lambda: env(name), num_cycles=100)
    official.state_test(env(name), parallel_env(name))


# -- Results ----------------------------------------------------------------------------------


def test_a_goal_terminates_for_all_agents() -> None:
    match = parallel_env(SELF_PLAY)
    match.reset(seed=0, options={"frame": shot_at(1)})
    assert match.score == (0, 0)
    assert match.last_metrics == {}
    still = {agent: np.zeros(2, np.float32) for agent in match.agents}
    while match.agents:
        observations, rewards, terminations, truncations, infos = match.step(still)
    assert set(terminations.values()) == {True}
    assert set(truncations.values()) == {False}
    assert list(observations) == list(rewards) == list(infos) == match.possible_agents
    assert rewards["blue_0"] > 5.0
    assert rewards["yellow_0"] < -5.0
    assert match.score == (1, 0)
    assert match.last_metrics == {
        "goal_score": 1.0,
        "free_balls": 0.0,
        "steps": round(match.clock / 0.025),
    }
    assert 0.0 < match.clock < 1.0


def test_the_time_limit_truncates_for_all_agents() -> None:
    match = parallel_env(SELF_PLAY, max_cycles=3)
    match.reset(seed=0)
    for _ in range(3):
        assert match.agents == match.possible_agents
        *_, terminations, truncations, _ = match.step(
            random_actions(match, np.random.default_rng(0))
        )
    assert match.agents == []
    assert set(terminations.values()) == {False}
    assert set(truncations.values()) == {True}
    assert match.last_metrics == {"goal_score": 0.0, "free_balls": 0.0, "steps": 3.0}
    assert match.clock == pytest.approx(0.075)


def test_results_belong_to_the_caller() -> None:
    match, twin = parallel_env(SELF_PLAY), parallel_env(SELF_PLAY)
    rng, twin_rng = np.random.default_rng(0), np.random.default_rng(0)
    before, infos = match.reset(seed=0)
    twin.reset(seed=0)
    assert infos == {agent: {} for agent in match.agents}
    for _ in range(5):
        kept = {agent: observation.copy() for agent, observation in before.items()}
        observations, rewards, terminations, truncations, infos = match.step(
            random_actions(match, rng)
        )
        expected = twin.step(random_actions(twin, twin_rng))
        assert comparable(observations) == comparable(expected[0])
        assert comparable(before) == comparable(kept), "an earlier observation has changed"
        for agent in match.agents:
            assert not np.shares_memory(before[agent], observations[agent])
        before = observations
        for flags in (terminations, truncations):  # RLlib adds such a key
            assert not flags.get("__all__")
            flags["__all__"] = True
        for info in infos.values():
            assert info == {}
            info["added"] = 1
        rewards.clear()
    for observation in before.values():
        observation[:] = 7.0
    match.agents.remove("blue_0")
    assert match.possible_agents[0] == "blue_0"


def test_observations_and_states_stay_in_their_spaces() -> None:
    match = parallel_env(SELF_PLAY)
    observations, _ = match.reset(seed=1)
    rng = np.random.default_rng(1)
    for _ in range(200):
        for agent, observation in observations.items():
            assert match.observation_space(agent).contains(observation)
        state = match.state()
        assert match.state_space.contains(state)
        observations = match.step(random_actions(match, rng))[0]
    for space in (match.observation_space("blue_0"), match.state_space):
        assert np.isfinite(space.low).all()
        assert np.isfinite(space.high).all()
        assert space.dtype == np.float32


def test_each_agent_has_its_own_space_objects() -> None:
    match = parallel_env(SELF_PLAY)
    spaces = [match.action_space(agent) for agent in match.possible_agents]
    assert spaces == [match.action_space(agent) for agent in match.possible_agents]
    assert len({id(space) for space in spaces}) == 6
    assert all(
        match.action_space(agent) is spaces[i] for i, agent in enumerate(match.possible_agents)
    )


def test_metadata() -> None:
    match = parallel_env(SELF_PLAY)
    assert match.metadata == {
        "name": SELF_PLAY,
        "render_modes": ["human", "rgb_array"],
        "render_fps": 40,
        "is_parallelizable": True,
    }
    assert match.unwrapped is match
    assert match.num_agents == 0
    assert match.max_num_agents == 6


# -- Images -----------------------------------------------------------------------------------


def test_images_show_the_match() -> None:
    pytest.importorskip("pygame")
    match = parallel_env(SELF_PLAY, "rgb_array")
    with pytest.raises(RuntimeError, match="render before reset"):
        match.render()
    match.reset(seed=0, options={"frame": shot_at(1)})
    first, again = match.render(), match.render()
    assert first is not None
    assert again is not None
    assert first.dtype == np.uint8
    assert first.ndim == 3
    assert first.shape[2] == 3
    assert np.array_equal(first, again)
    while match.agents:
        match.step({agent: np.zeros(2, np.float32) for agent in match.agents})
    last = match.render()
    assert last is not None
    assert not np.array_equal(first, last)
    match.close()
    match.close()


def test_render_without_a_mode_warns() -> None:
    match = parallel_env(SELF_PLAY)
    assert match.render_mode is None
    match.reset()
    with pytest.warns(UserWarning, match="rgb_array"):
        assert match.render() is None


def test_the_last_infos_hold_the_metrics() -> None:
    """They were once in `last_metrics` only, which trainers do not read."""
    match = parallel_env(SELF_PLAY, max_cycles=3)
    match.reset(seed=0)
    still = {agent: np.zeros(2, np.float32) for agent in match.agents}
    every = [match.step(still)[4] for _ in range(3)]
    assert every[:2] == [{agent: {} for agent in match.possible_agents}] * 2
    expected = {"goal_score": 0.0, "free_balls": 0.0, "steps": 3.0, "TimeLimit.truncated": True}
    assert every[2] == dict.fromkeys(match.possible_agents, expected)
    assert match.last_metrics == {"goal_score": 0.0, "free_balls": 0.0, "steps": 3.0}
    first, *others = every[2].values()
    assert all(info is not first for info in others)
