"""The core's observation features equal their NumPy reference."""

import pickle

import numpy as np
import pytest

from rsoccer import list_tasks, make_task
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, EgoFeatures
from rsoccer.matches import Matches
from rsoccer.tasks.soccer import Soccer
from tests.tasks import ego_features_reference


@pytest.mark.parametrize("name", list_tasks())
def test_features_equal_the_reference(name: str) -> None:
    task = make_task(name)
    assert isinstance(task, Soccer)
    matches = Matches(task, 8, seed=3)
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(30):
        shape = (8, len(matches.agents), task.action_size)
        matches.step(rng.uniform(-1, 1, shape).astype(np.float32))
    blocks = task.frame_to_observations(matches.play)
    expected = ego_features_reference.blocks(matches.play.view, task.config)
    assert set(expected) <= set(blocks)
    for block, values in expected.items():
        assert blocks[block].shape == values.shape, block
        np.testing.assert_allclose(blocks[block], values, rtol=1e-6, atol=1e-7, err_msg=block)


def encoder() -> EgoFeatures:
    config = make_task("VSSSelfPlay-v0").config
    return EgoFeatures(config.field, config.robot, 2, 3)


def views(n: int, slots: int = 6) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    ball = rng.uniform(-1, 1, (n, 4, len(BALL_COLUMNS))).astype(np.float32)
    robots = rng.uniform(-1, 1, (n, 4, slots, len(ROBOT_COLUMNS))).astype(np.float32)
    return ball, robots


def test_features_of_an_observer_depend_on_its_view_only() -> None:
    ball, robots = views(5)
    shared = encoder()
    features, again = shared.encode(ball, robots), shared.encode(ball, robots)
    assert np.array_equal(features, again)
    assert not np.shares_memory(features, again), "each call returns an array of its own"
    for world in range(5):
        for observer in range(4):
            one = (slice(world, world + 1), slice(observer, observer + 1))
            assert np.array_equal(
                encoder().encode(ball[one], robots[one])[0, 0], features[world, observer]
            )
    copied = pickle.loads(pickle.dumps(encoder()))
    assert np.array_equal(copied.encode(ball, robots), features)
    assert copied.blocks == encoder().blocks
    assert features.shape[2] == sum(int(np.prod(shape)) for _, shape in encoder().blocks)


def test_wrong_views_are_refused_by_name() -> None:
    ball, robots = views(2)
    with pytest.raises(ValueError, match=r"ball must have 3 axes, got shape \(14,\)"):
        encoder().encode(ball[0, 0], robots)
    with pytest.raises(ValueError, match=r"robots must have shape \(2, 4, 6, 11\)"):
        encoder().encode(ball, robots[:, :, :5])
    with pytest.raises(TypeError, match="robots must be an array of float32, got float64"):
        encoder().encode(ball, robots.astype(np.float64))
    with pytest.raises(ValueError, match="n_teammates"):
        EgoFeatures(make_task("VSS-v0").config.field, make_task("VSS-v0").config.robot, -1, 3)


def test_no_observers_have_no_features() -> None:
    ball, robots = views(3)
    assert encoder().encode(ball[:, :0], robots[:, :0]).shape[:2] == (3, 0)
