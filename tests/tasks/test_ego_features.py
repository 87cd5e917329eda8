"""The core's observation features equal their NumPy reference."""

import pickle

import numpy as np
import pytest

from rsoccer import _core, list_tasks, make_task
from rsoccer._core import EgoFeatures, Threads
from rsoccer.frame import Frame, row_size
from rsoccer.matches import Matches
from rsoccer.tasks import VssSelfPlay
from rsoccer.tasks.soccer import Soccer
from rsoccer.testing import check_task
from rsoccer.view import Viewpoint
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


class WithPresence(VssSelfPlay):
    """A task whose robots observe who is on the field."""

    OBSERVES_PRESENCE = True


def test_absent_robots_are_observed_as_zeros_and_by_their_flag() -> None:
    task = WithPresence()
    matches = Matches(task, 8, seed=3)
    matches.reset()
    absent = np.random.default_rng(0).random((8, 6)) < 0.4
    play = matches.play
    play.frame.robots.absent[:] = absent
    play.expire_views()
    blocks = task.frame_to_observations(play)
    expected = ego_features_reference.blocks(play.view, task.config, ~play.view.present)
    assert set(expected) == set(blocks) - {"action"}
    for block, values in expected.items():
        np.testing.assert_allclose(blocks[block], values, rtol=1e-6, atol=1e-7, err_msg=block)
    here = ~absent
    assert absent.any(axis=0).all(), "each robot is absent somewhere"
    assert (blocks["presence"][:, :, 0] == here).all()
    assert (blocks["presence"].sum(axis=2) == here.sum(axis=1, keepdims=True) * here).all()
    assert not blocks["ball"][absent].any()
    assert not blocks["opponents"][:, 0][absent[:, 3:]].any()
    assert not task.layout.observe(play)[absent][:, : -task.action_size].any()
    assert "presence" not in VssSelfPlay().layout.blocks


def test_presence_has_bounds_and_a_reflection() -> None:
    task = WithPresence()
    columns = task.layout.blocks["presence"].columns
    assert task.layout.high[columns].tolist() == [1.0] * 6
    mirror = task.layout.reflection
    assert mirror is not None
    assert mirror.signs[columns].tolist() == [1.0] * 6
    assert mirror.order[columns].tolist() == list(range(columns.start, columns.stop))
    check_task(WithPresence())


def encoder(*, presence: bool = False) -> EgoFeatures:
    config = make_task("VSSSelfPlay-v0").config
    return EgoFeatures(config.field, config.robot, 2, 3, presence)


VIEWPOINT = Viewpoint(3, 3, [0, 2, 3, 5]).core
ACTION_SIZE = 2
SIZE = sum(int(np.prod(shape)) for _, shape in encoder().blocks) + ACTION_SIZE


def states(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows and actions of n worlds."""
    rng = np.random.default_rng(1)
    frame = Frame(rng.uniform(-1, 1, (n, row_size(3, 3))).astype(np.float32), 3, 3)
    frame.robots.absent[:] = 0.0
    return frame.rows, rng.uniform(-1, 1, (n, 6, ACTION_SIZE)).astype(np.float32)


def encoded(
    rows: np.ndarray,
    actions: np.ndarray,
    viewpoint: _core.Viewpoint = VIEWPOINT,
    *,
    observers: int = 4,
    features: EgoFeatures | None = None,
    bounds: np.ndarray | None = None,
    threads: Threads | None = None,
) -> np.ndarray:
    out = np.full((len(rows), observers, SIZE), np.nan, np.float32)
    (features or encoder()).encode(viewpoint, rows, actions, out, bounds, threads)
    return out


def test_features_of_an_observer_depend_on_its_row_only() -> None:
    rows, actions = states(5)
    features = encoded(rows, actions)
    assert np.isfinite(features).all()
    for world in range(5):
        for index, observer in enumerate([0, 2, 3, 5]):
            one = Viewpoint(3, 3, [observer]).core
            alone = encoded(rows[world : world + 1], actions[world : world + 1], one, observers=1)
            assert np.array_equal(alone[0, 0], features[world, index])
    copied = pickle.loads(pickle.dumps(encoder()))
    assert np.array_equal(encoded(rows, actions, features=copied), features)
    assert copied.blocks == encoder().blocks
    flagged = pickle.loads(pickle.dumps(encoder(presence=True)))
    assert flagged.blocks == (*encoder().blocks, ("presence", (6,)))


def test_the_last_action_follows_the_features() -> None:
    rows, actions = states(3)
    assert np.array_equal(encoded(rows, actions)[:, :, -2:], actions[:, [0, 2, 3, 5]])


def test_columns_behind_the_features_stay_as_they_are() -> None:
    rows, actions = states(3)
    out = np.full((3, 4, SIZE + 2), 7.0, np.float32)
    encoder().encode(VIEWPOINT, rows, actions, out, np.full(SIZE, 0.25, np.float32))
    assert (out[..., SIZE:] == 7.0).all()
    bounds = np.full(SIZE, 0.25, np.float32)
    assert np.array_equal(out[..., :SIZE], encoded(rows, actions, bounds=bounds))


def test_bounds_clip_features_and_actions() -> None:
    rows, actions = states(20)
    free, bounds = encoded(rows, actions), np.full(SIZE, 0.25, np.float32)
    clipped = encoded(rows, actions, bounds=bounds)
    assert np.array_equal(clipped, np.clip(free, -0.25, 0.25))
    assert not np.array_equal(clipped, free)


def test_features_do_not_depend_on_the_number_of_threads() -> None:
    rows, actions = states(700)
    alone = encoded(rows, actions)
    for threads in (1, 2, 5):
        assert np.array_equal(encoded(rows, actions, threads=Threads(threads)), alone)


def test_wrong_arrays_are_refused_by_name() -> None:
    rows, actions = states(2)
    with pytest.raises(ValueError, match=r"rows must have 2 axes, got shape \(89,\)"):
        encoded(rows[0], actions)
    with pytest.raises(ValueError, match=r"actions must have shape \(2, 6, 2\)"):
        encoded(rows, actions[:, :5])
    with pytest.raises(TypeError, match="rows must be an array of float32, got float64"):
        encoded(rows.astype(np.float64), actions)
    with pytest.raises(ValueError, match=r"out must have shape \(2, 4, 80\), got \(2, 3, 80\)"):
        encoded(rows, actions, observers=3)
    with pytest.raises(ValueError, match="bounds must be 0 or above, got -1"):
        encoded(rows, actions, bounds=-np.ones(SIZE, np.float32))
    with pytest.raises(ValueError, match="viewpoint must have 6 slots, got 4"):
        encoded(rows, actions, Viewpoint(2, 2, [0, 1, 2, 3]).core)
    with pytest.raises(ValueError, match="n_teammates"):
        EgoFeatures(make_task("VSS-v0").config.field, make_task("VSS-v0").config.robot, -1, 3)


def test_no_observers_have_no_features() -> None:
    rows, actions = states(3)
    assert encoded(rows, actions, Viewpoint(3, 3, []).core, observers=0).shape == (3, 0, SIZE)
