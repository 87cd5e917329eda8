"""Latency, gains and limits of robots, fitted by simulation of the commands of a log."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

from rsoccer._core import RobotModel
from rsoccer.arrays import Doubles, Mask
from rsoccer.identify.alignment import Noise, misfits, noise_of
from rsoccer.identify.drives import LATENCY, Drive, drive_of
from rsoccer.identify.least_squares import Residuals, Solution, solve
from rsoccer.identify.log import Log
from rsoccer.identify.results import Estimate
from rsoccer.identify.simulation import TICK, Paths, simulate
from rsoccer.identify.windows import LENGTH, MAX_LATENCY, Windows, cut

_LATENCIES: Final = np.arange(0.0, MAX_LATENCY, 0.01)  # s, tried before the fit
_FACTORS: Final = (0.4, 0.6, 0.8, 1.0, 1.3, 1.8)  # on accelerations, tried before the fit
_TYPICAL_LATENCY: Final = 0.08  # s
_HEAVY: Final = 1.0  # kg: robots that the ball does not push
_ALONG: Final = 0.8  # least part of the commanded speed along an axis, in windows of that axis
_REACH: Final = 0.08  # s beyond a latency, within which it is fitted
_BEYOND: Final = 1.05  # of a top speed, which commands exceed where it shows
_WORSE: Final = 1.05  # of the misfit, by which a top speed that hardly shows is missed
_BEYOND_TIME: Final = 0.2  # s
_ODD: Final = 4.0  # standard deviations of windows' misfits, beyond which one is left out
_LEAST_ODD: Final = 1.2  # of the usual misfit, up to which none is
_PASSES: Final = 3  # in which windows are left out


class DriveFit:
    """Parameters of a drive that explain windows of a log best."""

    def __init__(self, log: Log, base: RobotModel) -> None:
        """Cut a log into windows, and measure its noise.

        Args:
            log: the log.
            base: model of the robots.

        Raises:
            ValueError: no usable windows.
        """
        self.drive: Drive = drive_of(base)
        self.log = log
        self.heavy = base.mass >= _HEAVY
        self.noise: Noise = noise_of(log)
        self.windows: Windows = cut(log, _TYPICAL_LATENCY, self.heavy)
        self.steps = np.array([each.step for each in self.drive.parameters])
        self.free = np.ones(len(self.steps), np.bool_)

    def run(self) -> None:
        """Fit all parameters, and find those that the log identifies."""
        values = self._searched(self.drive.start(self._observed()))
        self._cut(values[LATENCY])
        self.solution = self._solved(self.windows, self.drive.encoded(values))
        # Velocities at the starts of windows depend on the latency.
        self._cut(float(self.solution.parameters[0]))
        self.solution = self._solved(self.windows, self.solution.parameters)
        self._leave_out()
        tops = np.array([name in self.drive.tops() for name in self.drive.names])
        limited = self.solution
        self._fix(tops & ~self._exceeded())
        if self.solution.scale > _WORSE * limited.scale:
            # One wheel of two that are unequal may reach its top speed by a little.
            self.solution, self.free = limited, self.free | tops
        gains = np.array([name.startswith(("gain", "wheel_r")) for name in self.drive.names])
        if not self._identified(self.solution)[gains].all():
            # A gain explains a robot that is slow at one level of speed alone, too.
            self._fix(tops & self.free)
        self.free = self._identified(self.solution)

    @property
    def seconds(self) -> float:
        """Length of all windows, s."""
        return len(self.windows) * LENGTH

    def estimates(self, rng: np.random.Generator) -> list[Estimate]:
        """Return all parameters that are reported, identified or not.

        Args:
            rng: random numbers of the intervals.
        """
        low, high = self.solution.intervals(self.free, rng)
        found = []
        for number, each in enumerate(self.drive.parameters):
            if not self.free[number] and each.is_shown:
                found.append(Estimate.missing(each.name, each.unit, each.excited_by))
            elif each.is_shown:
                ends = np.array([low[number], self.solution.parameters[number], high[number]])
                numbers = np.exp(ends) if each.is_limit else ends
                found.append(Estimate(each.name, each.unit, *numbers.tolist()))
        return found

    def by_axis(self, rng: np.random.Generator) -> list[Estimate]:
        """Return accelerations forward and sideways apart, of windows in which robots drive so.

        Args:
            rng: random numbers of the intervals.
        """
        if self.drive.names[1] != "gain_forward":
            return []
        limits = ("max_acceleration", "max_deceleration")
        chosen = np.array([name in limits for name in self.drive.names])
        speeds = np.abs(self.windows.commands).max(axis=0)
        total = np.hypot(speeds[:, 0], speeds[:, 1]) + 1e-9
        found = []
        for axis, title in enumerate(("forward", "sideways")):
            part = (speeds[:, axis] > _ALONG * total) & (total > 0.1)
            names = [f"{name.removeprefix('max_')}_{title}" for name in limits]
            if part.sum() < 3 or not self.free[chosen].any():
                found += [Estimate.missing(name, "m/s²", f"steps {title}") for name in names]
                continue
            windows = self.windows.take(part)
            residuals = self._residuals(windows)
            solution = solve(residuals, self.solution.parameters, self.steps, chosen)
            free = self._identified(solution) & chosen
            ends = np.exp([*solution.intervals(free, rng), solution.parameters])
            for name, index in zip(names, np.flatnonzero(chosen), strict=True):
                if not free[index]:
                    found.append(Estimate.missing(name, "m/s²", f"steps {title}"))
                    continue
                low, high, value = ends[:, index].tolist()
                found.append(Estimate(name, "m/s²", low, value, high))
        return found

    def values(self) -> dict[str, float]:
        """Return the identified parameters by name."""
        values = self.drive.values(self.solution.parameters)
        names = zip(self.drive.names, self.free, strict=True)
        return {name: values[name] for name, identified in names if identified}

    def _cut(self, latency: float) -> None:
        """Cut the log anew into windows for a latency."""
        reach = min(max(latency, 0.0) + _REACH, MAX_LATENCY)
        self.windows = cut(self.log, latency, self.heavy, reach)

    def _leave_out(self) -> None:
        """Fit without windows that scatter far more than others.

        A lost command delays a step by a frame. Its residuals count less as outliers, but all are
        on one side, so a few still shift the latency.
        """
        for _ in range(_PASSES):
            misfit = self._residuals(self.windows)(self.solution.parameters)
            counted = np.maximum((misfit != 0.0).sum(axis=1), 1)
            sizes = np.sqrt((misfit**2).sum(axis=1) / counted)
            usual = float(np.median(sizes))
            spread = 1.4826 * float(np.median(np.abs(sizes - usual)))
            kept = sizes <= max(usual + _ODD * spread, _LEAST_ODD * usual)
            if kept.all():
                break
            self.windows = self.windows.take(kept)
            self.solution = self._solved(self.windows, self.solution.parameters)

    def _observed(self) -> dict[str, float]:
        """Greatest speeds that last for some frames."""
        speeds, turns = [], []
        for robot in self.log.commands:
            if robot not in self.log.poses:
                continue
            track = self.log.poses[robot]
            seconds = track.times[6:] - track.times[:-6]
            near = (seconds > 0.0) & (seconds < 0.3)
            moved = np.linalg.norm(track.positions[6:] - track.positions[:-6], axis=1)
            turned = np.unwrap(track.headings)[6:] - np.unwrap(track.headings)[:-6]
            speeds += (moved[near] / seconds[near]).tolist()
            turns += (np.abs(turned[near]) / seconds[near]).tolist()
        return {
            "speed": float(np.quantile(speeds, 0.995)),
            "angular_velocity": float(np.quantile(turns, 0.995)),
        }

    def _searched(self, start: Mapping[str, float]) -> dict[str, float]:
        """Parameters of a coarse search over latency and accelerations."""
        best, least = dict(start), np.inf
        for factor in _FACTORS:
            values = dict(start)
            for name in self.drive.accelerations():
                values[name] *= factor
            paths = self._paths(self.windows, values)
            for latency in _LATENCIES:
                misfit = misfits(paths, self.windows, latency / TICK, self.noise)
                loss = float(np.minimum(np.abs(misfit), 50.0).sum())
                if loss < least:
                    best, least = values | {LATENCY: float(latency)}, loss
        return best

    def _exceeded(self) -> Mask:
        """All parameters but top speeds that commands hardly exceed."""
        values = self.drive.values(self.solution.parameters)
        found = np.ones(len(self.free), np.bool_)
        demanded = self.drive.demanded(values, self.windows.commands)
        for name, speeds in zip(self.drive.tops(), demanded, strict=True):
            beyond = speeds > _BEYOND * values[name]
            found[self.drive.names.index(name)] = beyond.sum() * TICK > _BEYOND_TIME
        return found

    def _fix(self, tops: Mask) -> None:
        """Fit without some top speeds."""
        if tops.any():
            self.free &= ~tops
            start = self.solution.parameters + np.log(10.0) * tops
            self.solution = self._solved(self.windows, start)

    def _paths(self, windows: Windows, values: Mapping[str, float]) -> Paths:
        """Simulated paths of parameters."""
        commands = self.drive.obeyed(values, windows.commands)
        return simulate(self.drive.model(values), commands, windows.velocities)

    def _residuals(self, windows: Windows) -> Residuals:
        """Residuals of parameters; those that differ in latency alone share a simulation."""
        last: dict[bytes, Paths] = {}

        def residuals(parameters: Doubles) -> Doubles:
            key = parameters[1:].tobytes()
            if key not in last:
                last.clear()
                last[key] = self._paths(windows, self.drive.values(parameters))
            latency = float(np.clip(parameters[0], -MAX_LATENCY, MAX_LATENCY))
            return misfits(last[key], windows, latency / TICK, self.noise)

        return residuals

    def _solved(self, windows: Windows, start: Doubles) -> Solution:
        return solve(self._residuals(windows), start, self.steps, self.free)

    def _identified(self, solution: Solution) -> Mask:
        tolerances = np.array([each.tolerance for each in self.drive.parameters])
        return solution.identified(self.free, tolerances)
