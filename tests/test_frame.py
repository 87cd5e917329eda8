import copy

import numpy as np
import pytest

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.frame import (
    GOAL_LEFT,
    GOAL_RIGHT,
    NO_CROSSING,
    BallColumns,
    Frame,
    RobotColumns,
    column_slice,
    robot_names,
    row_size,
    team_of,
)


def numbered(n: int, n_blue: int, n_yellow: int) -> Frame:
    size = row_size(n_blue, n_yellow)
    return Frame(np.arange(n * size, dtype=np.float32).reshape(n, size), n_blue, n_yellow)


def test_properties_read_the_cores_columns() -> None:
    frame = numbered(2, 1, 2)
    row = frame.rows[1].tolist()
    ball = dict(zip(BALL_COLUMNS, row, strict=False))
    third = dict(zip(ROBOT_COLUMNS, row[-len(ROBOT_COLUMNS) :], strict=True))
    assert frame.ball.position[1].tolist() == [ball["x"], ball["y"]]
    assert frame.ball.velocity[1].tolist() == [ball["v_x"], ball["v_y"]]
    assert frame.ball.crossed[1] == ball["crossed"]
    assert frame.ball.crossed_at[1].tolist() == [ball["crossed_x"], ball["crossed_y"]]
    for name in ("seconds_since_touch", "speed_after_touch", "height_since_touch"):
        assert getattr(frame.ball, name)[1] == ball[name]
    assert frame.yellow.position[1, 1].tolist() == [third["x"], third["y"]]
    assert frame.robots.heading[1, 2].tolist() == [third["cos"], third["sin"]]
    assert frame.robots.velocity[1, 2].tolist() == [third["v_x"], third["v_y"]]
    assert frame.robots.angular_velocity[1, 2] == third["v_theta"]


def test_blue_comes_first() -> None:
    frame = numbered(3, 2, 1)
    assert frame.blue.data.shape == (3, 2, len(ROBOT_COLUMNS))
    assert (frame.blue.data == frame.robots.data[:, :2]).all()
    assert (frame.yellow.data == frame.robots.data[:, 2:]).all()


def test_properties_are_views_not_copies() -> None:
    frame = Frame.empty(2, 3, 3)
    frame.ball.velocity[1] = 5.0
    frame.yellow.angular_velocity[:, 2] = 7.0
    assert (frame.rows == 5.0).sum() == 2
    assert (frame.rows == 7.0).sum() == 2


def test_an_empty_frame_is_zeros_and_robots_face_plus_x() -> None:
    frame = Frame.empty(2, 1, 1)
    assert (frame.robots.heading == [1.0, 0.0]).all()
    assert (frame.ball.last_touch == -1.0).all()
    assert frame.rows.sum() == 4.0 - 2.0
    assert len(frame) == 2


def test_a_copy_has_its_own_memory() -> None:
    frame = numbered(2, 1, 1)
    copy = frame.copy()
    copy.ball.position[:] = -1.0
    assert frame.ball.position.min() >= 0.0
    assert (copy.n_blue, copy.n_yellow) == (1, 1)


@pytest.mark.parametrize(
    "rows",
    [
        np.zeros((2, 5), np.float32),
        np.zeros(row_size(3, 3), np.float32),
        np.zeros((2, row_size(3, 3)), np.float64),
        np.zeros((row_size(3, 3), 2), np.float32).T,
    ],
    ids=["width", "one axis", "float64", "not contiguous"],
)
def test_rows_that_do_not_fit_are_refused(rows: np.ndarray) -> None:
    with pytest.raises(ValueError, match="rows: expected"):
        Frame(rows, 3, 3)


def test_a_read_only_frame_shows_later_writes_and_takes_none() -> None:
    frame = Frame.empty(2, 1, 1)
    shown = frame.read_only
    assert frame.read_only is shown.read_only is shown
    frame.ball.position[:] = 0.5
    assert np.array_equal(shown.rows, frame.rows)
    with pytest.raises(ValueError, match="read-only"):
        shown.blue.position[:] = 1.0
    shown.copy().ball.position[:] = 1.0
    assert copy.deepcopy(frame).read_only is not shown


def test_robot_names() -> None:
    assert robot_names(2, 1) == ("blue_0", "blue_1", "yellow_0")
    assert [team_of(name) for name in robot_names(1, 11)] == ["blue"] + ["yellow"] * 11


def test_crossings_are_indices_of_the_cores_names() -> None:
    assert CROSSINGS[NO_CROSSING] == "none"
    assert CROSSINGS[GOAL_RIGHT] == "goal_right"
    assert CROSSINGS[GOAL_LEFT] == "goal_left"


def test_columns_that_are_no_neighbors_are_refused() -> None:
    with pytest.raises(ImportError, match="side by side"):
        column_slice(("x", "z", "y"), "x", "y")


def test_columns_take_any_leading_axes() -> None:
    assert BallColumns(np.zeros((4, 2, 9), np.float32)).position.shape == (4, 2, 2)
    assert RobotColumns(np.zeros(9, np.float32)).heading.shape == (2,)
