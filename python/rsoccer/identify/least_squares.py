"""Least squares of residuals in blocks, with intervals by a bootstrap over the blocks.

Written here and not taken from SciPy, which the package does without: the bootstrap needs the
blocks of the Jacobian matrix anyway, and the loop around them is short.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np

from numpy.typing import NDArray

from rsoccer.arrays import Doubles, Mask

Residuals = Callable[[Doubles], Doubles]
"""Residuals (blocks, m), in standard deviations, of parameters (p,); 0 for none."""
DRAWS: Final = 2000
"""Number of draws of a bootstrap."""
_OUTLIER: Final = 3.0  # standard deviations beyond which residuals count by their magnitude
_ROUNDS: Final = 30  # steps at most
_ENOUGH: Final = 1e-4  # relative change of the loss that ends the steps
_FREE: Final = 1e-6  # damping that does not shorten steps
_FAR: Final = 100.0  # steps of slopes that a parameter changes by at once
_ALL: Final = 500.0  # steps that it changes by in all
_PART: Final = 0.95  # of an interval


@dataclass(frozen=True)
class Solution:
    """Parameters with the least loss, and the loss around them."""

    parameters: Doubles
    """(p,) parameters; those that were fixed have their starts."""
    curvatures: Doubles
    """(blocks, p, p) JᵀJ of each block; 0 for fixed parameters."""
    slopes: Doubles
    """(blocks, p) Jᵀr of each block."""
    scale: float
    """Standard deviation of the residuals, in units of the expected one."""

    def errors(self, free: Mask) -> Doubles:
        """Return standard errors by the residuals' own scatter; infinite without any effect.

        Args:
            free: (p,) parameters that are estimated together.
        """
        found = np.full(len(free), np.inf)
        total = self.curvatures.sum(axis=0)
        free = free & (np.diag(total) > 1e-12)
        if free.any():
            part = total[np.ix_(free, free)]
            size = np.sqrt(np.diag(part))
            # Scaled, so that nothing depends on units.
            inverse = np.linalg.pinv(part / np.outer(size, size), rcond=1e-10)
            found[free] = self.scale * np.sqrt(np.maximum(np.diag(inverse), 0.0)) / size
        return found

    def draws(self, free: Mask, rng: np.random.Generator) -> Doubles:
        """Return parameters of random weights of the blocks, each by one Gauss-Newton step.

        Args:
            free: (p,) parameters that are estimated; the others stay.
            rng: random numbers.

        Returns:
            (`DRAWS`, p) parameters.
        """
        blocks = len(self.slopes)
        # Weights of the Bayesian bootstrap leave no block out, so no limit loses its only window.
        weights = rng.exponential(size=(DRAWS, blocks))
        index = np.flatnonzero(free)
        curvatures = np.tensordot(weights, self.curvatures[:, index][:, :, index], 1)
        slopes = weights @ (self.slopes - self.slopes.mean(axis=0))[:, index]
        size = np.sqrt(np.diag(self.curvatures[:, index][:, :, index].sum(axis=0))) + 1e-300
        scaled = curvatures / np.outer(size, size) + 1e-12 * np.eye(len(index))
        change = np.linalg.solve(scaled, (slopes / size)[..., None])[..., 0] / size
        drawn = np.tile(self.parameters, (DRAWS, 1))
        # Residuals of parameters that were fitted scatter less than their errors do.
        wider = np.sqrt(blocks / max(blocks - 1.0, 1.0))
        drawn[:, index] -= wider * change
        return drawn


def interval(draws: Doubles) -> tuple[Doubles, Doubles]:
    """Return the ends of the central 95% of draws.

    Args:
        draws: (n, ...) draws.
    """
    low, high = np.quantile(draws, [(1 - _PART) / 2, (1 + _PART) / 2], axis=0)
    return low, high


def solve(residuals: Residuals, start: Doubles, steps: Doubles, free: Mask) -> Solution:
    """Return the parameters with the least robust loss, by damped Gauss-Newton steps.

    Args:
        residuals: residuals of parameters.
        start: (p,) parameters to start from.
        steps: (p,) changes of parameters over which slopes are measured.
        free: (p,) parameters that may change.
    """
    parameters, damping = start.copy(), 1e-4
    now = residuals(parameters)
    scale = _scale(now)
    index = np.flatnonzero(free)
    first, width = start[index], steps[index]
    for _ in range(_ROUNDS):
        jacobian = _jacobian(residuals, parameters, now, steps, index, both_sides=False)
        before = _loss(now, scale)
        weights = _weights(now, scale)[..., None]
        curvature = np.einsum("bmi,bmj->ij", jacobian * weights, jacobian)
        slope = np.einsum("bmi,bm->i", jacobian * weights, now)
        while damping < 1e8:
            damped = curvature + damping * np.diag(np.diag(curvature) + 1e-9)
            trial = parameters.copy()
            change = np.clip(np.linalg.solve(damped, slope), -_FAR * width, _FAR * width)
            trial[index] = np.clip(trial[index] - change, first - _ALL * width, first + _ALL * width)
            there = residuals(trial)
            if np.isfinite(there).all() and _loss(there, scale) < before:
                break
            damping *= 8.0
        else:
            break
        parameters, now = trial, there
        # A damped step may be short where two numbers explain the same.
        if damping <= _FREE and before - _loss(now, scale) < _ENOUGH * before:
            break
        damping = max(damping / 30.0, _FREE / 10.0)
        scale = _scale(now)
    jacobian = _jacobian(residuals, parameters, now, steps, index)
    weights = _weights(now, scale)[..., None]
    curvatures = np.zeros((len(now), len(start), len(start)))
    curvatures[np.ix_(range(len(now)), index, index)] = np.einsum(
        "bmi,bmj->bij", jacobian * weights, jacobian
    )
    slopes = np.zeros((len(now), len(start)))
    slopes[:, index] = np.einsum("bmi,bm->bi", jacobian * weights, now)
    return Solution(parameters, curvatures, slopes, scale)


def _jacobian(
    residuals: Residuals,
    parameters: Doubles,
    now: Doubles,
    steps: Doubles,
    index: NDArray[np.intp],
    both_sides: bool = True,
) -> Doubles:
    """(blocks, m, len(index)) slopes of the residuals."""
    jacobian = np.empty((*now.shape, len(index)))

    def moved(parameter: int, step: float) -> Doubles:
        there = parameters.copy()
        there[parameter] += step
        return residuals(there)

    for number, parameter in enumerate(index.tolist()):
        step = float(steps[parameter])
        before, width = (moved(parameter, -step), 2.0 * step) if both_sides else (now, step)
        jacobian[..., number] = (moved(parameter, step) - before) / width
    return jacobian


def _scale(residuals: Doubles) -> float:
    """Standard deviation of most residuals, at least half of the expected one."""
    real = residuals[residuals != 0.0]
    return max(1.4826 * float(np.median(np.abs(real))) if len(real) else 1.0, 0.5)


def _weights(residuals: Doubles, scale: float) -> Doubles:
    weights: Doubles = 1.0 / np.maximum(1.0, np.abs(residuals) / (_OUTLIER * scale))
    return weights


def _loss(residuals: Doubles, scale: float) -> float:
    """Huber's loss."""
    size = np.abs(residuals) / scale
    return float(np.where(size < _OUTLIER, size**2 / 2, _OUTLIER * (size - _OUTLIER / 2)).sum())
