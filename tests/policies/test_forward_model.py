"""The model of a match in which policies try actions."""

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches, make_task
from rsoccer._core import Threads
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.policies.forward_model import ForwardModel

TASK = make_task("VSSSelfPlay-v0")
ALL = list(range(6))


def starts(worlds: int) -> Floats:
    """States of matches that have played for half a second."""
    matches = Matches(TASK, worlds, seed=3, controllers={"all": "chase"}, autoreset="disabled")
    matches.reset()
    for _ in range(20):
        matches.step(np.zeros((worlds, 0, 2), np.float32))
    return matches.frame.rows.copy()


def test_it_goes_on_as_matches_from_the_same_states_do() -> None:
    rows = starts(8)
    actions = np.random.default_rng(0).uniform(-1, 1, (8, 6, 2)).astype(np.float32)
    matches = Matches(TASK, 8, autoreset="disabled")
    expected = matches.reset(rows=rows)
    model = ForwardModel(TASK, ALL, 8, Threads())
    np.testing.assert_array_equal(model.observe(rows), expected)
    model.place(rows)
    returns, ended, observations = model.advance(actions, 3)
    rewards = np.zeros((8, 6), np.float32)
    for _ in range(3):
        outcome = matches.step(actions)
        rewards += outcome.rewards
    np.testing.assert_allclose(returns, rewards, atol=1e-5)
    assert np.abs(returns).max() > 0.01
    np.testing.assert_array_equal(ended, outcome.terminated)
    np.testing.assert_array_equal(observations, outcome.observations)


def test_a_goal_counts_once_and_nothing_after_it() -> None:
    frame = Frame.empty(2, 3, 3)
    frame.robots.position[:, :, 0] = -0.5
    frame.robots.position[:, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = (0.72, 0.0), (0.0, 0.0)
    frame.ball.velocity[0] = 2.0, 0.0
    model = ForwardModel(TASK, ALL, 2, Threads())
    for _ in range(2):  # a second use begins anew
        model.place(frame.rows)
        returns, ended, _ = model.advance(np.zeros((2, 6, 2), np.float32), 40)
        assert ended.tolist() == [True, False]
        assert (returns[0, :3] > 9.0).all()
        assert (returns[0, 3:] < -9.0).all()
        assert np.abs(returns[1]).max() < 0.1


def test_estimates_may_overlap() -> None:
    frame = Frame.empty(1, 3, 3)
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = 0.3, 0.3
    model = ForwardModel(TASK, ALL, 1, Threads())
    model.place(frame.rows)  # six robots at one place
    assert np.isfinite(model.advance(np.ones((1, 6, 2), np.float32), 3)[2]).all()


def test_a_task_with_memory_is_refused() -> None:
    task = rsoccer.make_task("SSLDribbling-v0")
    with pytest.raises(ValueError, match=r"without memory.*got SSLDribbling-v0, which keeps"):
        ForwardModel(task, [0], 1, Threads())
