import numpy as np

from rsoccer.rules import free_places


def test_positions_near_a_robot_are_not_free() -> None:
    positions = np.array([[0.0, 0.0], [0.3, 0.0], [0.0, -0.11]], np.float32)
    robots = np.array([[0.0, 0.1], [2.0, 2.0]], np.float32)
    assert free_places.is_free(positions, robots, 0.2).tolist() == [False, True, True]
    assert free_places.is_free(positions, robots[:0], 0.2).all(), "without robots"
    batch = np.stack([positions, positions + np.float32(0.3)])
    many = np.stack([robots, robots + np.float32(0.3)])
    assert free_places.is_free(batch, many, 0.2).tolist() == [[False, True, True]] * 2


def test_a_grid_is_symmetric_and_starts_at_its_corner() -> None:
    grid = free_places.grid(0.31, 0.12, 0.1)
    assert grid.shape == (7 * 3, 2)
    assert np.allclose(grid[0], (0.3, 0.1))
    assert np.array_equal(grid, -grid[::-1])


def test_the_nearest_free_position_is_the_first_of_equal_ones() -> None:
    positions = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 0.1]], np.float32)
    target = np.zeros(2, np.float32)
    free = np.array([True, True, False])
    assert free_places.nearest(positions, free, target).tolist() == [1.0, 0.0]
    assert np.allclose(free_places.nearest(positions, ~free, target), (0.0, 0.1))
