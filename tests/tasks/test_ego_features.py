"""What the core says that robots see is what NumPy says."""

import pickle

import numpy as np
import pytest

from rsoccer import list_tasks, make_task
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, Sight
from rsoccer.matches import Matches
from rsoccer.tasks.soccer import Soccer
from tests.tasks import ego_features_reference


@pytest.mark.parametrize("name", list_tasks())
def test_robots_see_what_the_reference_says(name: str) -> None:
    task = make_task(name)
    assert isinstance(task, Soccer)
    matches = Matches(task, 8, seed=3)
    matches.reset()
    chance = np.random.default_rng(0)
    for _ in range(30):
        shape = (8, len(matches.agents), task.action_size)
        matches.step(chance.uniform(-1, 1, shape).astype(np.float32))
    blocks = task.frame_to_observations(matches.play)
    expected = ego_features_reference.blocks(matches.play.view, task.config)
    assert set(expected) <= set(blocks)
    for block, values in expected.items():
        assert blocks[block].shape == values.shape, block
        np.testing.assert_allclose(blocks[block], values, rtol=1e-6, atol=1e-7, err_msg=block)


def sight() -> Sight:
    config = make_task("VSSSelfPlay-v0").config
    return Sight(config.field, config.robot, 2, 3)


def views(n: int, slots: int = 6) -> tuple[np.ndarray, np.ndarray]:
    chance = np.random.default_rng(1)
    ball = chance.uniform(-1, 1, (n, 4, len(BALL_COLUMNS))).astype(np.float32)
    robots = chance.uniform(-1, 1, (n, 4, slots, len(ROBOT_COLUMNS))).astype(np.float32)
    return ball, robots


def test_each_observer_sees_what_it_would_alone_and_nothing_is_kept() -> None:
    ball, robots = views(5)
    eye = sight()
    seen, again = eye.look(ball, robots), eye.look(ball, robots)
    assert np.array_equal(seen, again)
    assert not np.shares_memory(seen, again), "each look has an array of its own"
    for world in range(5):
        for observer in range(4):
            one = (slice(world, world + 1), slice(observer, observer + 1))
            assert np.array_equal(sight().look(ball[one], robots[one])[0, 0], seen[world, observer])
    copied = pickle.loads(pickle.dumps(sight()))
    assert np.array_equal(copied.look(ball, robots), seen)
    assert copied.blocks == sight().blocks
    assert seen.shape[2] == sum(int(np.prod(shape)) for _, shape in sight().blocks)


def test_wrong_views_are_refused_by_name() -> None:
    ball, robots = views(2)
    with pytest.raises(ValueError, match=r"ball must have 3 axes, got shape \(14,\)"):
        sight().look(ball[0, 0], robots)
    with pytest.raises(ValueError, match=r"robots must have shape \(2, 4, 6, 11\)"):
        sight().look(ball, robots[:, :, :5])
    with pytest.raises(TypeError, match="robots must be an array of float32, got float64"):
        sight().look(ball, robots.astype(np.float64))
    with pytest.raises(ValueError, match="n_teammates"):
        Sight(make_task("VSS-v0").config.field, make_task("VSS-v0").config.robot, -1, 3)


def test_nobody_looks_at_nothing() -> None:
    ball, robots = views(3)
    assert sight().look(ball[:, :0], robots[:, :0]).shape[:2] == (3, 0)
