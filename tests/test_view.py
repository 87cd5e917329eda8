import copy

import numpy as np
import pytest

from rsoccer import _core
from rsoccer._core import CROSSINGS
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, NO_CROSSING, Frame
from rsoccer.view import CachedView, View, Viewpoint
from tests import view_reference


def random_frame(n: int, n_blue: int, n_yellow: int, seed: int = 0) -> Frame:
    frame = Frame.empty(n, n_blue, n_yellow)
    frame.rows[:] = np.random.default_rng(seed).uniform(-1, 1, frame.rows.shape)
    frame.ball.crossed[:] = np.random.default_rng(seed).integers(0, 3, n)
    frame.ball.last_touch[:] = -1
    frame.robots.absent[:] = 0.0
    return frame


def view_of(
    frame: Frame, observers: list[int], sides: tuple[str, ...] = ("blue", "yellow")
) -> View:
    viewpoint = Viewpoint(frame.n_blue, frame.n_yellow, observers, sides)
    view = viewpoint.new_view(len(frame))
    viewpoint.fill(frame, view)
    return view


def rotated(frame: Frame) -> Frame:
    """The same state with the teams swapped and the field rotated by half a turn."""
    other = Frame.empty(len(frame), frame.n_yellow, frame.n_blue)
    for team, source in ((other.blue, frame.yellow), (other.yellow, frame.blue)):
        team.data[:] = source.data
        for vector in (team.position, team.heading, team.velocity):
            vector *= -1
    other.ball.data[:] = frame.ball.data
    horizontal = other.ball.spin[..., :2]
    for vector in (other.ball.position, other.ball.velocity, other.ball.crossed_at, horizontal):
        vector *= -1
    crossed = frame.ball.crossed
    other.ball.crossed[crossed == GOAL_RIGHT] = GOAL_LEFT
    other.ball.crossed[crossed == GOAL_LEFT] = GOAL_RIGHT
    return other


def test_slots_are_ego_then_teammates_in_ring_order_then_opponents() -> None:
    frame = random_frame(4, 3, 3)
    view = view_of(frame, [1])
    order = [1, 2, 0, 3, 4, 5]
    assert (view.robots.data[:, 0] == frame.robots.data[:, order]).all()
    assert (view.ego.data[:, 0] == frame.blue.data[:, 1]).all()
    assert (view.teammates.position[:, 0] == frame.blue.position[:, [2, 0]]).all()
    assert (view.opponents.angular_velocity[:, 0] == frame.yellow.angular_velocity).all()
    assert (view.ball.data[:, 0] == frame.ball.data).all()


def test_yellows_view_is_blues_view_of_the_rotated_field() -> None:
    frame = random_frame(9, 3, 2)
    assert {NO_CROSSING, GOAL_RIGHT, GOAL_LEFT} == set(frame.ball.crossed.tolist())
    yellow = view_of(frame, [3, 4])
    blue = view_of(rotated(frame), [0, 1])
    assert np.array_equal(yellow.robots.data, blue.robots.data)
    assert np.array_equal(yellow.ball.data, blue.ball.data)
    assert not np.array_equal(yellow.ball.data, view_of(frame, [0, 1]).ball.data)


def test_signs_are_those_of_the_observers_teams() -> None:
    viewpoint = Viewpoint(2, 2, [0, 3, 1])
    for each in (viewpoint, copy.deepcopy(viewpoint)):
        assert each.signs.tolist() == [1.0, -1.0, 1.0] and each.signs.dtype == np.float32
        assert not each.signs.flags.writeable


def test_teams_of_different_size_leave_slots_empty() -> None:
    frame = random_frame(2, 1, 3)
    view = view_of(frame, [0, 2])
    assert view.robots.data.shape[2] == 1 + 2 + 3
    expected = [[True, False, False, True, True, True], [True] * 4 + [False] * 2]
    assert view.present.tolist() == [expected] * 2
    for empty in (view.robots.data[:, 0, 1:3], view.robots.data[:, 1, 4:]):
        assert not empty[..., :-1].any()
        assert (empty[..., -1] == 1.0).all()
    assert (view.opponents.position[:, 1, 0] == -frame.blue.position[:, 0]).all()


def test_slots_fit_the_sides_with_observers() -> None:
    frame = random_frame(2, 1, 3)
    assert view_of(frame, [0], sides=("blue",)).robots.data.shape[2] == 1 + 0 + 3
    with pytest.raises(ValueError, match="robot 2 cannot observe"):
        view_of(frame, [2], sides=("blue",))


@pytest.mark.parametrize("observers", [slice(1, 3), np.array([0, 2])])
def test_select_returns_some_observers(observers: slice | np.ndarray) -> None:
    view = view_of(random_frame(2, 3, 3), [0, 2, 4])
    part = view.select(observers)
    assert (part.ego.data == view.ego.data[:, observers]).all()
    assert (part.opponents.data == view.opponents.data[:, observers]).all()
    assert (part.present == view.present[:, observers]).all()


