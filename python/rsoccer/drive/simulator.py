"""Robots on a network as the simulator of `Matches`."""

from __future__ import annotations

import logging
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, Forecaster
from rsoccer.arrays import Doubles, Floats, Mask
from rsoccer.completed import CompletedStepper
from rsoccer.drive.connection import Connection
from rsoccer.frame import Frame
from rsoccer.simulated_senses import SensingStepper
from rsoccer.simulator_interface import Closer, Placer, Reader, Stepper

_LOGGER: Final = logging.getLogger(__name__)
TOLERANCE: Final = 0.002
"""Time by which a frame may be early to end a step, s: stamps are rounded."""
PLACED: Final = 0.05
"""Distance from its place up to which a body is where it was put, m."""
RESTING: Final = 0.05
"""Speed up to which a ball is where it was put, m/s; a faster one has gone on."""
FRAMES_TO_ACT: Final = 4
"""Frames that may pass before one shows bodies where they were put: 60 ms of latency."""
FRAMES_TO_SHOW: Final = 20
"""Frames after which bodies are put again: the message may be lost."""
HIDDEN: Final = 0.05
"""Gap between ball and robot up to which the robot may hide the ball from a camera, m."""
FRAMES_TO_SEE: Final = 12
"""Frames without a ball, after the past is forgotten, from which a robot hides it: all cameras
have looked."""
SETTLED: Final = 0.1
"""Speed up to which a robot stands, m/s: about what a tracker makes of noise."""
SETTLING: Final = 2.0
"""Longest time for which robots are left to stand before they are put somewhere, s: those of
FIRASim take 1 s."""
_BALL_SIZE: Final = len(BALL_COLUMNS)
_MOTION_SIZE: Final = ROBOT_COLUMNS.index("v_theta") + 1
_ALL: Final = np.ones(1, np.bool_)


class _Poses:
    """The rows that a connection tells: positions and velocities, without touches and crossings."""

    def __init__(self, connection: Connection) -> None:
        self._connection = connection
        self._until = 0.0

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles:
        connection = self._connection
        clock, step = connection.sight.clock, connection.config.time_step
        # Steps have their length in the mean: one that ended late is followed by a short one.
        self._until += step
        if not clock.now < self._until <= clock.now + step:
            self._until = clock.now + step
        connection.advance(commands[0], self._until - TOLERANCE)
        return self.read(out)

    def read(self, out: Floats) -> Doubles:
        self._connection.sight.read(out)
        return np.array([self._connection.sight.clock.now])


