"""The VSSS pitch for scripts: where robots fit, where the ball rolls, and where to push it."""

from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.frame import BallColumns, Floats, Mask, length
from rsoccer.policies.vectors import TINY, inverse
from rsoccer.policies.vss.driving import Place, room_to_turn

WALL: Final = np.float32(0.03)  # metres between ball and wall in which no robot fits
REBOUND: Final = np.float32(0.5)  # share of its way into a wall by which the ball comes back
FREE: Final = np.float32(0.45)  # metres from the own goal from where on the ball may go anywhere
OUTWARD: Final = np.float32(0.2)  # metres from it up to where the ball is to go straight away


class Pitch:
    """Field, ball and robot of a task, in the view of a side that attacks +x."""

    def __init__(self, config: SimConfig) -> None:
        """Learn their sizes."""
        field, ball, clear = config.field, config.ball, room_to_turn(config.robot)
        self.half_length = np.float32(field.half_length)
        self.half_width = np.float32(field.half_width)
        self.half_mouth = np.float32(field.goal_width / 2)
        self.touch = np.float32(config.robot.bounding_radius + ball.radius)
        """Metres between robot and ball at which the robot's corners touch it."""
        self._ball_x = np.float32(field.half_length - ball.radius)
        self._ball_y = np.float32(field.half_width - ball.radius)
        self._rolling = np.maximum(np.float32(ball.rolling_deceleration), TINY)
        self._wall = np.float32(ball.radius + WALL)
        self._most_x = np.float32(field.half_length - clear)
        self._most_y = np.float32(field.half_width - clear)
        self._deep_x = np.float32(field.half_length + field.goal_depth - clear)
        self._mouth_y = np.float32(field.goal_width / 2 - clear)

    def inside(self, x: Floats, y: Floats) -> Place:
        """The nearest places at which a robot can turn on the spot; the goals are among them."""
        most_x = np.where(np.abs(y) < self._mouth_y, self._deep_x, self._most_x)
        x = np.minimum(np.maximum(x, -most_x), most_x)
        return x, np.minimum(np.maximum(y, -self._most_y), self._most_y)

    def outside(self, x: Floats, y: Floats) -> Floats:
        """Metres, along x and y together, by which a robot does not fit at places."""
        in_x, in_y = self.inside(x, y)
        over: Floats = np.abs(in_x - x) + np.abs(in_y - y)
        return over

    def walls(self, x: Floats, y: Floats) -> tuple[Mask, Mask]:
        """Whether no robot fits between a ball at x, y and a side wall, and an end wall."""
        side: Mask = self.half_width - np.abs(y) < self._wall
        end: Mask = self.half_length - np.abs(x) < self._wall
        return side, end & (np.abs(y) > self.half_mouth)

    def rolled(self, ball: BallColumns, seconds: Floats | np.float32) -> Place:
        """Where the ball will be, slowing down and coming back from walls."""
        x, y = ball.position[..., 0], ball.position[..., 1]
        v_x, v_y = ball.velocity[..., 0], ball.velocity[..., 1]
        speed = length(v_x, v_y)
        seconds = np.minimum(seconds, speed / self._rolling)
        slowing = np.float32(0.5) * self._rolling * seconds * seconds * inverse(speed, TINY)
        seconds = seconds - slowing  # at its present speed
        return _rebounding(x + v_x * seconds, self._ball_x), self.rebounding_y(y + v_y * seconds)

    def rebounding_y(self, y: Floats) -> Floats:
        """Metres along y at which a ball is that would be at `y` if there were no walls."""
        return _rebounding(y, self._ball_y)

    def course(self, x: Floats, y: Floats) -> Place:
        """Where to push a ball at x, y, a direction: at the goal, but off the own, along walls."""
        side, end = self.walls(x, y)
        at_x, at_y = unit(self.half_length - x, -y)
        off_x, off_y = x + self.half_length, y
        far = length(off_x, off_y)
        share = np.minimum(np.maximum((FREE - far) / (FREE - OUTWARD), 0.0), np.float32(1.0))
        off_x, off_y = unit(off_x, off_y)
        at_x, at_y = at_x + share * (off_x - at_x), at_y + share * (off_y - at_y)
        # Along an end wall it goes to the opponents' goal, but away from the own.
        along_end = np.copysign(np.float32(1.0), -y * x)
        at_x = np.where(side, np.float32(1.0), np.where(end, np.float32(0.0), at_x))
        at_y = np.where(side, np.float32(0.0), np.where(end, along_end, at_y))
        return unit(at_x, at_y)


def unit(x: Floats, y: Floats) -> Place:
    """Directions of vectors; zeros stay zeros."""
    per = inverse(length(x, y), TINY)
    return x * per, y * per


def _rebounding(place: Floats, most: np.float32) -> Floats:
    over = np.abs(place) - most
    back = np.copysign(most - REBOUND * over, place)
    within: Floats = np.where(over > 0.0, back, place)
    return within
