"""The model of a match in which policies try actions."""

import numpy as np
import pytest

from rsoccer import Matches, make_task
from rsoccer._core import Threads
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import Game
from rsoccer.policies.forward_model import ForwardModel

TASK = make_task("VSSSelfPlay-v0")
ALL = list(range(6))
STEPS = 20


def in_play(worlds: int) -> tuple[Matches, Floats]:
    """Matches that have played for half a second, and their last actions."""
    matches = Matches(TASK, worlds, seed=3, autoreset="disabled")
    matches.reset()
    rng = np.random.default_rng(1)
    for _ in range(STEPS):
        actions = rng.uniform(-1, 1, (worlds, 6, 2)).astype(np.float32)
        matches.step(actions)
    return matches, actions


def still(worlds: int) -> Floats:
    return np.zeros((worlds, 6, 2), np.float32)


def test_it_goes_on_as_the_matches_do() -> None:
    matches, last = in_play(8)
    rows, game = matches.frame.rows.copy(), matches.play.game.take(np.arange(8))
    model = ForwardModel(TASK, ALL, 8, Threads())
    actions = np.random.default_rng(0).uniform(-1, 1, (8, 6, 2)).astype(np.float32)
    expected = matches.step(last).observations  # so that its observations are the last ones
    matches, last = in_play(8)
    np.testing.assert_array_equal(model.observe(rows, last), matches._observations)
    assert expected.shape == (8, 6, TASK.layout.size)
    model.place(rows, game)
    returns, ended, observations = model.advance(actions, 3)
    rewards = np.zeros((8, 6), np.float32)
    for _ in range(3):
        outcome = matches.step(actions)
        rewards += outcome.rewards
    # Contacts begin anew where a state is placed, so bodies differ by some tenths of a millimeter.
    np.testing.assert_allclose(returns, rewards, atol=0.02)
    assert np.abs(returns).max() > 0.1
    np.testing.assert_array_equal(ended, outcome.terminated)
    np.testing.assert_allclose(observations, outcome.observations, atol=0.05)


def test_columns_of_rules_go_on() -> None:
    """A ball that has been stuck for 9.9 s is about to be a free ball."""
    matches, _ = in_play(1)
    model = ForwardModel(TASK, ALL, 1, Threads())
    game = matches.play.game.take(np.arange(1))
    for steps in (5, 300):
        game.stuck_steps[:] = steps
        model.place(matches.frame.rows, game)
        assert model._play.game.stuck_steps.tolist() == [steps]
    model.place(matches.frame.rows, Game({"score": np.array([[3, 4]])}))
    assert model._play.game.score.tolist() == [[3, 4]]
    assert model._play.game.stuck_steps.tolist() == [0], "not those of the last use"


def test_a_goal_counts_once_and_nothing_after_it() -> None:
    frame = Frame.empty(2, 3, 3)
    frame.robots.position[:, :, 0] = -0.5
    frame.robots.position[:, :, 1] = np.linspace(-0.5, 0.5, 6)
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = (0.72, 0.0), (0.0, 0.0)
    frame.ball.velocity[0] = 2.0, 0.0
    model = ForwardModel(TASK, ALL, 2, Threads())
    game = Game({"score": np.zeros((2, 2), np.int64)})
    for _ in range(2):  # a second use begins anew
        model.place(frame.rows, game)
        returns, ended, _ = model.advance(still(2), 40)
        assert ended.tolist() == [True, False]
        assert (returns[0, :3] > 9.0).all()
        assert (returns[0, 3:] < -9.0).all()
        assert np.abs(returns[1]).max() < 0.1
    assert not game.score.any(), "the game of the match is left alone"


def test_estimates_may_overlap() -> None:
    frame = Frame.empty(1, 3, 3)
    frame.robots.heading[:] = 1.0, 0.0
    frame.ball.position[:] = 0.3, 0.3
    model = ForwardModel(TASK, ALL, 1, Threads())
    model.place(frame.rows, Game({"score": np.zeros((1, 2), np.int64)}))  # six at one place
    assert np.isfinite(model.advance(still(1) + 1.0, 3)[2]).all()


@pytest.mark.parametrize(
    ("name", "kept"),
    [("SSLDribbling-v0", "passed"), ("VSSMatch-v0", "referee"), ("SSLMatch-v0", "referee")],
)
def test_a_task_that_keeps_more_than_bodies_is_refused(name: str, kept: str) -> None:
    with pytest.raises(ValueError, match=f"got {name}, which also keeps: {kept}"):
        ForwardModel(make_task(name), [0], 1, Threads())