class NetworkStepper(Stepper, Reader, SensingStepper, Closer):
    """Robots on a network, which stay where they are when episodes begin.

    Vision gives the time: a control step ends with the first frame after its length. What the
    robots know is the state of the newest frame, or, with `sensing` that forecasts, the state in
    which the next commands act.

    Attributes:
        connection: the connection.
    """

    def __init__(self, connection: Connection, *, is_owner: bool = True) -> None:
        """Step a connection.

        Args:
            connection: the connection.
            is_owner: whether `close` closes it; else it stops the robots.
        """
        self.connection, self._is_owner = connection, is_owner
        config, gap = connection.config, connection.settings.contact_gap
        self._poses = _Poses(connection)
        self._completed = CompletedStepper(self._poses, config, velocities=False, gap=gap)
        self._rows = Frame.empty(1, config.n_blue, config.n_yellow)
        self._forecasters: dict[str, Forecaster] = {}
        sensing = config.sensing
        if sensing is not None and sensing.forecast >= 0.5:
            names = ("blue", "yellow", "all")
            self._forecasters = {name: Forecaster(config, 1, 1, name) for name in names}
            connection.on_sent.append(self._note)

    def _note(self, time: float, commands: Floats) -> None:
        for forecaster in self._forecasters.values():
            forecaster.send(commands[None], np.array([time]))
        self.connection.sight.note_commands(time, commands, self.connection.driven)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles | None:
        """Let the robots execute commands for a control step; see `Stepper.step`.

        Raises:
            ConnectionError: there are no frames for `Settings.patience`.
            RuntimeError: the simulator refuses all commands, the guard has ended, or this program
                is late in many steps in a row.
        """
        if active is not None and not active[0]:
            return np.array([self.connection.sight.clock.now])
        times = self._completed.step(commands, self._rows.rows)
        self._finish(out)
        x, y = self._rows.ball.position[0].tolist()
        step = self.connection.config.time_step
        self.connection.officials.reported.advance((x, y), step)
        return times

    def read(self, out: Floats) -> Doubles | None:
        """Write the present state, once all robots that are driven are in sight; see `Reader.read`.

        Raises:
            ConnectionError: something is out of sight for `Settings.patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        return self._read(out)

    def _read(self, out: Floats, *, needs_all: bool = True) -> Doubles | None:
        self.connection.begin(needs_all=needs_all)
        times = self._completed.read(self._rows.rows)
        self._finish(out)
        return times

    def begin_senses(
        self, worlds: Mask, keys: NDArray[np.uint64], numbers: Floats | None = None
    ) -> None:
        """Begin to sense; see `SensingStepper.begin_senses`.

        Raises:
            ValueError: numbers of senses, which are what they are.
        """
        if numbers is not None:
            raise ValueError("randomization: expected no numbers of senses of robots on a network")

    def sense(self, out: Floats, active: Mask | None = None, known: str | None = "blue") -> None:
        """Write what the robots know; see `SensingStepper.sense`."""
        out[:] = self._rows.rows
        if not self._forecasters or known is None:
            return
        sensing = self.connection.config.sensing
        shares = sensing is not None and sensing.forecast_others >= 0.5
        begin = self._rows.rows if shares else self._estimates(known)
        seen = np.array([self.connection.sight.clock.now])
        forecaster = self._forecasters["all" if shares else known]
        forecaster.forecast(begin, seen, np.array([self.connection.now]), out)

    def _estimates(self, team: str) -> Floats:
        """The present row as a team knows it that has sent the commands of its own robots alone."""
        config = self.connection.config
        own = range(config.n_blue) if team == "blue" else range(config.n_blue, config.n_robots)
        known = Frame.empty(1, config.n_blue, config.n_yellow)
        self.connection.sight.read(known.rows, own)
        present = self._rows.copy()
        present.ball.position[:] = known.ball.position
        present.ball.velocity[:] = known.ball.velocity
        present.robots.data[..., :_MOTION_SIZE] = known.robots.data[..., :_MOTION_SIZE]
        return present.rows

    def close(self) -> None:
        """Stop the robots, and close a connection of its own."""
        if self._is_owner:
            self.connection.close()
        else:
            self.connection.stop()

    def _finish(self, out: Floats) -> None:
        """Write rows in which a ball that a robot reports at its dribbler cuts the break beam.

        The opposite does not hold: protocols report contact, and a beam is cut before it.
        """
        _, contact = self.connection.contact()
        self._rows.robots.infrared[0, contact] = 1.0
        self.connection.frame.rows[:] = self._rows.rows
        out[:] = self._rows.rows


class UntouchedNetwork(NetworkStepper, Placer):
    """Robots on a network whose play goes on as it is when a task wants bodies somewhere else.

    The first match waits until all robots that are driven are in sight. Later ones go on with
    robots that are absent, such as those that were substituted or carded.
    """

    _has_begun = False

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Begin with the state as it is; see `Placer.place`.

        Raises:
            ConnectionError: there are no frames for `Settings.patience`, or in the first match
                something is out of sight.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
            ValueError: factors on the numbers of models.
        """
        _check_parameters(parameters)
        times = self._read(out, needs_all=not self._has_begun)
        self._has_begun = True
        return times

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        """Go on with the state as it is; see `Placer.restart`."""
        return self._read(out, needs_all=False)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        """Go on with the state as it is; see `Placer.reposition_balls`."""
        return self._read(out, needs_all=False)


