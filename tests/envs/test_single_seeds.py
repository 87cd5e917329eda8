"""The same match from every interface, after any history, and in every copy."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import numpy as np
import pytest

import rsoccer
from rsoccer.envs.parallel import parallel_env
from rsoccer.envs.single import SoccerEnv, single_env
from tests.helpers import comparable
from tests.single_learner import (
    TASKS,
    draw,
    learner_controllers,
    learner_options,
    play_episode,
    short_env,
)


@pytest.mark.parametrize("name", TASKS)
def test_every_interface_plays_the_same_match(name: str) -> None:
    """Over several episodes, the later ones without a seed."""
    controllers = learner_controllers(name)
    env = short_env(name)
    zoo = parallel_env(name, max_cycles=40, controllers=controllers)
    task = rsoccer.make_task(name, max_steps=40)
    matches = rsoccer.Matches(task, 1, 11, controllers=controllers)
    rng, agent = np.random.default_rng(0), env.learner
    assert zoo.possible_agents == list(matches.agents) == [agent]
    expected = matches.reset()
    observation, in_zoo = env.reset(seed=11)[0], zoo.reset(seed=11)[0]
    ends = 0
    for _ in range(130):
        assert comparable(observation) == comparable(in_zoo[agent]) == comparable(expected[0, 0])
        action = draw(env, rng)
        observation, reward, terminated, truncated, info = env.step(action)
        in_zoo, rewards, terminations, truncations, _ = zoo.step({agent: action})
        outcome = matches.step(action[None, None])
        assert reward == rewards[agent] == outcome.rewards[0, 0]
        assert terminated is terminations[agent]
        assert terminated == outcome.terminated[0]
        assert truncated is truncations[agent]
        assert truncated == outcome.truncated[0]
        assert comparable(observation) == comparable(outcome.final_observations[0, 0])
        expected = outcome.observations
        if terminated or truncated:
            ends += 1
            assert info == zoo.last_metrics
            observation, in_zoo = env.reset()[0], zoo.reset()[0]
    assert ends >= 3, "too few ends were compared"


@pytest.mark.parametrize("name", TASKS)
def test_a_seed_determines_episodes_after_any_history(name: str) -> None:
    fresh, used = short_env(name), short_env(name)
    play_episode(used, 77)
    used.reset(seed=78)
    used.step(draw(used, np.random.default_rng(5)))
    ours, theirs = ([play_episode(env, 3), play_episode(env, None)] for env in (fresh, used))
    assert ours == theirs
    starts = rsoccer.Matches(name, 2)
    starts.reset()
    if comparable(starts.frame.rows[0]) == comparable(starts.frame.rows[1]):
        return  # a course with one initial state
    assert ours[0][0] != ours[1][0], "the streams did not continue: both episodes start equally"
    assert play_episode(fresh, 5)[0] != ours[0][0], "another seed starts equally"


def test_gymnasiums_attributes_hold_the_seed() -> None:
    env = single_env("VSS-v0")
    env.reset(seed=np.int64(5))  # type: ignore[arg-type]
    assert env.np_random_seed == 5
    first = env.np_random.random()
    env.reset()
    assert env.np_random_seed == 5
    env.reset(seed=5)
    assert env.np_random.random() == first


def test_unseeded_environments_differ_and_report_their_seed() -> None:
    first, second = single_env("VSS-v0", max_steps=5), single_env("VSS-v0", max_steps=5)
    played = play_episode(first, None)
    assert played[0] != play_episode(second, None)[0]
    second.reset(seed=first.np_random_seed)
    assert second.np_random_seed == first.np_random_seed
    again, rng = single_env("VSS-v0", max_steps=5), np.random.default_rng(0)
    transcript = [comparable(again.reset(seed=first.np_random_seed))]
    transcript += [comparable(again.step(draw(again, rng))) for _ in range(5)]
    assert transcript == played


@pytest.mark.parametrize(
    ("name", "copied"),
    [(name, lambda env: pickle.loads(pickle.dumps(env))) for name in TASKS]
    + [
        ("SSLDribbling-v0", lambda env: cloudpickle.loads(cloudpickle.dumps(env))),
        ("SSLDribbling-v0", copy.deepcopy),
    ],
    ids=[*TASKS, "cloudpickle", "deepcopy"],
)
def test_a_copy_continues_with_the_same_match(
    name: str, copied: Callable[[SoccerEnv], SoccerEnv]
) -> None:
    env, rng = short_env(name), np.random.default_rng(0)
    env.reset(seed=5)
    env.action_space.seed(5)
    for _ in range(4):
        env.step(draw(env, rng))
    twin = copied(env)
    assert twin is not env
    twin.np_random.random()
    assert comparable(twin.action_space.sample()) == comparable(env.action_space.sample())
    both: list[list[Any]] = []
    for each in (env, twin):
        rng = np.random.default_rng(1)
        given = [each.step(draw(each, rng))]
        while not (given[-1][2] or given[-1][3]):
            given.append(each.step(draw(each, rng)))
        both.append([comparable(given), play_episode(each, None)])
    assert both[0] == both[1]
    assert env.np_random_seed == twin.np_random_seed == 5


def test_a_copy_opens_its_own_window(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygame")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    env = single_env("VSS-v0", "human")
    env.reset(seed=0)
    twin = copy.deepcopy(env)
    for each in (env, twin):
        assert each.render() is None
        each.step(each.action_space.sample())
        each.close()


def test_learner_options_leave_one_learner() -> None:
    for name in TASKS:
        assert len(rsoccer.Matches(name, controllers=learner_controllers(name)).agents) == 1
        assert short_env(name).learner == learner_options(name).get("learner", "blue_0")
