"""The binding: new states of worlds, given in an array that is also the output."""

import numpy as np
import pytest

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig, Simulator
from rsoccer.arrays import Floats

WORLDS = 3
CONFIG = SimConfig()
EVERY = np.ones(WORLDS, np.bool_)
ABSENT = slice(len(BALL_COLUMNS) + ROBOT_COLUMNS.index("absent"), None, len(ROBOT_COLUMNS))


def starts(seed: int = 0) -> Floats:
    """Valid rows (n, row) that differ from each other and from the default line-up."""
    rows = np.zeros((WORLDS, CONFIG.row_size), np.float32)
    Simulator(CONFIG, WORLDS).read(rows)
    rng = np.random.default_rng(seed)
    rows[:, :2] += rng.uniform(-0.1, 0.1, (WORLDS, 2)).astype(np.float32)
    rows[:, 3:5] = rng.uniform(-1.0, 1.0, (WORLDS, 2)).astype(np.float32)
    return rows


@pytest.mark.parametrize("method", ["place", "restart"])
def test_rows_can_be_the_output(method: str) -> None:
    apart, within = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    rows = starts()
    expected = np.empty_like(rows)
    getattr(apart, method)(EVERY, rows, expected)
    getattr(within, method)(EVERY, rows, rows)
    np.testing.assert_array_equal(rows, expected)
    assert within.snapshot() == apart.snapshot()


@pytest.mark.parametrize("method", ["place", "restart"])
def test_rows_can_be_a_part_of_the_output(method: str) -> None:
    # The rows of the first two worlds are those of the last two: each must be read before any is
    # written.
    apart, within = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    mask, rows = np.array([False, True, True]), starts()
    expected = rows.copy()
    getattr(apart, method)(mask, rows[:2].copy(), expected)
    getattr(within, method)(mask, rows[:2], rows)
    np.testing.assert_array_equal(rows, expected)
    assert within.snapshot() == apart.snapshot()
    np.testing.assert_array_equal(rows[0], starts()[0])


def test_parameters_can_lie_in_the_output() -> None:
    apart, within = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    memory = np.zeros((WORLDS, CONFIG.row_size), np.float32)
    parameters = memory.reshape(-1)[: WORLDS * CONFIG.parameters_size]
    parameters = parameters.reshape(WORLDS, CONFIG.parameters_size)
    parameters[:] = np.random.default_rng(1).uniform(0.5, 1.0, parameters.shape)
    expected = np.empty_like(memory)
    apart.place(EVERY, starts(), expected, parameters.copy())
    within.place(EVERY, starts(), memory, parameters)
    np.testing.assert_array_equal(memory, expected)
    assert within.snapshot() == apart.snapshot()


def test_balls_can_be_columns_of_the_output() -> None:
    apart, within = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    rows = starts()
    expected = np.empty_like(rows)
    apart.reposition_balls(EVERY, rows[:, : len(BALL_COLUMNS)].copy(), expected)
    within.reposition_balls(EVERY, rows[:, : len(BALL_COLUMNS)], rows)
    np.testing.assert_array_equal(rows, expected)
    single, row = Simulator(CONFIG), starts()[:1]
    single.reposition_balls(EVERY[:1], row[:, : len(BALL_COLUMNS)], row)
    np.testing.assert_array_equal(row, expected[:1])


@pytest.mark.parametrize("method", ["place", "restart"])
def test_a_refused_row_leaves_the_array_as_it_is(method: str) -> None:
    simulator, rows = Simulator(CONFIG, WORLDS), starts()
    rows[2, 0] = 9.0
    before, kept = rows.copy(), simulator.snapshot()
    with pytest.raises(ValueError, match="world 2: ball is outside the field"):
        getattr(simulator, method)(EVERY, rows, rows)
    np.testing.assert_array_equal(rows, before)
    assert simulator.snapshot() == kept


def test_a_restart_keeps_parameters() -> None:
    parameters = np.full((WORLDS, CONFIG.parameters_size), 0.8, np.float32)
    restarted, new = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    rows, out = starts(), np.empty_like(starts())
    restarted.place(EVERY, rows, out, parameters)
    shape = (WORLDS, CONFIG.n_robots, len(CONFIG.command_columns))
    for _ in range(20):
        restarted.step(np.full(shape, 30.0, np.float32), out)
    restarted.restart(EVERY, rows, out)
    np.testing.assert_array_equal(out, rows)
    new.place(EVERY, rows, out, parameters)
    assert restarted.snapshot() == new.snapshot()


def test_estimates_go_to_the_nearest_valid_state() -> None:
    simulator, strict = Simulator(CONFIG, WORLDS), Simulator(CONFIG, WORLDS)
    rows = starts()
    expected = np.empty_like(rows)
    strict.restart(EVERY, rows, expected)
    moved = simulator.place_estimates(EVERY, rows, rows)
    assert moved.shape == (WORLDS, 1 + CONFIG.n_robots)
    assert moved.dtype == np.float32
    assert not moved.any()
    np.testing.assert_array_equal(rows, expected)
    assert simulator.snapshot() == strict.snapshot()
    noise = np.random.default_rng(0).normal(0.0, 0.2, (2, CONFIG.row_size)).astype(np.float32)
    estimates = rows[1:] + noise
    estimates[:, ABSENT] = 0.0
    found = rows.copy()
    moved = simulator.place_estimates(np.array([False, True, True]), estimates, found)
    np.testing.assert_array_equal(found[0], rows[0])
    assert moved.max() > 0.0
    strict.restart(EVERY, found, expected)
    np.testing.assert_array_equal(found[:, :2], expected[:, :2])


def test_estimates_that_are_not_finite_are_refused() -> None:
    simulator, rows = Simulator(CONFIG, WORLDS), starts()
    rows[1, len(BALL_COLUMNS)] = np.nan
    before, kept = rows.copy(), simulator.snapshot()
    with pytest.raises(ValueError, match="world 1: x of blue_0 must be finite, got NaN"):
        simulator.place_estimates(EVERY, rows, rows)
    np.testing.assert_array_equal(rows, before)
    assert simulator.snapshot() == kept
    with pytest.raises(ValueError, match=r"rows must have shape \(3, "):
        simulator.place_estimates(EVERY, rows[:2], rows)
