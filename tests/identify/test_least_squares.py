"""Least squares in blocks: solutions, and how often intervals hold the truth."""

import numpy as np
import pytest

from rsoccer.arrays import Doubles
from rsoccer.identify.least_squares import Residuals, solve, student

TRUTH = np.array([1.5, -0.7])
STEPS = np.array([0.01, 0.01])
BOTH = np.ones(2, np.bool_)


def line(rng: np.random.Generator, blocks: int, scatter: float = 0.0) -> Residuals:
    """Residuals of a curve with noise of 1, and blocks that lie beside it by a scatter."""
    places = rng.uniform(-1.0, 1.0, (blocks, 20))
    noise = rng.normal(size=places.shape) + scatter * rng.normal(size=(blocks, 1))
    seen = 10.0 * np.exp(TRUTH[0] * places) + 10.0 * TRUTH[1] * places + noise

    def residuals(parameters: Doubles) -> Doubles:
        first, second = parameters.tolist()
        misfit: Doubles = seen - 10.0 * np.exp(first * places) - 10.0 * second * places
        return misfit

    return residuals


def test_solutions_are_near_the_truth_also_with_outliers() -> None:
    exact = line(np.random.default_rng(0), 10)
    found = solve(exact, np.zeros(2), STEPS, BOTH)
    assert found.parameters == pytest.approx(TRUTH, abs=0.1)
    assert found.scale == pytest.approx(1.0, abs=0.2)

    def spoiled(parameters: Doubles) -> Doubles:
        residuals = exact(parameters)
        residuals[:, 0] += 300.0
        return residuals

    robust = solve(spoiled, np.zeros(2), STEPS, BOTH)
    assert robust.parameters == pytest.approx(TRUTH, abs=0.2)


def test_fixed_parameters_stay() -> None:
    found = solve(line(np.random.default_rng(0), 10), np.array([1.4, -0.7]), STEPS, ~BOTH)
    assert found.parameters.tolist() == [1.4, -0.7]
    only = np.array([True, False])
    found = solve(line(np.random.default_rng(0), 10), np.array([1.0, -0.7]), STEPS, only)
    assert found.parameters[1] == -0.7
    low, high = found.intervals(only, np.random.default_rng(0))
    assert low[1] == high[1] == -0.7
    assert low[0] < found.parameters[0] < high[0]
    assert np.isinf(found.errors(only)[1])


@pytest.mark.parametrize(("blocks", "scatter"), [(30, 0.0), (30, 1.0), (4, 0.0)])
def test_intervals_hold_the_truth_about_as_often_as_they_say(blocks: int, scatter: float) -> None:
    held = np.zeros(2)
    runs = 200
    for seed in range(runs):
        rng = np.random.default_rng(seed)
        found = solve(line(rng, blocks, scatter), TRUTH + 0.1, STEPS, BOTH)
        low, high = found.intervals(BOTH, rng)
        held += (low <= TRUTH) & (high >= TRUTH)
    assert (held / runs >= 0.9).all(), held
    assert (held / runs <= 0.995).all() or blocks < 10, held


def test_intervals_hold_the_truth_with_few_blocks_for_many_parameters() -> None:
    """A fit follows the errors of each block, so what is left of them is too small."""
    blocks, size, runs = 20, 14, 100
    held = 0.0
    free = np.ones(size, np.bool_)
    for seed in range(runs):
        rng = np.random.default_rng(seed)
        slopes = 0.3 * rng.normal(size=(blocks, 20, size)) + rng.normal(size=(blocks, 1, size))
        seen = rng.normal(size=(blocks, 20)) + 2.0 * rng.normal(size=(blocks, 1))

        def residuals(
            parameters: Doubles, slopes: Doubles = slopes, seen: Doubles = seen
        ) -> Doubles:
            misfit: Doubles = seen - slopes @ parameters
            return misfit

        found = solve(residuals, np.zeros(size), np.full(size, 0.01), free)
        low, high = found.intervals(free, rng)
        held += float(((low <= 0.0) & (high >= 0.0)).mean())
    assert held / runs >= 0.88


def test_student() -> None:
    assert student(np.inf) == pytest.approx(1.96)
    assert student(1) == pytest.approx(12.706)
    assert student(7) == pytest.approx(2.365, abs=0.01)
    assert student(20) == pytest.approx(2.086, abs=0.01)
