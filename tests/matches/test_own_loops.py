"""`Matches` for training loops of one's own: options, spaces, global states, episodes."""

import pickle
from typing import Any

import numpy as np
import pytest
from gymnasium.spaces import Discrete

import rsoccer
from rsoccer import Matches
from rsoccer.arrays import Floats
from rsoccer.envs.parallel import parallel_env
from rsoccer.envs.single import single_env
from rsoccer.matches import Episodes, Outcome
from tests.helpers import same, zeros

MODES = ("same_step", "next_step", "disabled")


def played(matches: Matches, steps: int) -> list[Outcome]:
    """Outcomes of steps with random actions."""
    rng = np.random.default_rng(0)
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return [matches.step(rng.uniform(-1, 1, shape).astype(np.float32)) for _ in range(steps)]


# -- Options and spaces -----------------------------------------------------------------------


def test_matches_take_options_like_the_environments() -> None:
    matches = Matches("VSS-v0", 2, max_steps=7, n_blue=1, controllers={"yellow": "zero"})
    assert (matches.task.max_steps, matches.task.n_blue) == (7, 1)
    task = rsoccer.make_task("VSS-v0")
    assert Matches(task, max_steps=7).task.max_steps == 7
    assert task.max_steps != 7, "the caller's task does not change"
    with pytest.raises(TypeError, match=r"VSS-v0: got an unexpected keyword argument 'frameskip'"):
        Matches("VSS-v0", frameskip=1)
    with pytest.raises(TypeError, match="a Task object has its own options"):
        Matches(task, n_blue=1)


@pytest.mark.parametrize("discrete", [False, True])
def test_spaces_are_those_of_the_environments(discrete: bool) -> None:
    matches, env = Matches("VSS-v0", discrete=discrete), single_env("VSS-v0", discrete=discrete)
    assert matches.observation_space == env.observation_space
    assert matches.action_space == env.action_space
    assert matches.action_space is matches.action_space
    match = parallel_env("VSS-v0", discrete=discrete)
    assert matches.state_space == match.state_space
    assert matches.state_space.shape == (matches.state_size,)


def test_discrete_tasks_take_integers() -> None:
    ours, theirs = (Matches("VSSMulti-v0", 3, discrete=True) for _ in range(2))
    ours.reset()
    theirs.reset()
    assert isinstance(ours.action_space, Discrete)
    indices = np.arange(9).reshape(3, 3) % ours.action_space.n
    table = ours.task.action_table
    assert table is not None
    outcome = ours.step(indices)
    assert same(outcome.observations, theirs.step(table[indices]).observations)
    assert not same(outcome.observations, ours.step(0 * indices).observations)
    with pytest.raises(TypeError, match="actions: expected whole numbers, got float64"):
        ours.step(np.zeros((3, 3)))
    with pytest.raises(ValueError, match=r"expected shape \(3, 3\) of integers, got \(3,\)"):
        ours.step(indices[0])
    with pytest.raises(ValueError, match=r"expected 0 to .*, got 99"):
        ours.step(indices + 99)


def test_integers_are_refused_where_actions_are_continuous() -> None:
    matches = Matches("VSSMulti-v0", 3)
    matches.reset()
    with pytest.raises(TypeError, match="floating-point"):
        matches.step(np.zeros((3, 3, 2), np.int64))


# -- Global states ----------------------------------------------------------------------------


def states_of_single_matches(steps: int, max_steps: int) -> list[Floats]:
    """States of three parallel environments after a reset and after each step."""
    matches = [parallel_env("VSSSelfPlay-v0", max_steps=max_steps) for _ in range(3)]
    for i, match in enumerate(matches):
        match.reset(seed=5 + i)
    found = [np.stack([match.state() for match in matches])]
    rng = np.random.default_rng(0)
    for _ in range(steps):
        actions = rng.uniform(-1, 1, (3, 6, 2)).astype(np.float32)
        for match, given in zip(matches, actions, strict=True):
            match.step(dict(zip(match.possible_agents, given, strict=True)))
        found.append(np.stack([match.state() for match in matches]))
    return found


@pytest.mark.parametrize("autoreset", MODES)
def test_states_are_those_of_single_matches(autoreset: str) -> None:
    expected = states_of_single_matches(4, 4)
    matches = Matches("VSSSelfPlay-v0", 3, seed=5, max_steps=4, autoreset=autoreset)
    matches.reset()
    assert same(matches.states(), expected[0])
    assert same(matches.final_states(), expected[0])
    rng = np.random.default_rng(0)
    for states in expected[1:]:
        outcome = matches.step(rng.uniform(-1, 1, (3, 6, 2)).astype(np.float32))
        assert same(matches.final_states(), states)
    assert outcome.truncated.all()
    assert same(matches.states(), states) == (autoreset != "same_step")
    matches.reset()
    assert same(matches.final_states(), matches.states())


