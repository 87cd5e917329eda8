import numpy as np
import pytest

from rsoccer.vectors import norm, rotate_into, rotate_into_body, unit

X, Y = np.array([3.0, 0.0], np.float32), np.array([4.0, 0.0], np.float32)


def test_norm() -> None:
    assert norm(X, Y).tolist() == [5.0, 0.0]
    assert norm(X, Y).dtype == np.float32


def test_unit_vectors_of_zero_vectors_are_zero() -> None:
    assert np.stack(unit(X, Y), axis=-1) == pytest.approx(np.array([[0.6, 0.8], [0.0, 0.0]]))


def test_a_robot_that_faces_plus_y_has_plus_x_on_its_right() -> None:
    heading = np.array([[0.0, 1.0]] * 2, np.float32)
    ahead, left = rotate_into_body(X, Y, heading)
    assert (ahead.tolist(), left.tolist()) == ([4.0, 0.0], [-3.0, 0.0])
    same = rotate_into(X, Y, heading[:, 0], heading[:, 1])
    assert np.array_equal(same, (ahead, left))
