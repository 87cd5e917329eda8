"""Complete state rows from a stepper that reports only poses.

Cameras, and simulators over a network, tell where the robots and the ball are. The other columns of
a row follow from consecutive frames, see `rsoccer.derived`. With them every task, rule and reward
plays as on `rsoccer.Simulator`; which columns agree, and how well, is in the tests of this module.
"""

from typing import ClassVar, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, derived
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, SimConfig
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.derived.outlines import CONTACT_GAP
from rsoccer.frame import Frame, column_slice
from rsoccer.game import NOBODY
from rsoccer.simulator_interface import Placer, Stepper, close, placer_of, reader_of

_BALL_MOTION: Final = column_slice(BALL_COLUMNS, "v_x", "v_y", "v_z")
_ROBOT_MOTION: Final = column_slice(ROBOT_COLUMNS, "v_x", "v_y", "v_theta")
_SINCE_TOUCH: Final = column_slice(
    BALL_COLUMNS, "seconds_since_touch", "speed_after_touch", "height_since_touch"
)
_CROSSED_AT: Final = column_slice(BALL_COLUMNS, "crossed_x", "crossed_y", "crossed_z")


class PlacingStepper(Stepper, Placer, Protocol):
    """A stepper that can place bodies."""


class CompletedStepper:
    """A stepper with complete rows, over one that fills in only poses, and `absent`.

    The inner stepper has to fill in `x`, `y`, `cos`, `sin` and `absent`, and `z` of the ball where
    it is known; all other columns are overwritten. Rows with the time stamp of the last ones keep
    their velocities.
    """

    _needs_placer: ClassVar[bool] = False

    def __init__(
        self,
        stepper: Stepper,
        config: SimConfig,
        worlds: int = 1,
        *,
        velocities: bool = True,
        gap: float = CONTACT_GAP,
    ) -> None:
        """Put the completion over a stepper.

        Args:
            stepper: the stepper of n worlds.
            config: field, ball and robots.
            worlds: number of worlds n, at least 1.
            velocities: True: velocities are differences of poses; False: the stepper fills them in,
                as a tracker does.
            gap: gap up to which bodies touch, m, at least 0: with noisy poses about their noise.

        Raises:
            TypeError: a number of the wrong type, or for a `CompletedSimulator` a stepper that
                cannot place bodies.
            ValueError: a number out of range.
        """
        if self._needs_placer and placer_of(stepper) is None:
            raise TypeError(
                f"stepper: expected one that can place bodies, got {type(stepper).__name__}; "
                "CompletedStepper takes others"
            )
        worlds = checks.integer("worlds", worlds, 1)
        self._stepper, self._config = stepper, config
        self._differentiates = checks.boolean("velocities", velocities)
        self._gap = checks.number_in_range("gap", gap, 0.0, 1.0)
        self._last = Frame.empty(worlds, config.n_blue, config.n_yellow)
        self._raw = Frame.empty(worlds, config.n_blue, config.n_yellow)
        self._times = np.full(worlds, np.nan)
        self._record = None if velocities else derived.TrackRecord(self._last)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        """Advance the active worlds by one control step, and complete their rows.

        Args:
            commands: (n, robots, command) commands in SI units.
            out: (n, row) output; the rows of the active worlds are overwritten.
            active: (n,) bool, worlds to advance; all if None.

        Returns:
            Time stamps, or None.

        Raises:
            RuntimeError: poses that are not finite.
        """
        times = self._stepper.step(commands, self._raw.rows, active)
        worlds = np.flatnonzero(np.ones(len(out), np.bool_) if active is None else active)
        last, frame = self._last.take(worlds), self._raw.take(worlds)
        seconds = self._elapsed(worlds, times)
        mean_motion = None if self._record is None else self._record.mean_motion(worlds, last)
        self._complete(last, frame, seconds, mean_motion)
        if self._record is not None:
            self._record.add(worlds, last, seconds)
        self._keep(worlds, frame, out)
        return times

    def read(self, out: Floats) -> Doubles | None:
        """Write the present state of all worlds, with bodies at rest unless velocities are known.

        Args:
            out: (n, row) output.

        Returns:
            Time stamps, or None.

        Raises:
            RuntimeError: poses that are not finite.
            TypeError: the stepper cannot read its state.
        """
        if (reader := reader_of(self._stepper)) is None:
            raise TypeError(f"{type(self._stepper).__name__} has no read")
        times = reader.read(self._raw.rows)
        worlds = np.arange(len(out))
        self._elapsed(worlds, times)
        self._begin(worlds, out, Frame.empty(len(out), self._raw.n_blue, self._raw.n_yellow))
        return times

    def close(self) -> None:
        """Close the stepper, if it can be closed."""
        close(self._stepper)

    def _begin(self, worlds: NDArray[np.intp], out: Floats, known: Frame) -> None:
        """Begin anew in some worlds, with the motion of a known state (k, row)."""
        frame = self._raw.take(worlds)
        if self._differentiates:
            _copy_motion(known, frame, np.ones(len(frame), np.bool_))
        frame.ball.spin[:] = known.ball.spin
        frame.ball.last_touch[:] = NOBODY
        frame.ball.crossed[:] = 0.0
        frame.ball.data[:, _CROSSED_AT] = 0.0
        frame.ball.data[:, _SINCE_TOUCH] = 0.0
        robots = frame.robots
        robots.infrared[:] = derived.beam_broken(frame, self._config)
        for column in (robots.touched_ball, robots.touched_opponent, robots.collision_speed):
            column[:] = 0.0
        if self._record is not None:
            self._record.begin(worlds, frame)
        self._keep(worlds, frame, out)

    def _keep(self, worlds: NDArray[np.intp], frame: Frame, out: Floats) -> None:
        """Keep complete rows of some worlds for the next step, and write them."""
        finite = np.isfinite(frame.rows).all(axis=1)
        if not finite.all():
            raise RuntimeError(
                f"{type(self._stepper).__name__}: expected finite poses, got others in worlds "
                f"{worlds[~finite].tolist()}"
            )
        self._last.put(worlds, frame)
        out[worlds] = frame.rows

    def _elapsed(self, worlds: NDArray[np.intp], times: Doubles | None) -> Floats:
        """Time (k,) since the last rows of some worlds, s; 0 where they are the same rows."""
        step = np.full(len(worlds), self._config.time_step)
        if times is None:
            return step.astype(np.float32)
        last = self._times[worlds]
        self._times[worlds] = times[worlds]
        elapsed = np.where(np.isnan(last), step, np.maximum(times[worlds] - last, 0.0))
        return elapsed.astype(np.float32)

    def _complete(
        self, last: Frame, frame: Frame, seconds: Floats, mean_motion: Frame | None
    ) -> None:
        """Fill in all columns of a frame but those of poses."""
        config, gap, same = self._config, self._gap, seconds == 0.0
        ball, robots = frame.ball, frame.robots
        if self._differentiates:
            derived.differentiate(last, frame, np.where(same, np.float32(1.0), seconds))
            _copy_motion(last, frame, same)
        derived.roll(frame, config.ball.radius)
        ball.crossed[:], ball.data[:, _CROSSED_AT] = derived.crossing(last, frame, config.field)
        touched = derived.ball_touches(last, frame, config, seconds, gap)
        robots.touched_ball[:] = touched
        ball.last_touch[:] = derived.last_touch(last.ball.last_touch, touched, frame, config)
        ball.data[:, _SINCE_TOUCH] = np.stack(
            derived.since_touch(last, frame, touched, seconds), axis=1
        )
        contacts = derived.collisions(last, frame, config, seconds, gap, mean_motion)
        robots.touched_opponent[:], robots.collision_speed[:] = contacts
        robots.infrared[:] = derived.beam_broken(frame, config)


