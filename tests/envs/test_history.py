"""Every environment has stacked observations, and spaces that they are in."""

import copy
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import rsoccer
from rsoccer.arrays import Floats
from tests.environments import MAKERS
from tests.helpers import same
from tests.stacks import HandStack

HISTORY, STEPS = 3, 6


class Rows:
    """An environment of any kind by rows, one for each robot that learns."""

    def __init__(self, env: Any) -> None:  # noqa: ANN401
        self.env = env
        self.agents = list(getattr(env, "possible_agents", ()))
        self.in_turn = hasattr(env, "agent_iter")
        self.is_single = not self.agents and not hasattr(env, "num_envs")

    def spaces(self) -> list[Any]:
        """Observation space of each row, or of all rows."""
        if self.agents:
            return [self.env.observation_space(agent) for agent in self.agents]
        return [getattr(self.env, "single_observation_space", self.env.observation_space)]

    def reset(self, seed: int | None) -> Floats:
        """First observations (rows, o)."""
        return self._rows(self.env.reset(seed=seed))

    def step(self, actions: Floats) -> Floats:
        """Next observations (rows, o)."""
        if self.in_turn:
            for action in actions:
                self.env.step(action)
            return self._rows(None)
        if self.agents:
            return self._rows(self.env.step(dict(zip(self.agents, actions, strict=True))))
        return self._rows(self.env.step(actions[0] if self.is_single else actions))

    def _rows(self, results: Any) -> Floats:  # noqa: ANN401
        if self.in_turn:
            return np.stack([self.env.observe(agent) for agent in self.agents])
        observations = results[0]
        if self.agents:
            return np.stack([observations[agent] for agent in self.agents])
        return np.array(observations[None] if self.is_single else observations)


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_observations_are_the_stacks_of_plain_ones(make: Callable[..., Any]) -> None:
    ours, plain = Rows(make(history=HISTORY)), Rows(make())
    rng, hand = np.random.default_rng(0), HandStack(HISTORY, 2)
    for seed in (3, None):
        hand.begin(plain.reset(seed))
        observations = ours.reset(seed)
        for _ in range(STEPS):
            assert same(observations, hand.value)
            for space, row in zip(ours.spaces(), observations, strict=False):
                assert space.contains(row)
            actions = rng.uniform(-1, 1, (len(observations), 2)).astype(np.float32)
            observations = ours.step(actions)
            hand.step(actions, plain.step(actions))
    assert same(observations, hand.value)


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda env: pickle.loads(pickle.dumps(env))])
@pytest.mark.parametrize("name", ["parallel", "single", "robots"])
def test_a_copy_continues_with_the_past(name: str, copied: Callable[[Any], Any]) -> None:
    ours = Rows(MAKERS[name](history=HISTORY))
    rng, shape = np.random.default_rng(0), (len(ours.reset(1)), 2)
    for _ in range(3):
        ours.step(rng.uniform(-1, 1, shape).astype(np.float32))
    twin = Rows(copied(ours.env))
    for _ in range(3):
        actions = rng.uniform(-1, 1, shape).astype(np.float32)
        assert same(ours.step(actions), twin.step(actions))


@pytest.mark.parametrize("mode", ["next_step", "same_step"])
def test_a_new_episode_of_a_vector_environment_has_no_past(mode: str) -> None:
    envs = rsoccer.vector_env("VSS-v0", 2, history=2, max_steps=3, autoreset_mode=mode)
    o = envs.task.layout.size
    _, infos = envs.reset(seed=0)
    for step in range(3 if mode == "same_step" else 4):
        observations, *_, infos = envs.step(np.ones((2, 2), np.float32))
        first = step == 3 or (mode == "same_step" and step == 2)
        assert same(observations[:, o : 2 * o], observations[:, :o]) == first
        assert same(observations[:, 2 * o :], np.full((2, 2), float(not first), np.float32))
    if mode == "same_step":
        last = np.stack(infos["final_obs"])
        assert same(last[:, 2 * o :], np.ones((2, 2), np.float32))
        assert not same(last[:, o : 2 * o], last[:, :o])


@pytest.mark.parametrize("make", MAKERS.values(), ids=MAKERS)
def test_bad_histories_are_refused(make: Callable[..., Any]) -> None:
    with pytest.raises(ValueError, match="history: expected at least 1, got 0"):
        make(history=0)
    with pytest.raises(TypeError, match=r"history: expected a whole number, got 1\.5"):
        make(history=1.5)