def test_final_states_differ_from_states_only_where_an_episode_ended() -> None:
    matches = Matches("VSSSelfPlay-v0", 3, max_steps=4)
    matches.reset()
    played(matches, 2)
    matches.reset(mask=np.array([False, True, False]))
    ended = played(matches, 2)[-1].ended
    assert ended.tolist() == [True, False, True]
    assert (matches.final_states() != matches.states()).any(axis=1).tolist() == ended.tolist()
    assert not played(matches, 1)[-1].ended.any()
    assert same(matches.final_states(), matches.states())


def test_final_states_of_restored_matches_are_their_states() -> None:
    matches = Matches("VSSSelfPlay-v0", 2, max_steps=3)
    matches.reset()
    saved = matches.state_dict()
    assert played(matches, 3)[-1].ended.all()
    assert not same(matches.final_states(), matches.states())
    matches.load_state_dict(saved)
    assert same(matches.final_states(), matches.states())


def test_views_of_restored_matches_are_of_their_state() -> None:
    matches = Matches("VSSSelfPlay-v0", 2)
    matches.reset()
    saved, ball = matches.state_dict(), matches.play.view.ball.data.copy()
    played(matches, 3)
    assert not same(matches.play.view.ball.data, ball)
    matches.load_state_dict(saved)
    assert same(matches.play.view.ball.data, ball)


def test_restored_matches_that_have_not_begun_refuse_a_step() -> None:
    begun, restored = (Matches("VSSSelfPlay-v0", 2) for _ in range(2))
    begun.reset(mask=np.array([True, False]))
    restored.reset()
    restored.load_state_dict(begun.state_dict())
    with pytest.raises(RuntimeError, match="step before reset: some worlds have begun no episode"):
        restored.step(zeros(restored))


# -- Episodes ---------------------------------------------------------------------------------


@pytest.mark.parametrize("autoreset", MODES)
def test_episodes_are_the_sums_over_their_steps(autoreset: str) -> None:
    matches = Matches("VSSSelfPlay-v0", 4, max_steps=30, autoreset=autoreset)
    matches.reset()
    returns, lengths, found = np.zeros((4, 6)), np.zeros(4, int), 0
    rng = np.random.default_rng(1)
    for step in range(150):
        if step == 10:
            chosen = np.array([True, False, False, False])
            matches.reset(mask=chosen)
            returns[0], lengths[0] = 0.0, 0
        outcome = matches.step(rng.uniform(-1, 1, (4, 6, 2)).astype(np.float32))
        returns += outcome.rewards
        lengths += 1
        if not outcome.ended.any():
            assert outcome.episodes is None
        else:
            episodes = outcome.episodes
            assert episodes is not None
            ended = np.flatnonzero(outcome.ended)
            found += len(ended)
            assert episodes.worlds.tolist() == ended.tolist()
            np.testing.assert_allclose(episodes.returns, returns[ended])
            assert episodes.terminated.tolist() == outcome.terminated[ended].tolist()
            assert episodes.metrics["goal_score"].shape == (len(ended),)
            if autoreset == "same_step":
                assert episodes.lengths.tolist() == lengths[ended].tolist()
            returns[ended], lengths[ended] = 0.0, 0
        if autoreset == "disabled" and matches.done.any():
            matches.reset(mask=matches.done)
    assert found >= 12


def test_episodes_survive_a_save() -> None:
    ours = Matches("VSSSelfPlay-v0", 2, max_steps=6)
    ours.reset()
    played(ours, 3)
    restored = Matches("VSSSelfPlay-v0", 2, seed=9, max_steps=6)
    restored.load_state_dict(ours.state_dict())
    copies = [ours, restored, pickle.loads(pickle.dumps(ours))]
    episodes: list[Any] = [played(matches, 3)[-1].episodes for matches in copies]
    for found in episodes:
        assert isinstance(found, Episodes)
        assert found.lengths.tolist() == [6, 6]
        assert same(found.returns, episodes[0].returns)
    assert episodes[0].returns.any()


def test_without_learners_there_are_episodes_too() -> None:
    matches = Matches("VSS-v0", 2, max_steps=3, controllers={"all": "ou"})
    matches.reset()
    for _ in range(3):
        outcome = matches.step(zeros(matches))
    assert outcome.episodes is not None
    assert outcome.episodes.returns.shape == (2, 0)
    assert outcome.episodes.lengths.tolist() == [3, 3]