class CompletedSimulator(CompletedStepper):
    """A simulator with complete rows, over one that places bodies and reports only poses."""

    _stepper: PlacingStepper
    _needs_placer = True

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Start new matches in some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) initial states.
            out: (n, row) output; the rows of the k worlds are overwritten.
            parameters: (k, parameter) factors on the models' numbers, or None.

        Returns:
            Time stamps, or None.
        """
        known = self._known(rows)
        times = self._stepper.place(worlds, rows, self._raw.rows, parameters)
        return self._placed(worlds, known, out, times)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        """Put all bodies of some matches into a new state.

        Args:
            worlds: (n,) bool, k of them True.
            rows: (k, row) new states.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.
        """
        known = self._known(rows)
        times = self._stepper.restart(worlds, rows, self._raw.rows)
        return self._placed(worlds, known, out, times)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        """Move the balls of some worlds.

        Args:
            worlds: (n,) bool, k of them True.
            balls: (k, ball column) new balls.
            out: (n, row) output; the rows of the k worlds are overwritten.

        Returns:
            Time stamps, or None.
        """
        known = self._last.take(np.flatnonzero(worlds))
        known.ball.data[:] = balls
        times = self._stepper.reposition_balls(worlds, balls, self._raw.rows)
        return self._placed(worlds, known, out, times)

    def _known(self, rows: Floats) -> Frame:
        """A copy of rows as a frame."""
        return Frame(np.array(rows, np.float32, order="C"), self._raw.n_blue, self._raw.n_yellow)

    def _placed(
        self, worlds: Mask, known: Frame, out: Floats, times: Doubles | None
    ) -> Doubles | None:
        """Begin anew in the worlds in which bodies were placed."""
        indices = np.flatnonzero(worlds)
        self._elapsed(indices, times)
        self._begin(indices, out, known)
        return times


def _copy_motion(source: Frame, frame: Frame, worlds: Mask) -> None:
    """Overwrite the velocities of some worlds (n,)."""
    frame.ball.data[worlds, _BALL_MOTION] = source.ball.data[worlds, _BALL_MOTION]
    frame.robots.data[worlds, :, _ROBOT_MOTION] = source.robots.data[worlds, :, _ROBOT_MOTION]
