"""Fit sliding and rolling of the ball to tracked kicks: the floors of two presets of balls.

Usage: `python -m tools.fit_kicks FOLDER`, with folders `robocup2023` and `lab` of CSV files inside
(https://github.com/jgocm/kick-analysis; they have no license, so they are no part of this
repository). A file has the rows of one kick: position (mm) and tracked speed (mm/s), xy each; a row
of zeros is a frame without a ball. Prints the fits, predicts each kick by the others, and writes
what the page needs into `tools/physics/kicks.json`.

The tracker smooths speeds for up to a second, but not positions. At RoboCup speeds therefore follow
from positions; the tracked speeds only give the time between two of them, once the ball rolls. In
the laboratory positions of two cameras disagree by centimeters, so rolling is fitted to tracked
speeds, of which the lag cancels between two places.
"""

import argparse
import json
import math
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from rsoccer.arrays import Array
from tools.physics.kicks import FIGURES, rolled, slid_then_rolled
from tools.physics.rolling import Rolling

VENUES = {"robocup2023": "ssl_robocup_2023", "lab": "ssl_lab_2023"}
TWO_CAMERAS = {"lab"}  # rows come at a constant rate, and not at detections
SLOWEST = 0.12  # m/s: below it dimples of the carpet decide
MARGIN = 1.0  # m between the end of sliding and the rolling that is fitted: slides differ in length
FASTEST = 3  # kicks of a venue that give the time between its frames
BEFORE_BOUNCE = 16  # frames in which the tracked speed foresees a bounce
BOUNCE = 0.8  # share of the speed ten frames before, below which the ball hit something
OUTLIER = 0.01  # m: larger residuals count by their magnitude, not its square
EARLY = 1.0  # m of rolling that a prediction starts from
AFTER_BOUNCE = 0.6  # m behind a bounce, from where a ball rolls
AFTER = 3.0  # m that a prediction reaches
NEAR = 0.3  # m around a place whose tracked speeds give the speed there
BETWEEN = 0.5  # m between places from which tracked speeds are predicted
STEP = 0.25  # m between the speeds that the page shows
SHOWN = 4  # least number of speeds of a run that it shows


@dataclass(frozen=True)
class Run:
    """A ball between two contacts: distance (m) by time (s)."""

    name: str
    times: Array
    distances: Array


@dataclass(frozen=True)
class Kick:
    """One file: the run after the kick, and that after a bounce if there is one."""

    name: str
    first: Run
    bounced: Run | None
    tracked: tuple[Array, Array]
    """Distances (m) and tracked speeds (m/s) after the peak of the speed and before a contact."""


def read(paths: list[Path], two_cameras: bool) -> list[Kick]:
    """Return the runs of the files of a venue."""
    all_frames = [_frames(path, two_cameras) for path in paths]
    # A tracked speed lags, which matters least for the fastest balls.
    fastest = sorted(all_frames, key=lambda frames: -frames.speeds.max())[:FASTEST]
    seconds = float(np.median([_frame_time(frames) for frames in fastest]))
    return [_kick(frames, seconds) for frames in all_frames]


@dataclass(frozen=True)
class Frames:
    """Frames of a file with a ball: their numbers, positions (m) and tracked speeds (m/s)."""

    name: str
    numbers: Array
    positions: Array
    speeds: Array
    peak: int
    """Index of the fastest."""
    bounce: int
    """Index of the first contact after the kick; their number if there is none."""


def _frames(path: Path, two_cameras: bool) -> Frames:
    rows = np.genfromtxt(path, delimiter=",", skip_header=1) / 1000
    seen = np.flatnonzero((rows != 0).any(axis=1))
    speeds = np.linalg.norm(rows[seen, 2:], axis=1)
    peak = int(speeds.argmax())
    numbers = seen if two_cameras else np.arange(len(seen))
    return Frames(path.stem, numbers, rows[seen, :2], speeds, peak, _bounce(speeds, peak))


