"""A check of sides, signs and delay with one robot, before a policy drives it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS, RobotModel
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.drive.connection import Connection
from rsoccer.drive.delay import Recording, fitted_delay
from rsoccer.protocols.commands import CommandRow
from rsoccer.protocols.layout import TEAM_NAMES

SPEED: Final = 0.4
"""Speed of the movements, m/s."""
ANGULAR_VELOCITY: Final = 2.0
"""Angular velocity of the turns, rad/s."""
SECONDS: Final = 0.6
"""Duration of a movement, s."""
REST: Final = 0.5
"""Time to stand after it, s."""
LOOK: Final = 0.3
"""Time for which frames are awaited before it, so that all cameras have sent some, s."""
GEOMETRY_SECONDS: Final = 1.5
"""Longest time for which the size of the field is awaited, s: SSL-Vision tells it once a second."""
MARGIN: Final = 0.05
"""Space that is left around the robot at the ends of its ways, m."""
RIGHT: Final = (0.5, 1.5)
"""Ways that a robot may drive, by what it is commanded."""
MOVED: Final = 0.15
"""Part of the commanded way below which a robot does not move."""
_X: Final = ROBOT_COLUMNS.index("x")


@dataclass(frozen=True)
class Movement:
    """A movement and what was seen of it.

    Attributes:
        name: "forward", "left" or "turn", and "back" and "right" and "turn back".
        asked: ways forward and left, m, and angle, rad.
        seen: the same by vision, in the robot's axes at the start.
    """

    name: str
    asked: tuple[float, float, float]
    seen: tuple[float, float, float]

    @property
    def verdict(self) -> str:
        """Words for the movement: "right", or what is wrong."""
        axis = int(np.argmax(np.abs(self.asked)))
        seen, asked = self.seen[axis], self.asked[axis]
        share = seen / asked
        across = 0.0 if axis == 2 else abs(self.seen[1 - axis] / asked)
        if across > max(abs(share), RIGHT[0]):
            return "wrong: it drives across, so headings or axes are exchanged"
        if abs(share) < MOVED:
            return "wrong: it does not move"
        if share < 0:
            return "wrong: the opposite, so a sign or the side is wrong"
        if not RIGHT[0] <= share <= RIGHT[1]:
            return f"wrong: {share:.2f} of the way, so a unit or the model is wrong"
        return "right"


@dataclass(frozen=True)
class CheckedRobot:
    """Findings of the check.

    Attributes:
        position: place of the robot before it, m, in the package: own goal at -x.
        movements: the movements.
        delay: time from a command until vision shows its effect, s; None if the robot does not
            move as commanded.
        gain: driven by commanded way in the fit of the delay; None without it.
    """

    position: tuple[float, float]
    movements: tuple[Movement, ...]
    delay: float | None
    gain: float | None

    @property
    def is_right(self) -> bool:
        """True if all movements are right."""
        return all(movement.verdict == "right" for movement in self.movements)


def check_robot(connection: Connection, slot: int) -> CheckedRobot:
    """Drive a robot forth and back, to its left and right, and around, and compare with vision.

    Args:
        connection: the connection.
        slot: index of the robot in a state row, one that is driven.

    Returns:
        The movements with their verdicts, and the delay.

    Raises:
        ConnectionError: it is out of sight, or vision ends.
        RuntimeError: the simulator refuses all commands, or the guard has ended.
        ValueError: no such robot, limits below the speeds of the check, a referee that halts it or
            keeps it away from the ball, or a robot, a line or the ball too near.
    """
    driven = np.flatnonzero(connection.driven)
    if slot not in driven:
        raise ValueError(f"check: expected one of {driven.tolist()}, got {slot}")
    limits = connection.settings.limits
    for name, limit, needed, unit in (
        ("speed", limits.speed, SPEED, "m/s"),
        ("angular_velocity", limits.angular_velocity, ANGULAR_VELOCITY, "rad/s"),
    ):
        if limit < needed:  # the robot would do less than it is compared with
            raise ValueError(
                f"limits: {name}: expected {needed:g} {unit} or more for the check, got {limit:g}"
            )
    _look(connection, slot)
    team = connection.layout.exchanged(connection.layout.identity(slot)[0])
    if connection.officials.restrains(team):
        raise ValueError(
            "check: expected a referee that lets the robot drive anywhere, or "
            f"`--referee ignore`, got {connection.officials.words}"
        )
    row = _read(connection)
    place = _place(row, slot)
    _check_space(connection, row, slot)
    way, angle = SPEED * SECONDS, ANGULAR_VELOCITY * SECONDS
    plan = [("forward", (way, 0.0, 0.0)), ("back", (-way, 0.0, 0.0))]
    if connection.config.robots[slot].drive != "differential":
        plan += [("left", (0.0, way, 0.0)), ("right", (0.0, -way, 0.0))]
    plan += [("turn", (0.0, 0.0, angle)), ("turn back", (0.0, 0.0, -angle))]
    movements, recordings = [], []
    for name, asked in plan:
        recording = _drive(connection, slot, asked)
        recordings.append(recording)
        movements.append(Movement(name, asked, _seen(recording, slot)))
    delay = gain = None
    if all(movement.verdict == "right" for movement in movements[:2]):
        delay, gain = fitted_delay(connection.config, recordings[:2], slot)
    return CheckedRobot((float(place[0]), float(place[1])), tuple(movements), delay, gain)


def _look(connection: Connection, slot: int) -> None:
    """Wait until the robot is in sight, all cameras have sent frames, and the field is known."""
    sight, words = connection.sight, _words(connection.layout.identity(slot))
    seen = sight.frames
    connection.stand(
        lambda: sight.frames > seen and bool(sight.in_sight[slot]), f"{words} in sight"
    )
    begun = sight.clock.now
    while (now := sight.clock.now) < begun + LOOK or (
        sight.field_size is None and now < begun + GEOMETRY_SECONDS
    ):
        connection.stand(lambda now=now: sight.clock.now > now, "a frame")  # type: ignore[misc]


def _read(connection: Connection) -> Floats:
    row = np.empty((1, connection.config.row_size), np.float32)
    connection.sight.read(row)
    connection.frame.rows[:] = row
    return row


def _place(row: Floats, slot: int) -> Floats:
    begin = len(BALL_COLUMNS) + slot * len(ROBOT_COLUMNS)
    pose: Floats = row[0, begin + _X : begin + _X + 4]
    return pose


def _check_space(connection: Connection, row: Floats, slot: int) -> None:
    place, sight = _place(row, slot), connection.sight
    field = connection.config.field
    length, width = sight.field_size or (field.length, field.width)
    own = reach(connection.config.robots[slot])

    def distance(other: Array) -> float:
        return float(np.hypot(*(place[:2] - other)))

    free = {"a line": min(length / 2 - abs(place[0]), width / 2 - abs(place[1]))}
    if sight.has_ball:
        free["the ball"] = distance(row[0, :2])
    for other in range(connection.config.n_robots):
        if other != slot and sight.in_sight[other]:
            free[_words(connection.layout.identity(other))] = distance(_place(row, other)[:2])
    for identity, where in zip(sight.strangers, sight.stranger_places, strict=True):
        # One on the robot itself is the robot, whose number a camera has misread.
        if (gap := distance(where)) > own:
            free[_words(identity)] = gap
    nearest = min(free, key=lambda name: free[name])
    needed = SPEED * SECONDS + 2 * own + MARGIN
    if free[nearest] < needed:
        raise ValueError(
            f"check: expected {needed:.2f} m of free field around the robot, got "
            f"{free[nearest]:.2f} m to {nearest} at ({place[0]:.2f}, {place[1]:.2f})"
        )


def _words(identity: tuple[int, int]) -> str:
    """Words for a robot on the wire, such as "yellow 3"."""
    team, number = identity
    return f"{TEAM_NAMES[team]} {number}"


def reach(model: RobotModel) -> float:
    """Return the distance from a robot's center to its farthest point, m.

    Args:
        model: the robot.
    """
    if model.drive == "differential":
        return model.side_length / math.sqrt(2.0)
    return model.radius


def _drive(connection: Connection, slot: int, asked: tuple[float, float, float]) -> Recording:
    """Drive for some time, stand, and record."""
    config = connection.config
    commands = np.zeros((config.n_robots, len(config.command_columns)), np.float32)
    CommandRow(config.robots[slot], commands[slot]).drive(*(way / SECONDS for way in asked))
    times: list[float] = [connection.sight.clock.now]
    rows: list[Floats] = [_read(connection)]
    sent: list[tuple[float, Floats]] = []

    def note(time: float, given: Floats) -> None:
        sent.append((time, given.copy()))

    connection.on_sent.append(note)
    try:
        begun = connection.sight.clock.now
        for given, end in ((commands, SECONDS), (np.zeros_like(commands), SECONDS + REST)):
            while (now := connection.sight.clock.now) < begun + end:
                # A frame later than now: that of the next image.
                connection.advance(given, math.nextafter(now, math.inf))
                times.append(connection.sight.clock.now)
                rows.append(_read(connection))
    finally:
        connection.on_sent.remove(note)
    return Recording(np.array(times), np.concatenate(rows), tuple(sent))


def _seen(recording: Recording, slot: int) -> tuple[float, float, float]:
    """Ways forward and left, and the angle, from the first to the last row."""
    poses: Doubles = np.array([_place(row[None], slot) for row in recording.rows], np.float64)
    (x, y, cos, sin), last = poses[0], poses[-1]
    d_x, d_y = last[0] - x, last[1] - y
    angles = np.unwrap(np.arctan2(poses[:, 3], poses[:, 2]))
    turned = float(angles[-1] - angles[0])
    return float(cos * d_x + sin * d_y), float(cos * d_y - sin * d_x), turned


def describe(connection: Connection, found: CheckedRobot, slot: int) -> str:
    """Return a text for people.

    Args:
        connection: the connection.
        found: what the check found.
        slot: index of the robot in a state row.
    """
    layout = connection.layout
    team, number = layout.identity(slot)
    color = TEAM_NAMES[team]
    side = "-x" if layout.sign > 0 else "+x"
    x, y = layout.rotated(np.array(found.position)).tolist()
    lines = [
        f"{color} {number} is at ({x:.2f}, {y:.2f}) m on the wire; its own goal is at {side} there",
        "",
        f"{'movement':<12}{'asked: forward, left, turn':<28}{'seen':<28}verdict",
    ]
    for movement in found.movements:
        asked, seen = (
            "{:5.2f} m {:5.2f} m {:5.2f} rad".format(*values)
            for values in (movement.asked, movement.seen)
        )
        lines.append(f"{movement.name:<12}{asked:<28}{seen:<28}{movement.verdict}")
    if found.delay is None:
        lines += ["", "delay: not measured, because the robot does not drive as commanded"]
    else:
        lines += ["", f"delay: {1000 * found.delay:.0f} ms, with {found.gain:.2f} of the speed"]
        lines += [f"use --delay {found.delay:g}"]
    if not found.is_right:
        lines += ["", "do not let a policy drive before all movements are right"]
    return "\n".join(lines)
