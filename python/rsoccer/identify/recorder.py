"""Logs of this package's simulator: a robot follows a program, and cameras see it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from rsoccer._core import BallModel, RobotModel, Sensing, SimConfig, Simulator
from rsoccer.arrays import Doubles, Floats
from rsoccer.frame import Frame
from rsoccer.identify.log import BALL, DRIVES, KICK, Log
from rsoccer.identify.program import Program, program
from rsoccer.identify.simulation import TICK

ROBOT: Final = "blue_0"
"""Name of the robot in these logs."""
_FRAME_TIME: Final = 0.015  # s, of cameras whose rate is not given
_GAP: Final = 0.001  # m between a robot's front and the ball that it will kick


def record(
    robot: str | RobotModel = "ssl_generic",
    ball: str | BallModel | None = None,
    sensing: str | Sensing | None = None,
    *,
    excitation: Program | None = None,
    gains: Sequence[float] | None = None,
    seed: int = 0,
) -> Log:
    """Return the log of a simulated robot that follows a program.

    Detections are logged as cameras make them, without a tracker, each when it arrives. Commands go
    out once a frame, which takes whole ticks of the physics, of 5 ms.

    Args:
        robot: model of the robot, or the name of its preset.
        ball: model of the ball, or the name of its preset; None for that of the robot's league.
        sensing: senses of the robot, and errors of its wheels; None if they are exact.
        excitation: the program; None for `program(robot)`.
        gains: driven by commanded speed, for each number of a command: a robot with other gains
            than its model. None for 1.
        seed: seed of the senses.

    Raises:
        TypeError: an argument of another type.
        ValueError: no such preset, a program for another drive, gains of another number, or a robot
            that a log cannot command.
    """
    model = RobotModel(robot) if isinstance(robot, str) else robot
    excitation = program(model) if excitation is None else excitation
    columns = DRIVES[excitation.drive]
    if excitation.drive != model.drive:
        raise ValueError(f"excitation: expected one for {model.drive}, got {excitation.drive}")
    factors = np.ones(len(columns)) if gains is None else np.asarray(gains, np.float64)
    if factors.shape != (len(columns),):
        raise ValueError(f"gains: expected {len(columns)} numbers, got {gains!r}")
    senses = Sensing(sensing) if isinstance(sensing, str) else sensing or Sensing()
    field = "ssl_a" if model.drive == "omni" else "vss_5v5"
    recorder = _Recorder(field, model, ball, senses, seed)
    return Log.of_rows(recorder.rows(excitation, factors))


class _Recorder:
    """A robot and a ball in a simulator with senses."""

    def __init__(
        self,
        field: str,
        model: RobotModel,
        ball: str | BallModel | None,
        senses: Sensing,
        seed: int,
    ) -> None:
        period = 1.0 / senses.frame_rate if senses.frame_rate > 0.0 else _FRAME_TIME
        self.step = TICK * max(1, round(period / TICK))
        # A frame in each control step arrives at its end, so that its time is known exactly.
        numbers = json.loads(senses.to_json())
        senses = Sensing.from_json(json.dumps(numbers | {"frame_rate": 0.0, "tracker": 0.0}))
        config = SimConfig(
            field, 1, 0, robot=model, ball=ball, time_step=self.step, tick=TICK, sensing=senses
        )
        self.model, self.config = model, config
        self.simulator = Simulator(config)
        self.state = Frame.empty(1, 1, 0)
        self.seen = Frame.empty(1, 1, 0)
        corner = 0.4 * config.field.length, 0.4 * config.field.width  # out of the robot's way
        self.state.ball.position[0] = corner
        self.simulator.place(np.ones(1, np.bool_), self.state.rows, self.state.rows)
        self.simulator.begin_senses(np.ones(1, np.bool_), np.array([seed], np.uint64))

    def rows(self, excitation: Program, gains: Doubles) -> list[Mapping[str, object]]:
        """Return the rows of the log."""
        steps = round(excitation.seconds / self.step)
        wheels, kicks = excitation.at(self.step * np.arange(steps, dtype=np.float64))
        columns = DRIVES[excitation.drive]
        rows: list[Mapping[str, object]] = []
        balls = list(excitation.balls)
        command = np.zeros((1, 1, len(self.config.command_columns)), np.float32)
        for step in range(steps):
            time = step * self.step
            if balls and time >= balls[0][0]:
                self._bring_ball(balls.pop(0)[1])
            rows += self._seen(time)
            sent = dict(zip(columns, wheels[step].tolist(), strict=True))
            rows.append({"time": time, "robot": ROBOT, **sent, KICK: float(kicks[step])})
            command[0, 0, : len(columns)] = wheels[step] * gains
            if self.model.has_mouth:
                command[0, 0, len(columns)] = kicks[step]
            self.simulator.step(command, self.state.rows)
        return rows

    def _bring_ball(self, speed: float) -> None:
        """Put robot and ball on the field's axis: the ball rolls, or lies before the robot."""
        robot, ball = self.state.blue, self.state.ball
        x = -0.45 * self.config.field.length
        robot.position[0, 0], robot.heading[0, 0] = (x, 0.0), (1.0, 0.0)
        robot.velocity[:], robot.angular_velocity[:] = 0.0, 0.0
        ball.data[:] = 0.0
        ball.last_touch[:] = -1.0
        if speed > 0.0:
            ball.position[0] = (x, 0.3 * self.config.field.width)
            ball.velocity[0] = (speed, 0.0)
        else:
            front = self.model.front_distance + self.config.ball.radius + _GAP
            ball.position[0] = (x + front, 0.0)
        self.simulator.restart(np.ones(1, np.bool_), self.state.rows, self.state.rows)

    def _seen(self, time: float) -> list[Mapping[str, object]]:
        """Poses that arrived since the last step; a body that no frame showed has its last one."""
        before = self.seen.rows.copy()
        self.simulator.sense(self.seen.rows)
        old = Frame(before, 1, 0)
        rows: list[Mapping[str, object]] = []
        robot = self.seen.blue
        if _differs(old.blue.data, robot.data):
            (x, y), (cos, sin) = robot.position[0, 0].tolist(), robot.heading[0, 0].tolist()
            theta = float(np.arctan2(sin, cos))
            rows.append({"time": time, "robot": ROBOT, "x": x, "y": y, "theta": theta})
        if _differs(old.ball.data, self.seen.ball.data):
            x, y = self.seen.ball.position[0].tolist()
            rows.append({"time": time, "robot": BALL, "x": x, "y": y})
        return rows


def _differs(old: Floats, new: Floats) -> bool:
    return bool((old != new).any())
