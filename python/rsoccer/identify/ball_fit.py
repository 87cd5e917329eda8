"""Sliding and rolling of the ball, fitted to its runs, and the speeds of kicks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer._core import BallModel
from rsoccer.arrays import Doubles, Mask
from rsoccer.identify.ball_runs import Run
from rsoccer.identify.least_squares import Solution, huber_loss, huber_weights, solve
from rsoccer.identify.results import Estimate
from rsoccer.identify.rolling import slid_and_rolled

_LEAST_NOISE: Final = 0.0003  # m: noise that residuals count with at least
_SHARES: Final = (1.1, 0.9, 0.8, 0.7, 0.6)  # first rolling speed by the first speed, tried
_INNER: Final = 8  # Gauss-Newton steps of the numbers of each run
_CLEAR: Final = 3.0  # standard errors by which a drag stands out from 0
_STEPS: Final = np.array([1e-4, 1e-3, 1e-3])  # m, m/s, m/s: slopes of these numbers


@dataclass(frozen=True)
class _Shared:
    """A number of the floor that all runs share."""

    name: str
    unit: str
    step: float
    tolerance: float
    is_limit: bool
    excited_by: str


_SHARED: Final = (
    _Shared("sliding_deceleration", "m/s²", 0.01, 0.15, True, "kicks, in full view"),
    _Shared("slide_to_roll_ratio", "1", 0.003, 0.04, False, "kicks from rest, in full view"),
    _Shared(
        "rolling_deceleration", "m/s²", 0.01, 0.12, True, "balls that roll for a meter or more"
    ),
    _Shared("rolling_drag", "1/s", 0.002, 0.02, False, "balls that roll fast and slowly"),
)
_TOLERANCES: Final = np.array([each.tolerance for each in _SHARED])
_SLIDING: Final = 0
_ROLLING: Final = 2
_DRAG: Final = 3


class BallFit:
    """Laws of the floor that explain runs of the ball best."""

    def __init__(self, runs: list[Run], noise: float, base: BallModel) -> None:
        """Prepare a fit.

        Args:
            runs: runs of the ball; none identify nothing.
            noise: noise of its positions in each direction, m.
            base: numbers that stand in where nothing is identified.
        """
        self.runs, self.base = runs, base
        self.noise = max(noise, _LEAST_NOISE)
        # Of each run: distance (m) and speed (m/s) at its first pose, and its first rolling speed.
        self.own = np.zeros((len(runs), 3))
        self.free = np.zeros(len(_SHARED), np.bool_)
        # Whether balls that were not kicked from rest may slide at first.
        self.slides = True
        most = max((len(run.times) for run in runs), default=0)
        self.seen = np.array([np.arange(most) < len(run.times) for run in runs]).reshape(
            len(runs), most
        )

    def run(self) -> None:
        """Fit all numbers, and find those that the runs identify."""
        base = [float(getattr(self.base, each.name)) for each in _SHARED]
        start = self._encoded([max(base[0], 0.5), base[1], self._slowed(base[2]), base[3]])
        self.start = start
        if not self.runs:
            return
        self._begin(start)
        free = np.array([True, True, True, False])
        self.solution = self._solved(start, free)
        if not self.solution.identified(free, _TOLERANCES)[_SLIDING]:
            # Sliding as slow as rolling would explain the same.
            free[: _SLIDING + 2] = False
            self.slides = False
            self._begin(start)
            self.solution = self._solved(start, free)
        dragged = free.copy()
        dragged[_DRAG] = True
        with_drag = self._solved(self.solution.parameters, dragged)
        identified = with_drag.identified(dragged, _TOLERANCES)
        drag, error = with_drag.parameters[_DRAG], with_drag.errors(identified)[_DRAG]
        # Without a drag that stands out, one deceleration describes the floor better.
        if identified[_ROLLING] and identified[_DRAG] and drag > _CLEAR * error:
            self.solution, self.free = with_drag, identified
            return
        self._begin(self.solution.parameters)
        self.solution = self._solved(self.solution.parameters, free)
        self.free = self.solution.identified(free, _TOLERANCES)

    def estimates(self, rng: np.random.Generator) -> list[Estimate]:
        """Return the numbers of the floor, identified or not.

        Args:
            rng: random numbers of the intervals.
        """
        found = []
        ends = self.solution.intervals(self.free, rng) if self.free.any() else None
        for index, each in enumerate(_SHARED):
            if ends is None or not self.free[index]:
                found.append(Estimate.missing(each.name, each.unit, each.excited_by))
                continue
            numbers = np.array([ends[0][index], self.solution.parameters[index], ends[1][index]])
            numbers = np.exp(numbers) if each.is_limit else numbers
            found.append(Estimate(each.name, each.unit, *numbers.tolist()))
        return found

    def kick(self, index: int) -> tuple[float, float] | None:
        """Return speed (m/s) and time (s, of the log) of the kick that began a run.

        Args:
            index: index of the run.

        Returns:
            None for a run of a ball that did not lie before, or on an unknown floor.
        """
        run, (distance, speed, _) = self.runs[index], self.own[index]
        if not np.isfinite(run.rest) or not self.free[_SLIDING]:
            return None
        sliding = self._decoded(self.solution.parameters)[0]
        kicked = float(_kick_speed(sliding, distance, speed, run.rest))
        return kicked, run.began - (kicked - float(speed)) / float(sliding)

    def _slowed(self, base: float) -> float:
        """Typical deceleration in the later halves of runs, m/s²; the base's without runs.

        A start that leaves misfits of many standard deviations would let the fit end far away,
        since the numbers of each run then count most of its poses as outliers.
        """
        found = []
        for run in self.runs:
            late = run.times >= 0.5 * run.times[-1]
            found.append(-2.0 * float(np.polyfit(run.times[late], run.distances[late], 2)[0]))
        return max(float(np.median(found)) if found else base, 0.05)

    def _solved(self, start: Doubles, free: Mask) -> Solution:
        steps = np.array([each.step for each in _SHARED])
        return solve(self._residuals, start, steps, free)

    @staticmethod
    def _encoded(values: list[float]) -> Doubles:
        pairs = zip(_SHARED, values, strict=True)
        return np.array([np.log(value) if each.is_limit else value for each, value in pairs])

    @staticmethod
    def _decoded(parameters: Doubles) -> Doubles:
        limits = np.array([each.is_limit for each in _SHARED])
        return np.where(limits, np.exp(np.where(limits, parameters, 0.0)), parameters)

    def _begin(self, parameters: Doubles) -> None:
        """Numbers of each run to start from: the best of some shares of sliding."""
        floor = self._decoded(parameters)
        for index, run in enumerate(self.runs):
            few = min(12, len(run.times))
            slope = float(np.polyfit(run.times[:few], run.distances[:few], 1)[0])
            speed = slope + 0.5 * float(run.times[few - 1])  # at 1 m/s²
            tries = [np.array([0.0, speed, share * speed]) for share in _SHARES]
            fitted = [self._fitted(floor, run, own) for own in tries]
            self.own[index] = min(fitted, key=lambda own: self._loss(floor, run, own))

    def _residuals(self, parameters: Doubles) -> Doubles:
        """(runs, n) residuals of the best numbers of each run, in standard deviations."""
        floor = self._decoded(parameters)
        found = np.zeros(self.seen.shape)
        for index, run in enumerate(self.runs):
            self.own[index] = self._fitted(floor, run, self.own[index])
            found[index, : len(run.times)] = self._misfit(floor, run, self.own[index])
        return found

    def _fitted(self, floor: Doubles, run: Run, own: Doubles) -> Doubles:
        """Numbers of a run by Gauss-Newton steps that count outliers less."""
        loss = self._loss(floor, run, own)
        for _ in range(_INNER):
            now = self._misfit(floor, run, own)
            slopes = np.column_stack(
                [
                    (self._misfit(floor, run, own + step) - now) / step.sum()
                    for step in np.diag(_STEPS)
                ]
            )
            weights = huber_weights(now)
            curvature = slopes.T @ (slopes * weights[:, None])
            curvature += np.diag(1e-9 * np.diag(curvature) + 1e-9)
            change = np.linalg.solve(curvature, slopes.T @ (now * weights))
            for _ in range(4):
                trial = own - change
                there = self._loss(floor, run, trial)
                if there <= loss:
                    break
                change *= 0.3
            if there > loss:
                break
            enough = loss - there < 1e-9 * loss
            own, loss = trial, there
            if enough:
                break
        return own

    def _misfit(self, floor: Doubles, run: Run, own: Doubles) -> Doubles:
        distance, speed, rolls = own.tolist()
        sliding, ratio, rolling, drag = floor.tolist()
        if np.isfinite(run.rest):
            rolls = ratio * float(_kick_speed(sliding, distance, speed, run.rest))
        elif not self.slides:
            rolls = np.inf
        law = np.array([sliding, rolling, drag])
        predicted = distance + slid_and_rolled(law, speed, rolls, run.times)
        misfit: Doubles = (run.distances - predicted) / self.noise
        return misfit

    def _loss(self, floor: Doubles, run: Run, own: Doubles) -> float:
        return huber_loss(self._misfit(floor, run, own))


def _kick_speed(sliding: float, distance: float, speed: float, rest: float) -> float:
    """Speed of a kick from a place that gave a speed at a distance, m/s."""
    return float(np.sqrt(max(speed * speed + 2.0 * sliding * (distance - rest), 1e-6)))