def _kick(frames: Frames, seconds: float) -> Kick:
    """Return the runs of a file whose frames are some seconds apart."""
    positions, speeds = frames.positions, frames.speeds

    def run(first: int, end: int) -> Run:
        away = np.linalg.norm(positions[first:end] - positions[first], axis=1)
        numbers = frames.numbers[first:end] - frames.numbers[first]
        return Run(frames.name, numbers * seconds, away)

    start = _start(positions, frames.peak)
    end = len(speeds) if frames.bounce == len(speeds) else frames.bounce - BEFORE_BOUNCE
    away = np.linalg.norm(positions - positions[start], axis=1)
    tracked = away[frames.peak : end], speeds[frames.peak : end]
    if frames.bounce == len(speeds):
        return Kick(frames.name, run(start, _rest(speeds, frames.peak)), None, tracked)
    again = frames.bounce + 5
    again += int(speeds[again : again + 55].argmax())
    first = run(start, frames.bounce - BEFORE_BOUNCE)
    return Kick(frames.name, first, run(again, _rest(speeds, again)), tracked)


def _bounce(speeds: Array, peak: int) -> int:
    fell = (speeds[peak + 10 :] < BOUNCE * speeds[peak:-10]) & (speeds[peak:-10] > 0.6)
    return peak + 10 + int(fell.argmax()) if fell.any() else len(speeds)


def _start(positions: Array, peak: int) -> int:
    """Return the last frame in which the ball lies where it lay before the kick."""
    lay = np.median(positions[:30], axis=0)
    near = np.linalg.norm(positions[:peak] - lay, axis=1) < 0.01
    return int(np.flatnonzero(near)[-1])


def _rest(speeds: Array, first: int) -> int:
    """Return the first frame after `first` in which the ball is too slow."""
    slow = speeds[first:] < SLOWEST
    return first + int(slow.argmax()) if slow.any() else len(speeds)


def _frame_time(frames: Frames) -> float:
    """Return the time between two frames (s), in which a rolling ball is as fast as tracked."""
    peak, speeds = frames.peak, frames.speeds
    away = np.linalg.norm(frames.positions - frames.positions[peak], axis=1)
    end = min(frames.bounce - BEFORE_BOUNCE, _rest(speeds, peak))
    rolls = slice(peak + int((end - peak) * 0.4), end)
    distance = float(away[rolls][-1] - away[rolls][0])
    means = (speeds[rolls][1:] + speeds[rolls][:-1]) / 2
    return distance / float((means * np.diff(frames.numbers[rolls])).sum())


def least_squares(residuals: Callable[[Array], Array], start: Array, scale: float) -> Array:
    """Return the parameters with the least residuals; those beyond `scale` count less."""
    parameters = start
    for _ in range(12):
        now = residuals(parameters)
        steps = 1e-4 * np.eye(len(parameters))
        slopes = np.stack([residuals(parameters + step) - now for step in steps], axis=1) / 1e-4
        weight = np.sqrt(1 / np.maximum(1, np.abs(now) / scale))
        change, *_ = np.linalg.lstsq(slopes * weight[:, None], -now * weight, rcond=None)
        parameters = parameters + change
    return parameters


def huber(residuals: Array) -> float:
    """Return the mean loss of residuals (m)."""
    size = np.abs(residuals)
    return float(np.where(size < OUTLIER, size**2 / 2, OUTLIER * (size - OUTLIER / 2)).mean())


def fit_start(run: Run, law: Rolling) -> Array:
    """Return the distance (m) and speed (m/s) at the first time of a run that rolls by `law`."""
    times = run.times - run.times[0]
    speed = (run.distances[-1] - run.distances[0]) / max(times[-1], 1e-3)

    def residuals(start: Array) -> Array:
        missing: Array = start[0] + rolled(law, start[1], times) - run.distances
        return missing

    return least_squares(residuals, np.array([run.distances[0], 1.2 * speed]), OUTLIER)


def loss(law: Rolling, runs: list[Run]) -> float:
    """Return the mean loss of runs that roll by `law`, each weighted by up to 2 m of its length."""
    total = weights = 0.0
    for run in runs:
        start = fit_start(run, law)
        residuals = start[0] + rolled(law, start[1], run.times - run.times[0]) - run.distances
        weight = min(run.distances[-1] - run.distances[0], 2.0)
        total, weights = total + weight * huber(residuals), weights + weight
    return total / weights


def fit_rolling(runs: list[Run]) -> Rolling:
    """Return the law of runs that roll, the best of a grid."""

    def best(decelerations: range, drags: range) -> Rolling:
        laws = [Rolling(a / 1000, b / 1000) for a in decelerations for b in drags if b >= 0]
        return min(laws, key=lambda law: loss(law, runs))

    near = best(range(100, 240, 10), range(0, 100, 10))
    a, b = round(1000 * near.deceleration), round(1000 * near.drag)
    return best(range(a - 8, a + 9, 2), range(b - 8, b + 9, 2))


