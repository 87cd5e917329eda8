"""Identification of a robot, a ball and their delays from a log of commands and poses."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rsoccer._core import BallModel, RobotModel, Sensing
from rsoccer.checks import integer, integer_in_range
from rsoccer.files import write_atomically
from rsoccer.identify.alignment import track_noise
from rsoccer.identify.ball_fit import BallFit
from rsoccer.identify.ball_runs import runs
from rsoccer.identify.drive_fit import DriveFit
from rsoccer.identify.first_look import check_gains, shifted, with_one_clock
from rsoccer.identify.kick_fit import kick_estimates
from rsoccer.identify.log import Log
from rsoccer.identify.log_checks import check_units
from rsoccer.identify.program import check_drive
from rsoccer.identify.replaced import as_json, with_numbers
from rsoccer.identify.results import Estimate
from rsoccer.identify.senses_fit import camera_estimates, delay_estimates

_KICK = "max_kick_speed"


@dataclass(frozen=True)
class Identified:
    """Numbers that a log identifies, with intervals of 95%, and the models that have them."""

    robot: RobotModel
    """The robot: its base with the identified numbers."""
    ball: BallModel
    """The ball with its floor: its base with the identified numbers."""
    sensing: Sensing
    """Delay, frame rate and noise; all else is exact. Of a log without the times of captures, the
    whole latency is its `delay`."""
    drive: tuple[Estimate, ...]
    """Latency, gains and limits of the robots; what the model has no number for, such as gains and
    accelerations along one axis, too."""
    rolling: tuple[Estimate, ...]
    """Numbers of the ball and its floor."""
    kicks: tuple[Estimate, ...]
    """Driven by commanded speed of kicks, their greatest speed, and their latency."""
    cameras: tuple[Estimate, ...]
    """Numbers of `Sensing`."""
    misfit: float
    """Scatter of the poses around the simulated paths, by their noise: about 1 where the model
    explains everything, NaN for a log without commands."""
    seconds: float
    """Time of the log that robots drove by commands, s."""
    _parts: tuple[tuple[str, dict[str, Any]], ...]

    @property
    def estimates(self) -> tuple[Estimate, ...]:
        """All numbers, identified or not."""
        return (*self.drive, *self.rolling, *self.kicks, *self.cameras)

    def estimate(self, name: str) -> Estimate:
        """Return a number by name.

        Args:
            name: its name, such as "latency".

        Raises:
            KeyError: no such number.
        """
        for each in self.estimates:
            if each.name == name:
                return each
        raise KeyError(name)

    def as_dict(self) -> dict[str, Any]:
        """Return the models and all numbers as JSON values: the content of the file."""
        found = {
            each.name: {"value": each.value, "low": each.low, "high": each.high, "unit": each.unit}
            for each in self.estimates
            if each.is_identified
        }
        missing = {each.name: each.hint for each in self.estimates if not each.is_identified}
        return {**dict(self._parts), "estimates": found, "not_identified": missing}

    def save(self, path: str | Path) -> Path:
        """Write the models and all numbers to a file that names all three models.

        Every option that takes a .json file of a robot, a ball or senses takes this one.

        Args:
            path: the .json file to write.

        Returns:
            The path.
        """
        text = json.dumps(self.as_dict(), indent=2) + "\n"
        write_atomically(Path(path), text.encode())
        return Path(path)


def identify(
    log: Log,
    robot: str | RobotModel | None = None,
    ball: str | BallModel | None = None,
    *,
    clocks: int = 1,
    seed: int = 0,
) -> Identified:
    """Return the robot, ball and delays with which the simulator drives as a log shows.

    All robots with commands count as robots of one model.

    Args:
        log: the log.
        robot: model that has the numbers which no log shows, such as mass and size, or the name of
            its preset; None for `vss_440rpm` with commands of wheels, else `ssl_generic`.
        ball: the same of the ball; None for `vss_rsim` or `ssl_tigers`.
        clocks: 1 if commands and poses have the same clock, 2 if each has its own: then the latency
            cannot be identified.
        seed: seed of the intervals' random numbers.

    Raises:
        TypeError: an argument of another type.
        ValueError: no such preset; a robot that is not commanded as the log's; units that are mixed
            up, poses that do not follow commands, two clocks that were not announced, times of
            captures after those of arrivals or longer before them than the latency, or a log with
            neither a second of driving nor a run of the ball.
    """
    integer_in_range("clocks", clocks, 1, 2)
    rng = np.random.default_rng(integer("seed", seed, 0))
    is_vss = log.drive == "differential"
    base = _model("robot", robot, RobotModel, "vss_440rpm" if is_vss else "ssl_generic")
    base_ball = _model("ball", ball, BallModel, "vss_rsim" if is_vss else "ssl_tigers")
    check_drive(base)
    if log.drive not in (None, base.drive):
        raise ValueError(f"robot: expected one of drive {log.drive}, as the log's, got {base.name}")
    check_units(log)
    fit, aligned = None, log
    if any(commands.wheels.any() for commands in log.commands.values()):
        aligned = with_one_clock(log, base, clocks)
        check_gains(aligned, base)
        fit = DriveFit(aligned, base)
        fit.run()
        drive = [*fit.estimates(rng), *fit.by_axis(rng)]
        if clocks == 2:
            aligned = shifted(aligned, drive[0].value if drive[0].is_identified else 0.0)
            drive[0] = Estimate.missing(drive[0].name, "s", "one clock of commands and poses")
    else:
        drive = [Estimate.missing("latency", "s", "commands to drive")]
        if clocks == 2:
            aligned = replace(log, commands={})
    noise = track_noise(log.ball)
    rolling = BallFit(runs(log, noise), noise, base_ball)
    rolling.run()
    if fit is None and not rolling.free.any():
        raise ValueError(
            "log: neither commands to drive nor a ball that rolls; nothing can be identified"
        )
    kicks = kick_estimates(aligned, rolling)
    if clocks == 2:
        kicks[-1] = Estimate.missing(kicks[-1].name, "s", "one clock of commands and poses")
    cameras = [*delay_estimates(log, drive[0]), *camera_estimates(log)]
    floor = rolling.estimates(rng)
    return _identified(base, base_ball, (drive, floor, kicks, cameras), fit)


def _identified(
    base: RobotModel,
    base_ball: BallModel,
    parts: tuple[list[Estimate], list[Estimate], list[Estimate], list[Estimate]],
    fit: DriveFit | None,
) -> Identified:
    """The result of estimates."""
    drive, floor, kicks, cameras = (tuple(part) for part in parts)
    of_robot = {} if fit is None else fit.drive.numbers(fit.values())
    of_robot |= {
        each.name: each.value for each in kicks if each.name == _KICK and each.is_identified
    }
    of_ball, of_senses = _values(floor), _values(cameras)
    models = {
        "robot": as_json(base, of_robot),
        "ball": as_json(base_ball, of_ball),
        "sensing": as_json(Sensing(), of_senses),
    }
    return Identified(
        with_numbers(base, of_robot),
        with_numbers(base_ball, of_ball),
        with_numbers(Sensing(), of_senses),
        drive,
        floor,
        kicks,
        cameras,
        float("nan") if fit is None else fit.solution.scale,
        0.0 if fit is None else fit.seconds,
        tuple(models.items()),
    )


def _values(estimates: tuple[Estimate, ...]) -> dict[str, float]:
    return {each.name: each.value for each in estimates if each.is_identified}


def _model(name: str, source: Any, kind: Any, preset: str) -> Any:  # noqa: ANN401  (a model)
    """A model of its source."""
    if isinstance(source, kind):
        return source
    if source is not None and not isinstance(source, str):
        raise TypeError(
            f"{name}: expected a {kind.__name__} or the name of a preset, got {source!r}"
        )
    try:
        return kind(preset if source is None else source)
    except ValueError as error:
        raise ValueError(f"{name}: {error}") from error
