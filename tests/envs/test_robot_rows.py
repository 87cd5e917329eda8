"""Rows of robots against the order that they promise: row i * k + j is robot j of match i."""

import numpy as np

from rsoccer import Matches
from rsoccer.envs.robot_rows import RobotRows

WORLDS, ROBOTS = 3, 2
ROWS = RobotRows(WORLDS, ("blue_0", "yellow_1"))


def test_rows_are_those_of_the_learners_of_matches() -> None:
    rows = RobotRows.of(Matches("VSSMulti-v0", 4))
    assert (rows.worlds, rows.robots, len(rows)) == (4, ("blue_0", "blue_1", "blue_2"), 12)


def test_values_by_match_and_robot_become_rows_and_return() -> None:
    values = np.arange(WORLDS * ROBOTS * 5).reshape(WORLDS, ROBOTS, 5)
    flat = ROWS.flat(values)
    for row in range(len(ROWS)):
        np.testing.assert_array_equal(flat[row], values[ROWS.world(row), row % ROBOTS])
    np.testing.assert_array_equal(ROWS.by_match(flat), values)
    assert np.shares_memory(flat, values)


def test_values_of_a_match_are_those_of_its_robots() -> None:
    assert ROWS.repeated(np.array([4, 5, 6])).tolist() == [4, 4, 5, 5, 6, 6]
    alone, values = RobotRows(WORLDS, ("blue_0",)), np.array([4, 5, 6])
    assert alone.repeated(values) is values


def test_values_of_some_matches_leave_zeros_in_the_others() -> None:
    some = np.array([0, 2])
    by_robot = np.array([[1.0, 2.0], [3.0, 4.0]])
    assert ROWS.scattered(some, by_robot).tolist() == [1, 2, 0, 0, 3, 4]
    shared = ROWS.scattered(some, np.array([[7], [8]]))
    assert shared.tolist() == [7, 7, 0, 0, 8, 8] and shared.dtype == np.int64
