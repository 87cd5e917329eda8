"""Seeds and copies of PettingZoo environments: they alone determine episodes, bit for bit."""

import copy
import pickle
import random
from collections.abc import Callable
from typing import Any

import cloudpickle  # type: ignore[import-untyped]
import numpy as np
import pytest

import rsoccer
from rsoccer.envs.parallel import SoccerParallelEnv, parallel_env
from tests.helpers import comparable
from tests.parallel_matches import SELF_PLAY, TASKS, play_episode, random_actions, shot_at

FIXED_STARTS = {"SSLDribbling-v0", "SSLMatch-v0"}
"""Tasks that begin alike for some seeds: matches do for those with the same first kick-off."""


class Unseeded(SoccerParallelEnv):
    """A faulty environment: an observation depends on a generator without a seed."""

    def step(self, actions: Any) -> Any:  # noqa: ANN401
        observations, *rest = super().step(actions)
        if self._matches.play.steps[0] == 200:
            observations["blue_0"][0] += np.random.default_rng().normal() * 1e-6
        return (observations, *rest)


def seeded_transcripts(make: Callable[[], SoccerParallelEnv]) -> tuple[list[Any], list[Any]]:
    """The same episodes twice: in a fresh environment, and in one that has played others."""
    used = make()
    play_episode(used, 77, options={"frame": shot_at(1)})
    used.reset(seed=78)
    used.step(random_actions(used, np.random.default_rng(5)))
    both: list[list[Any]] = []
    for match in (make(), used):
        episodes = [play_episode(match, 3), play_episode(match, None)]
        episodes.append(play_episode(match, 4, options={"frame": shot_at(1)}))
        both.append(episodes)
    return both[0], both[1]


@pytest.mark.parametrize("name", TASKS)
def test_a_seed_determines_the_episodes_of_every_task(name: str) -> None:
    fresh, used = (parallel_env(name, max_cycles=150) for _ in range(2))
    play_episode(used, 77)
    used.reset(seed=78)
    used.step(random_actions(used, np.random.default_rng(5)))
    episodes = [[play_episode(match, seed) for seed in (3, None)] for match in (fresh, used)]
    assert episodes[0] == episodes[1]
    assert episodes[0][0] != episodes[0][1], "the streams did not continue: both episodes are equal"
    other = play_episode(parallel_env(name, max_cycles=1), 5)[0]
    assert (other == episodes[0][0][0]) == (name in FIXED_STARTS)


def test_a_seed_determines_whole_episodes() -> None:
    fresh, used = seeded_transcripts(lambda: parallel_env(SELF_PLAY))
    assert fresh == used
    assert fresh[0] != fresh[1], "the streams did not continue: both episodes are equal"
    steps = [episode[-1]["steps"] for episode in fresh]
    scores = [episode[-1]["goal_score"] for episode in fresh]
    assert max(steps) > 200, "no long episode was compared"
    assert scores[2] == 1.0, "no episode with a goal was compared"


def test_the_comparison_finds_a_faulty_environment() -> None:
    fresh, used = seeded_transcripts(lambda: Unseeded(rsoccer.make_task(SELF_PLAY)))
    assert fresh != used


def test_unseeded_environments_differ() -> None:
    first, second = (parallel_env(SELF_PLAY).reset()[0]["blue_0"] for _ in range(2))
    assert not np.array_equal(first, second)


def test_global_generators_are_neither_used_nor_changed() -> None:
    def episode(global_seed: int) -> list[Any]:
        random.seed(global_seed)
        np.random.seed(global_seed)  # noqa: NPY002  (the generator that must not matter)
        before = random.getstate(), repr(np.random.get_state())  # noqa: NPY002
        transcript = play_episode(parallel_env("VSSMulti-v0", max_cycles=50), 1)
        assert (random.getstate(), repr(np.random.get_state())) == before  # noqa: NPY002
        return transcript

    assert episode(1) == episode(2)


@pytest.mark.parametrize("name", TASKS)
def test_it_plays_the_same_as_matches(name: str) -> None:
    match, matches = parallel_env(name), rsoccer.Matches(name, 1, seed=11)
    observations, _ = match.reset(seed=11)
    rng = np.random.default_rng(0)
    expected = matches.reset()
    for _ in range(100):
        if not match.agents:
            break  # random actions end some tasks early
        assert list(observations) == list(matches.agents)
        assert np.array_equal(np.stack(list(observations.values())), expected[0])
        actions = random_actions(match, rng)
        outcome = matches.step(np.stack(list(actions.values()))[None])
        observations, rewards, *_ = match.step(actions)
        expected = outcome.final_observations
        assert list(rewards.values()) == outcome.rewards[0].tolist()
    assert matches.play.steps[0] > 10 or outcome.ended[0]


# -- Copies -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "copied"),
    [(name, lambda match: pickle.loads(pickle.dumps(match))) for name in TASKS]
    + [
        (SELF_PLAY, lambda match: cloudpickle.loads(cloudpickle.dumps(match))),
        (SELF_PLAY, copy.deepcopy),
    ],
    ids=[*TASKS, "cloudpickle", "deepcopy"],
)
def test_a_copy_continues_with_the_same_match(
    name: str, copied: Callable[[SoccerParallelEnv], SoccerParallelEnv]
) -> None:
    match = parallel_env(name, max_cycles=60)
    match.reset(seed=5)
    match.action_space("blue_0").seed(5)
    rng = np.random.default_rng(0)
    for _ in range(8):
        actions = random_actions(match, rng)
        # Without kicks, because a random kick ends the passing tasks at once.
        match.step({agent: -np.abs(action) for agent, action in actions.items()})
    assert match.agents, "it ended too early to compare what follows"
    twin = copied(match)
    assert twin is not match
    rng, twin_rng = np.random.default_rng(1), np.random.default_rng(1)
    for _ in range(2):  # two ends, and a reset without a seed
        while match.agents:
            ours, theirs = (
                each.step(random_actions(each, generator))
                for each, generator in ((match, rng), (twin, twin_rng))
            )
            assert [comparable(part) for part in ours] == [comparable(part) for part in theirs]
        assert twin.agents == []
        assert twin.last_metrics == match.last_metrics != {}
        assert comparable(match.reset()[0]) == comparable(twin.reset()[0])
    assert np.array_equal(
        twin.action_space("blue_0").sample(), match.action_space("blue_0").sample()
    )


def test_a_copy_of_a_match_that_has_not_begun_raises() -> None:
    twin = pickle.loads(pickle.dumps(parallel_env(SELF_PLAY)))
    with pytest.raises(RuntimeError, match="before reset"):
        twin.step({})
