"""Changes of a state that messages ask for: bodies that are put somewhere else."""

from __future__ import annotations

import numpy as np

from rsoccer._core import MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.protocols.errors import Code, MessageError, Problem, Problems
from rsoccer.protocols.layout import TEAM_NAMES, WireLayout
from rsoccer.spawn import set_rolling_spin


class Placement:
    """A state while messages change it: what moved, and what was not honored.

    Attributes:
        frame: frame of one world, a copy of the state.
        ball: whether the ball is put somewhere.
        robots: (robots,) robots that are put somewhere, taken off the field or put on it.
        safely: whether bodies may be moved out of each other, instead of an error.
    """

    def __init__(self, layout: WireLayout, frame: Frame, world: int = 0) -> None:
        """Begin with a state.

        Args:
            layout: the match.
            frame: states.
            world: index of the world.

        Raises:
            ValueError: a frame of other teams, or no such world.
        """
        layout.check_frame(frame, world)
        self._layout = layout
        self.frame = frame.take(np.array([world]))
        self.ball = False
        self.robots: Mask = np.zeros(layout.config.n_robots, np.bool_)
        self.safely = False
        self._problems = Problems()
        self._named: set[int] = set()

    @property
    def row(self) -> Floats:
        """(row,) the state."""
        row: Floats = self.frame.rows[0]
        return row

    @property
    def problems(self) -> list[Problem]:
        """Parts of messages that are not honored: the first ones, and the number of the others."""
        return self._problems.listed()

    def add(self, error: MessageError) -> None:
        """List a part of a message that is not honored.

        Args:
            error: the reason.
        """
        self._problems.add(error)

    def slot(self, team: int, robot_id: int) -> int:
        """Return the index in a state row of a robot that a message names, once.

        Args:
            team: `BLUE` or `YELLOW`, on the wire.
            robot_id: uniform number.

        Raises:
            MessageError: the team has no robot of this number, or the message has named it before.
        """
        slot = self._layout.slot(team, robot_id)
        if slot in self._named:
            name = f"{TEAM_NAMES[team]} robot {robot_id}"
            raise MessageError(Code.DUPLICATE_ROBOT, f"id: expected {name} once, got it twice")
        self._named.add(slot)
        return slot

    def put_ball(
        self,
        position: tuple[float | None, float | None, float | None],
        velocity: tuple[float | None, float | None, float | None],
        *,
        roll: bool = False,
    ) -> None:
        """Put the ball somewhere; its spin becomes 0, or that of rolling.

        Args:
            position: x, y and height of the lowest point on the wire, m; None leaves a number.
            velocity: along x, y and upward on the wire, m/s; None leaves a number.
            roll: whether the ball rolls, instead of sliding.

        Raises:
            MessageError: a number out of range. Nothing has changed.
        """
        sign, ball = self._layout.sign, self.frame.ball
        x, y = ball.position[0] * sign
        v_x, v_y = ball.velocity[0] * sign
        now = np.array([x, y, ball.height[0], v_x, v_y, ball.vertical_velocity[0]], np.float64)
        for place, value in enumerate((*position, *velocity)):
            if value is not None:
                now[place] = value
        self._check_place("ball", now[0], now[1])
        _check("ball: height", now[2], 0.0, MAX_PLACED_HEIGHT)
        _check("ball: speed", float(np.linalg.norm(now[3:])), 0.0, MAX_PLACED_SPEED)
        ball.position[0], ball.height[0] = now[:2] * sign, now[2]
        ball.velocity[0], ball.vertical_velocity[0] = now[3:5] * sign, now[5]
        ball.spin[0] = 0.0
        if roll:
            set_rolling_spin(ball, self._layout.config.ball)
        self.ball = True

    def put_robot(
        self,
        slot: int,
        position: tuple[float | None, float | None],
        angle: float | None,
        velocity: tuple[float, float, float] = (0.0, 0.0, 0.0),
        present: bool | None = None,
    ) -> None:
        """Put a robot somewhere, take it off the field or put it on the field.

        Args:
            slot: index of the robot in the row.
            position: x and y on the wire, m; None leaves a number.
            angle: direction on the wire, rad; None leaves it.
            velocity: along x and y on the wire, m/s, and angular velocity, rad/s.
            present: whether it is on the field; None leaves that, and puts an absent robot that
                has a place on the field.

        Raises:
            MessageError: a number out of range, or a robot that enters without a place. Nothing has
                changed.
        """
        robots, layout = self.frame.robots, self._layout
        if present is False:
            robots.absent[0, slot] = 1.0
            robots.velocity[0, slot] = robots.angular_velocity[0, slot] = 0.0
            self.robots[slot] = True
            return
        absent = robots.absent[0, slot] > 0
        if absent and None in position:
            raise MessageError(
                Code.INCOMPLETE, "robot: expected x and y for a robot that enters, got fewer"
            )
        now = robots.position[0, slot].astype(np.float64) * layout.sign
        for place, value in enumerate(position):
            if value is not None:
                now[place] = value
        self._check_place("robot", now[0], now[1])
        _check("robot: speed", float(np.hypot(*velocity[:2])), 0.0, MAX_PLACED_SPEED)
        limit = MAX_PLACED_ANGULAR_VELOCITY
        _check("robot: angular velocity", velocity[2], -limit, limit)
        robots.position[0, slot] = now * layout.sign
        if angle is not None or absent:
            robots.heading[0, slot] = layout.heading_from_wire(angle or 0.0)
        robots.velocity[0, slot] = layout.rotated(np.array(velocity[:2]))
        robots.angular_velocity[0, slot] = velocity[2]
        robots.absent[0, slot] = 0.0
        self.robots[slot] = True

    def _check_place(self, name: str, x: float, y: float) -> None:
        field = self._layout.config.field
        _check(f"{name}: x", x, -field.max_x, field.max_x)
        _check(f"{name}: y", y, -field.max_y, field.max_y)


def _check(name: str, value: float, low: float, high: float) -> None:
    if not low <= value <= high:
        raise MessageError(
            Code.OUT_OF_RANGE, f"{name}: expected {low:g} to {high:g}, got {value:g}"
        )