class NetworkSimulator(NetworkStepper, Placer):
    """A simulator on a network, which puts bodies where tasks want them."""

    _has_warned = False

    def place(
        self, worlds: Mask, rows: Floats, out: Floats, parameters: Floats | None = None
    ) -> Doubles | None:
        """Put all bodies; see `Placer.place`.

        Raises:
            ConnectionError: vision does not show them there within `Settings.patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
            ValueError: factors on the numbers of models, which only its own settings change.
        """
        _check_parameters(parameters)
        return self._put(rows, out, ball_only=False)

    def restart(self, worlds: Mask, rows: Floats, out: Floats) -> Doubles | None:
        """Put all bodies of a running match; see `Placer.restart`.

        Raises:
            ConnectionError: vision does not show them there within `Settings.patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        return self._put(rows, out, ball_only=False)

    def reposition_balls(self, worlds: Mask, balls: Floats, out: Floats) -> Doubles | None:
        """Put the ball; see `Placer.reposition_balls`.

        Raises:
            ConnectionError: vision does not show it there within `Settings.patience`.
            RuntimeError: the simulator refuses all commands, or the guard has ended.
        """
        rows = self._rows.rows.copy()
        rows[:, :_BALL_SIZE] = balls
        return self._put(rows, out, ball_only=True)

    def _put(self, rows: Floats, out: Floats, *, ball_only: bool) -> Doubles | None:
        connection, present = self.connection, self._rows.copy()
        wanted = Frame(np.array(rows, np.float32), present.n_blue, present.n_yellow)
        self._let_pass(1)
        if not ball_only:
            self._settle()
        messages = connection.placement(wanted, ball_only=ball_only)
        sight, hidden = connection.sight, self._is_hidden(wanted)
        state = {"seen": -1}

        def is_placed() -> bool:
            """Put bodies, again if need be, and look once they must be there."""
            passed = sight.frames - state["seen"]
            if state["seen"] < 0 or passed > FRAMES_TO_SHOW:
                connection.put(messages)
                state["seen"] = sight.frames
                return False
            if passed == FRAMES_TO_ACT:
                connection.forget()
            if passed <= FRAMES_TO_ACT:
                return False
            sight.read(present.rows)
            if hidden and not sight.has_ball and passed >= FRAMES_TO_ACT + FRAMES_TO_SEE:
                present.ball.data[:] = wanted.ball.data
            return _is_there(present, wanted, ball_only=ball_only)

        connection.stand(is_placed, "bodies where they were put")
        connection.forget()
        self._let_pass(2)
        if hidden:
            self._suppose_ball(wanted)
        self._warn_of_referee()
        return self.read(out)

    def _warn_of_referee(self) -> None:
        """Say once that a referee has a part in the results, which nobody would see in them."""
        if self.connection.officials.packets and not self._has_warned:
            self._has_warned = True
            _LOGGER.warning(
                "referee: one is heard, which may halt robots and put them somewhere; results are "
                "those of the task with a simulator without a referee"
            )

    def _suppose_ball(self, wanted: Frame) -> None:
        """Take the ball to lie where it was put at a robot, unless a camera sees it soon."""
        sight = self.connection.sight
        until = sight.frames + FRAMES_TO_SEE
        self.connection.stand(lambda: sight.has_ball or sight.frames >= until, "frames")
        if not sight.has_ball:
            x, y = wanted.ball.position[0].tolist()
            sight.suppose_ball((x, y))

    def _is_hidden(self, wanted: Frame) -> bool:
        """Whether the ball is put to rest at a robot, where cameras may not see it."""
        config, robots = self.connection.config, wanted.robots
        if _moves(wanted):
            return False
        radii = np.array([model.bounding_radius for model in config.robots])
        away = np.linalg.norm(robots.position[0] - wanted.ball.position[0], axis=1)
        near = away - radii - config.ball.radius <= HIDDEN
        return bool((near & (robots.absent[0] == 0)).any())

    def _settle(self) -> None:
        """Let robots come to rest: FIRASim's keep their velocity where they are put."""
        sight, present = self.connection.sight, self._rows.copy()
        until = sight.clock.now + SETTLING

        def is_at_rest() -> bool:
            sight.read(present.rows)
            moving = np.hypot(*present.robots.velocity[0].T) > SETTLED
            return sight.clock.now >= until or not moving.any()

        self.connection.stand(is_at_rest, "frames")

    def _let_pass(self, frames: int) -> None:
        """Let robots stand for some frames."""
        sight = self.connection.sight
        until = sight.frames + frames
        self.connection.stand(lambda: sight.frames >= until, "frames")


def _is_there(present: Frame, wanted: Frame, *, ball_only: bool) -> bool:
    """Whether bodies are where they were put, as far as they stay there."""
    ball = np.hypot(*(present.ball.position[0] - wanted.ball.position[0]))
    if not _moves(wanted) and ball > PLACED:
        return False
    if ball_only:
        return True
    expected = wanted.robots.absent[0] == 0
    there = present.robots.absent[0] == 0
    away = np.linalg.norm(present.robots.position[0] - wanted.robots.position[0], axis=1)
    return bool((there[expected] & (away[expected] <= PLACED)).all())


def _moves(wanted: Frame) -> bool:
    """Whether a ball that is put goes on at once."""
    speed = float(np.hypot(*wanted.ball.velocity[0]))
    return speed > RESTING or float(wanted.ball.height[0]) > PLACED


def _check_parameters(parameters: Floats | None) -> None:
    if parameters is not None:
        raise ValueError(
            "randomization: expected no factors on the numbers of robots on a network, got some"
        )
