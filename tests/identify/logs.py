"""Logs of simulated robots whose numbers are known, and their true gains."""

import numpy as np

from rsoccer import RobotModel, Sensing
from rsoccer._core import SimConfig, Simulator
from rsoccer.frame import Frame
from rsoccer.identify.log import BALL, Log

ROBOT = "blue_0"


def true_gains(model: RobotModel, sensing: Sensing, seed: int, speed: float) -> list[float]:
    """Return the driven by the commanded velocity of a robot with errors of its wheels.

    Forward, to the left and turning, measured from the true state after a second and a half.
    """
    config = SimConfig("ssl_a", 1, 0, robot=model, time_step=0.015, sensing=sensing)
    gains = []
    for axis in range(3):
        simulator, frame = Simulator(config), Frame.empty(1, 1, 0)
        frame.ball.position[0] = (4.0, 4.0)
        simulator.place(np.ones(1, np.bool_), frame.rows, frame.rows)
        simulator.begin_senses(np.ones(1, np.bool_), np.array([seed], np.uint64))
        command = np.zeros((1, 1, 6), np.float32)
        command[0, 0, axis] = speed
        for _ in range(100):
            simulator.step(command, frame.rows)
        (x, y), (cos, sin) = frame.blue.velocity[0, 0], frame.blue.heading[0, 0]
        body = [cos * x + sin * y, cos * y - sin * x, frame.blue.angular_velocity[0, 0]]
        gains.append(float(body[axis]) / speed)
    return gains


def rows_of(log: Log) -> list[dict[str, object]]:
    """Return a log of velocities as rows, for changes of some of them."""
    rows: list[dict[str, object]] = []
    for name, track in {**log.poses, BALL: log.ball}.items():
        poses = zip(
            track.times.tolist(), track.positions.tolist(), track.headings.tolist(), strict=True
        )
        for time, (x, y), theta in poses:
            seen = {"x": x, "y": y} | ({} if name == BALL else {"theta": theta})
            rows.append({"time": time, "robot": name, **seen})
    for name, commands in log.commands.items():
        for time, wheels in zip(commands.times.tolist(), commands.wheels.tolist(), strict=True):
            sent = dict(zip(("v_x", "v_y", "v_theta"), wheels, strict=True))
            rows.append({"time": time, "robot": name, **sent})
    return sorted(rows, key=lambda row: float(str(row["time"])))
