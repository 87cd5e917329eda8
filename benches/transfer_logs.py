"""Logs of other simulators for `rsoccer identify`: `python -m benches.transfer_logs grsim log.csv`.

A robot of the simulator, which runs already, follows the program of `rsoccer.identify`. The log
has its commands when they were sent, and what cameras saw when it arrived, by the clock of this
machine.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from benches.transfer_places import PLACES, port_numbers
from rsoccer import RobotModel
from rsoccer.drive.connection import Connection
from rsoccer.drive.sight import Sight
from rsoccer.drive.simulator import NetworkSimulator
from rsoccer.frame import Frame
from rsoccer.identify import Log, program, write_log
from rsoccer.identify.log import BALL, DRIVES, KICK
from rsoccer.protocols import fira, vision
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import fira_pb2, vision_pb2

ROBOT: Final = "blue_0"
"""Name of the robot in the log."""
Row = dict[str, Any]


class Watcher:
    """Notes detections as they arrive, each body once a frame."""

    def __init__(self, connection: Connection, rows: list[Row]) -> None:
        """Watch a connection.

        Args:
            connection: the connection.
            rows: rows of a log, to which detections are added.
        """
        self._connection, self.rows = connection, rows
        self._stamps: dict[str, float] = {}
        sight: Sight = connection.sight
        self._take = sight.take
        sight.take = self.take  # type: ignore[method-assign]

    def take(self, data: bytes) -> bool:
        """Take in a datagram; see `Sight.take`."""
        layout, now = self._connection.layout, time.monotonic()
        if self._connection.settings.league == "vsss":
            message = parse(fira_pb2.Environment, data)
            state, stamp = fira.read_environment(layout, message), message.step / fira.MILLISECONDS
            (x, y), (cos, sin) = (
                values[0, 0].tolist()
                for values in (state.frame.robots.position, state.frame.robots.heading)
            )
            self._note(ROBOT, stamp, now, x=x, y=y, theta=float(np.arctan2(sin, cos)))
            x, y = state.frame.ball.position[0].tolist()
            self._note(BALL, stamp, now, x=x, y=y)
        elif (packet := parse(vision_pb2.Packet, data)).HasField("detection"):
            seen, stamp = vision.to_detections(layout, packet.detection), packet.detection.t_capture
            for slot, (x, y, cos, sin) in zip(seen.slots, seen.robots.tolist(), strict=True):
                if slot == 0:
                    self._note(ROBOT, stamp, now, x=x, y=y, theta=float(np.arctan2(sin, cos)))
            if len(seen.balls):
                x, y = seen.balls[0, :2].tolist()
                self._note(BALL, stamp, now, x=x, y=y)
        return self._take(data)

    def _note(self, body: str, stamp: float, now: float, **numbers: float) -> None:
        """Note a detection; other cameras that saw the body at this time add nothing."""
        if stamp > self._stamps.get(body, -np.inf):
            self._stamps[body] = stamp
            self.rows.append({"time": now, "robot": body, **numbers})


def record(place: str, ports: dict[str, int], speed: float, turn: float) -> Log:
    """Return the log of a robot that follows the program.

    Args:
        place: name of the simulator.
        ports: ports that differ.
        speed: greatest commanded speed, m/s.
        turn: greatest commanded angular velocity, rad/s.
    """
    known = PLACES[place]
    config = known.config()
    connection = Connection(config, known.settings(ports))
    try:
        return Log.of_rows(_follow(connection, config.robots[0], speed, turn))
    finally:
        connection.close()


def _follow(connection: Connection, model: RobotModel, speed: float, turn: float) -> list[Row]:
    """Rows of the log."""
    plan = program(model, max_speed=speed, max_angular_velocity=turn)
    columns, config = DRIVES[plan.drive], connection.config
    stepper = NetworkSimulator(connection, is_owner=False)
    state, rows = Frame.empty(1, 1, 0), list[Row]()
    state.robots.heading[0, 0] = (1.0, 0.0)
    state.ball.position[0] = (0.4 * config.field.length, 0.4 * config.field.width)
    stepper.place(np.ones(1, np.bool_), state.rows.copy(), state.rows)
    watcher = Watcher(connection, rows)
    command = np.zeros((1, len(config.command_columns)), np.float32)
    balls, passed, before = list(plan.balls), 0.0, time.monotonic()
    while passed < plan.seconds:
        if balls and passed >= balls[0][0]:
            _bring_ball(stepper, model, balls.pop(0)[1])
            before = time.monotonic()
        wheels, kicks = plan.at(np.array([passed]))
        command[0, : len(columns)] = wheels[0]
        if model.has_mouth:
            command[0, len(columns)] = kicks[0]
        sent = dict(zip(columns, wheels[0].tolist(), strict=True))
        watcher.rows.append(
            {"time": time.monotonic(), "robot": ROBOT, **sent, KICK: float(kicks[0])}
        )
        connection.advance(command, connection.sight.clock.now + 1e-6)
        now = time.monotonic()
        passed, before = passed + now - before, now
    return rows


def _bring_ball(stepper: NetworkSimulator, model: RobotModel, speed: float) -> None:
    """Put robot and ball on the field's axis: the ball rolls, or lies before the robot."""
    config, state = stepper.connection.config, Frame.empty(1, 1, 0)
    x = -0.4 * config.field.length
    state.robots.position[0, 0], state.robots.heading[0, 0] = (x, 0.0), (1.0, 0.0)
    if speed > 0.0:
        state.ball.position[0] = (x, 0.3 * config.field.width)
        state.ball.velocity[0] = (speed, 0.0)
    else:
        # They touch: kickers of simulators reach no farther.
        front = model.front_distance + config.ball.radius
        state.ball.position[0] = (x + front, 0.0)
    stepper.restart(np.ones(1, np.bool_), state.rows.copy(), state.rows)


def main(arguments: Sequence[str] | None = None) -> None:
    """Record a log.

    Args:
        arguments: words of the command line; None for those of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("place", choices=list(PLACES), help="the simulator")
    parser.add_argument("log", type=Path, help=".csv file to write")
    parser.add_argument("--speed", type=float, default=None, help="greatest speed, m/s")
    parser.add_argument("--turn", type=float, default=10.0, help="greatest angular velocity, rad/s")
    parser.add_argument("--ports", nargs="*", default=[], metavar="NAME=PORT", help="other ports")
    given = parser.parse_args(arguments)
    speed = given.speed or (2.5 if PLACES[given.place].league == "ssl" else 0.8)
    write_log(record(given.place, port_numbers(given.ports), speed, given.turn), given.log)


if __name__ == "__main__":
    main()