def test_absent_robots_look_like_empty_slots() -> None:
    frame = random_frame(2, 2, 3)
    frame.robots.absent[0, [1, 3]] = 1.0
    view = view_of(frame, [0, 1, 4])
    assert view.present[0].tolist() == [
        [True, False, False, True, False, True],
        [False, True, False, True, False, True],
        [True, True, False, True, False, False],
    ]
    assert view.present[1].sum(axis=1).tolist() == [5, 5, 5]
    for world in range(2):
        gone = ~view.present[world]
        assert not view.robots.data[world][gone][:, :-1].any()
        assert (view.robots.absent[world][gone] == 1.0).all()
        assert view.robots.data[world][~gone].all(axis=-1).sum() == 0, "`absent` of the others is 0"


def test_take_copies_some_worlds() -> None:
    view = view_of(random_frame(5, 2, 2), [0, 3])
    worlds = np.array([4, 1])
    part = view.take(worlds)
    assert np.array_equal(part.robots.data, view.robots.data[worlds])
    assert np.array_equal(part.ball.data, view.ball.data[worlds])
    assert not np.shares_memory(part.ball.data, view.ball.data)


def test_a_cached_view_is_computed_again_after_it_has_expired() -> None:
    frame, viewpoint = random_frame(3, 2, 2), Viewpoint(2, 2, [0, 3])
    cached = CachedView()
    view = cached.of(frame, viewpoint)
    before = view.ball.position.copy()
    frame.ball.position[:] += 1.0
    assert np.array_equal(cached.of(frame, viewpoint).ball.position, before)
    cached.expire()
    assert cached.of(frame, viewpoint) is view
    assert np.array_equal(view.ball.position[:, 0], frame.ball.position)
    assert np.array_equal(view.ball.position[:, 1], -frame.ball.position)


def test_a_cached_view_cannot_be_written_by_its_readers() -> None:
    frame, viewpoint = random_frame(3, 2, 2), Viewpoint(2, 2, [0, 3])
    cached = CachedView()
    view = cached.of(frame, viewpoint)
    for part in (view, view.select(slice(0, 1))):
        for array in (part.ball.data, part.ego.position, part.robots.data):
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 0.0
    twin = copy.deepcopy(cached)
    frame.ball.position[:] += 1.0
    assert np.array_equal(twin.of(frame, viewpoint).ball.position[:, 0], frame.ball.position)


def test_a_view_may_have_no_observers() -> None:
    assert view_of(random_frame(3, 2, 2), []).robots.data.shape[:2] == (3, 0)


@pytest.mark.parametrize(("n_blue", "n_yellow"), [(3, 3), (1, 3), (4, 2), (2, 0), (11, 11)])
def test_views_equal_the_reference_bit_for_bit(n_blue: int, n_yellow: int) -> None:
    frame = random_frame(3 * len(CROSSINGS), n_blue, n_yellow)
    frame.ball.crossed[:] = np.tile(np.arange(len(CROSSINGS)), 3)
    frame.robots.absent[:] = np.random.default_rng(1).integers(0, 2, frame.robots.absent.shape)
    view = view_of(frame, list(range(n_blue + n_yellow)))
    for observer in range(n_blue + n_yellow):
        ball, robots = view_reference.reference_view(frame, observer)
        assert view.ball.data[:, observer].tobytes() == ball.tobytes()
        assert np.array_equal(view.robots.data[:, observer], robots)


def test_fill_overwrites_everything() -> None:
    frame = random_frame(4, 1, 3)
    viewpoint = Viewpoint(1, 3, [0, 2])
    view, fresh = viewpoint.new_view(4), viewpoint.new_view(4)
    view.ball.data[:], view.robots.data[:] = np.nan, np.nan
    viewpoint.fill(frame, view)
    viewpoint.fill(frame, fresh)
    assert np.array_equal(view.robots.data, fresh.robots.data)
    assert np.array_equal(view.ball.data, fresh.ball.data)


def test_wrong_arrays_and_slots_are_refused_by_name() -> None:
    frame, viewpoint = random_frame(4, 2, 2), _core.Viewpoint(4, [[0, 1, 2, None]], [False])
    ball, robots = np.zeros((4, 1, 17), np.float32), np.zeros((4, 1, 4, 12), np.float32)
    viewpoint.fill(frame.rows, ball, robots)
    with pytest.raises(ValueError, match=r"rows must have 2 axes, got shape \(65,\)"):
        viewpoint.fill(frame.rows[0], ball, robots)
    with pytest.raises(ValueError, match=r"ball must have shape \(4, 1, 17\), got \(3, 1, 17\)"):
        viewpoint.fill(frame.rows, ball[:3], robots)
    with pytest.raises(TypeError, match="robots must be an array of float32, got float64"):
        viewpoint.fill(frame.rows, ball, robots.astype(np.float64))
    with pytest.raises(ValueError, match="slots must hold robots below 4, got 4"):
        _core.Viewpoint(4, [[0, 4]], [False])
    with pytest.raises(ValueError, match="slots must have a row for each of rotated"):
        _core.Viewpoint(4, [[0, 1], [1]], [False, False])