def tracked_pairs(kick: Kick, first: float) -> list[tuple[float, float]]:
    """Return tracked speeds (m/s) at places beyond `first` (m), and those `AFTER` behind them."""
    distances, speeds = kick.tracked

    def at(place: float) -> float:
        near = np.abs(distances - place) < NEAR
        if near.sum() < 6:
            return math.nan
        # Squares of speeds fall by about the same in each meter.
        return math.sqrt(
            max(float(np.polyfit(distances[near] - place, speeds[near] ** 2, 1)[1]), 0)
        )

    places = np.arange(first, distances.max() - AFTER, BETWEEN)
    pairs = [(at(place), at(place + AFTER)) for place in places.tolist()]
    return [pair for pair in pairs if all(speed > SLOWEST for speed in pair)]  # NaN is not


def fit_to_speeds(kicks: list[list[tuple[float, float]]]) -> Rolling:
    """Return the law, of a grid, with the least relative errors of the second speeds of kicks."""

    def error(law: Rolling, before: float, after: float) -> float:
        return ((law.speed_at(before, AFTER) or 0.0) / after - 1) ** 2

    def loss(law: Rolling) -> float:
        return sum(float(np.mean([error(law, *pair) for pair in pairs])) for pairs in kicks)

    laws = (Rolling(a / 1000, b / 1000) for a in range(60, 180, 5) for b in range(0, 100, 4))
    return min(laws, key=loss)


def fit_sliding(run: Run, law: Rolling) -> tuple[Array, float]:
    """Return the kick's speed (m/s), sliding deceleration (m/s²), rolling share and start (s).

    Also returns the mean error (m).
    """
    part = run.distances < 4.5
    times, distances = run.times[part], run.distances[part]
    guess = max(1.2 * distances[8] / times[8], 0.5)
    fits = []
    for share in np.arange(0.56, 0.84, 0.01):
        for deceleration in np.arange(1.5, 6.0, 0.25):

            def residuals(
                start: Array, share: float = share, deceleration: float = deceleration
            ) -> Array:
                floor = (deceleration, share, law)
                return slid_then_rolled(floor, start[0], times - start[1]) - distances

            start = least_squares(residuals, np.array([guess, 0.0]), 2 * OUTLIER)
            error = float(np.minimum(np.abs(residuals(start)), 0.05).mean())
            fits.append((error, np.array([start[0], deceleration, share, start[1]])))
    error, best = min(fits, key=lambda fit: fit[0])
    return best, error


def rolling_part(run: Run, first: float) -> Run | None:
    """Return the part of a run beyond `first` (m); None if it is shorter than half a meter."""
    part = run.distances > first
    if not part.any() or run.distances[-1] - first < 0.5:
        return None
    return Run(run.name, run.times[part], run.distances[part])


def local_speeds(run: Run) -> Iterator[tuple[float, float]]:
    """Yield distance (m) and speed (m/s) in steps along a run, from lines through its positions."""
    for at in np.arange(run.distances[0] + STEP, run.distances[-1] - STEP, STEP):
        near = np.abs(run.distances - at) < STEP
        if near.sum() >= 6:
            slope, middle = np.polyfit(run.times[near], run.distances[near], 1)
            yield float(slope * run.times[near].mean() + middle), float(slope)


@dataclass(frozen=True)
class Prediction:
    """Speeds (m/s) of a rolling ball after a distance (m)."""

    after: float
    predicted: float
    measured: float


def predict(run: Run, law: Rolling) -> Prediction:
    """Predict the speed of a run that rolls by `law` from its first positions."""
    early = run.distances < run.distances[0] + EARLY
    begin, speed = fit_start(Run(run.name, run.times[early], run.distances[early]), law)
    measured = np.array(list(local_speeds(run)))
    at = min(float(begin) + AFTER, measured[-1, 0])
    predicted = law.speed_at(float(speed), at - float(begin)) or 0.0
    return Prediction(at - float(begin), predicted, float(np.interp(at, *measured.T)))


