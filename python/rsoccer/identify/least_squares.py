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
_LEFT: Final = 0.05  # least part of a number that other blocks tell, as intervals count it
_FEWEST: Final = 2.0  # degrees of freedom of a number that one block tells alone
_FREEDOM: Final = np.array([1, 2, 3, 4, 5, 6, 8, 10, 15, 30, np.inf])
_QUANTILES: Final = np.array(
    [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.306, 2.228, 2.131, 2.042, 1.960]
)


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

    def identified(self, free: Mask, tolerances: Doubles) -> Mask:
        """Return the parameters with small standard errors, without the worst one after the other.

        Args:
            free: (p,) parameters that were estimated.
            tolerances: (p,) greatest standard errors with which they count as identified.
        """
        free = free.copy()
        while free.any():
            errors = np.where(free, self.errors(free) / tolerances, 0.0)
            worst = int(errors.argmax())
            if errors[worst] <= 1.0:
                break
            free[worst] = False
        return free

    def intervals(self, free: Mask, rng: np.random.Generator) -> tuple[Doubles, Doubles]:
        """Return the ends of intervals of 95%: a bootstrap over the blocks, widened where few tell.

        They are at least as wide as the scatter of the residuals alone makes them.

        Args:
            free: (p,) parameters that are estimated; the others have no width.
            rng: random numbers.

        Returns:
            (p,) low and high ends.
        """
        moved = self._draws(free, rng)
        low, high = np.quantile(moved, [(1.0 - _PART) / 2.0, (1.0 + _PART) / 2.0], axis=0)
        size = np.diagonal(self.curvatures, axis1=1, axis2=2)
        telling = size.sum(axis=0) ** 2 / np.maximum((size**2).sum(axis=0), 1e-300)
        wider = student(np.maximum(telling - 1.0, _FEWEST)) / student(np.inf)
        least = np.where(free, student(np.inf) * self.errors(free), 0.0)
        low = self.parameters + np.minimum(low * wider, -least)
        return low, self.parameters + np.maximum(high * wider, least)

    def _draws(self, free: Mask, rng: np.random.Generator) -> Doubles:
        """(`DRAWS`, p) changes by random weights of the blocks, each by one Gauss-Newton step."""
        blocks = len(self.slopes)
        # Weights of the Bayesian bootstrap leave no block out, so no limit loses its only window.
        weights = rng.exponential(size=(DRAWS, blocks))
        index = np.flatnonzero(free)
        own = self.curvatures[:, index][:, :, index]
        size = np.sqrt(np.diag(own.sum(axis=0))) + 1e-300
        own = own / size[:, None] / size
        steep = _unfitted(own, (self.slopes - self.slopes.mean(axis=0))[:, index] / size)
        scaled = np.tensordot(weights, own, 1) + 1e-12 * np.eye(len(index))
        moved = np.zeros((DRAWS, len(free)))
        moved[:, index] = -np.linalg.solve(scaled, (weights @ steep)[..., None])[..., 0] / size
        return moved


def _unfitted(curvatures: Doubles, slopes: Doubles) -> Doubles:
    """Slopes of blocks as they scatter around the true parameters, not around fitted ones.

    A fit follows the errors of each block by the block's share of all curvature. Errors are larger
    than what is left of them by the square root of the other blocks' share (CR2 of Bell and
    McCaffrey 2002).
    """
    sizes, axes = np.linalg.eigh(curvatures.sum(axis=0))
    root = axes * np.sqrt(np.maximum(sizes, 1e-12 * sizes[-1:]))
    inverse = np.linalg.pinv(root)
    shares, turned = np.linalg.eigh(inverse @ curvatures @ inverse.T)
    left = 1.0 / np.sqrt(np.maximum(1.0 - shares, _LEFT))
    along = np.einsum("bij,bi->bj", turned, slopes @ inverse.T)
    scattered: Doubles = np.einsum("bij,bj->bi", turned, along * left) @ root.T
    return scattered


def student(freedom: Doubles | float) -> Doubles:
    """Return Student's t at 97.5%.

    Args:
        freedom: degrees of freedom, 1 or more.
    """
    # Nearly linear in the inverse of the degrees of freedom, between those of tables.
    inverse = 1.0 / np.asarray(freedom, np.float64)
    quantiles: Doubles = np.interp(inverse, 1.0 / _FREEDOM[::-1], _QUANTILES[::-1])
    return quantiles


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
        before = huber_loss(now, scale)
        weights = huber_weights(now, scale)[..., None]
        curvature = np.einsum("bmi,bmj->ij", jacobian * weights, jacobian)
        slope = np.einsum("bmi,bm->i", jacobian * weights, now)
        while damping < 1e8:
            damped = curvature + damping * np.diag(np.diag(curvature) + 1e-9)
            trial = parameters.copy()
            change = np.clip(np.linalg.solve(damped, slope), -_FAR * width, _FAR * width)
            trial[index] = np.clip(
                trial[index] - change, first - _ALL * width, first + _ALL * width
            )
            there = residuals(trial)
            if np.isfinite(there).all() and huber_loss(there, scale) < before:
                break
            damping *= 8.0
        else:
            break
        parameters, now = trial, there
        # A damped step may be short where two numbers explain the same.
        if damping <= _FREE and before - huber_loss(now, scale) < _ENOUGH * before:
            break
        damping = max(damping / 30.0, _FREE / 10.0)
        scale = _scale(now)
    jacobian = _jacobian(residuals, parameters, now, steps, index)
    weights = huber_weights(now, scale)[..., None]
    curvatures = np.zeros((len(now), len(start), len(start)))
    curvatures[np.ix_(np.arange(len(now)), index, index)] = np.einsum(
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


def huber_weights(residuals: Doubles, scale: float = 1.0) -> Doubles:
    """Return the weights of residuals by which weighted squares have the slopes of Huber's loss.

    Args:
        residuals: residuals.
        scale: their standard deviation.
    """
    weights: Doubles = 1.0 / np.maximum(1.0, np.abs(residuals) / (_OUTLIER * scale))
    return weights


def huber_loss(residuals: Doubles, scale: float = 1.0) -> float:
    """Return Huber's loss: half of the square, and linear beyond three standard deviations.

    Args:
        residuals: residuals.
        scale: their standard deviation.
    """
    size = np.abs(residuals) / scale
    return float(np.where(size < _OUTLIER, size**2 / 2, _OUTLIER * (size - _OUTLIER / 2)).sum())