def fit_venue(folder: Path, two_cameras: bool) -> dict[str, object]:
    """Fit one venue, print it, and return its figures for the page."""
    kicks = read(sorted(folder.glob("*.csv")), two_cameras)
    law = Rolling(0.15, 0.03)
    for _ in range(2):  # where sliding ends depends on rolling, and the other way round
        slides = {kick.name: fit_sliding(kick.first, law) for kick in kicks}
        starts = {name: _rolls_from(slide) for name, (slide, _) in slides.items()}
        runs = {kick.name: _rolling_runs(kick, starts[kick.name]) for kick in kicks}
        law = fit_rolling(_all(runs))
    kept = [slides[name][0] for name, parts in runs.items() if parts]
    floor = np.median(kept, axis=0)
    _, sliding, ratio, _ = floor
    pairs: dict[str, list[tuple[float, float]]] = {}
    if two_cameras:
        for kick in kicks:
            slide = np.array(
                [slides[kick.name][0][0], *floor[1:]]
            )  # its speed on the venue's floor
            pairs[kick.name] = tracked_pairs(kick, _rolls_from(slide))
        law = fit_to_speeds([of_kick for of_kick in pairs.values() if of_kick])
    print(f"{folder.name}: {law}")
    figures: dict[str, object] = {
        "sliding_deceleration": round(float(sliding), 2),
        "slide_to_roll_ratio": round(float(ratio), 2),
        "rolling_deceleration": law.deceleration,
        "rolling_drag": law.drag,
    }
    print(f"  median of slides: {sliding:.2f} m/s², ratio {ratio:.2f}")
    shown = []
    for kick in kicks:
        slide, error = slides[kick.name]
        print(
            f"  {kick.name}: kick {slide[0]:.2f} m/s, sliding {slide[1]:.2f} m/s², share "
            f"{slide[2]:.2f}, error {1000 * error:.1f} mm"
        )
        parts = runs[kick.name]
        predictions: dict[str, Prediction] = {}
        if two_cameras:
            for before, after in pairs[kick.name][:1]:
                by_law = law.speed_at(before, AFTER) or 0.0
                predictions["fit"] = Prediction(AFTER, by_law, after)
        elif parts:
            predictions["fit"] = predict(parts[0], law)
            others = {name: run for name, run in runs.items() if name != kick.name}
            predictions["others"] = predict(parts[0], fit_rolling(_all(others)))
        print(f"    {predictions}")
        shown.append(_figures(kick, slide, predictions, parts))
    return figures | {"kicks": shown}


def _all(runs: dict[str, list[Run]]) -> list[Run]:
    return [run for parts in runs.values() for run in parts]


def _rolls_from(slide: Array) -> float:
    """Return the distance (m) from which a kick counts as rolling."""
    speed, deceleration, share, _ = slide
    return float(speed**2 * (1 - share**2) / (2 * deceleration)) + MARGIN


def _rolling_runs(kick: Kick, first: float) -> list[Run]:
    """Return the rolling parts of a kick, which rolls from `first` (m)."""
    parts = [rolling_part(kick.first, first)]
    if kick.bounced is not None:
        parts.append(rolling_part(kick.bounced, AFTER_BOUNCE))
    return [part for part in parts if part is not None]


def _figures(
    kick: Kick, slide: Array, predictions: dict[str, Prediction], runs: list[Run]
) -> dict[str, object]:
    speeds = [[[round(at, 2), round(speed, 3)] for at, speed in local_speeds(run)] for run in runs]
    return {
        "kick": kick.name,
        "speed": round(float(slide[0]), 2),
        "sliding_deceleration": round(float(slide[1]), 2),
        "slide_to_roll_ratio": round(float(slide[2]), 2),
        "predictions": {
            by: {name: round(number, 3) for name, number in asdict(prediction).items()}
            for by, prediction in predictions.items()
        },
        "speeds": [run for run in speeds if len(run) >= SHOWN],
    }


def main() -> None:
    """Fit both venues and write the figures."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("folder", type=Path, help="folder with the folders of the two venues")
    folder = parser.parse_args().folder
    figures: dict[str, dict[str, object]] = {}
    for venue, preset in VENUES.items():
        figures[preset] = fit_venue(folder / venue, venue in TWO_CAMERAS)
    FIGURES.write_text(json.dumps(figures, indent=1) + "\n")


if __name__ == "__main__":
    main()
