"""Geometry of the VSSS field for scripts: walls, goals, ball prediction, push directions."""

from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import BallColumns
from rsoccer.policies.rolling import RollingLaw
from rsoccer.policies.vss.drive_control import turning_clearance
from rsoccer.vectors import TINY, XY, norm, reciprocal, unit

WALL_GAP: Final = np.float32(0.03)  # m between ball and wall in which no robot fits
REBOUND: Final = np.float32(0.5)  # share of its path into a wall by which the ball comes back
# Distances of the ball from the own goal, m: beyond FREE it may go in any direction, below
# CLEARING it is pushed straight away from the goal, and between them the two are blended.
FREE: Final = np.float32(0.45)
CLEARING: Final = np.float32(0.2)


class FieldGeometry:
    """Field, ball and robot of a task, in the view of a team that attacks +x. Meters."""

    def __init__(self, config: SimConfig) -> None:
        """Read the dimensions.

        Args:
            config: configuration of the task.
        """
        field, ball, clearance = config.field, config.ball, turning_clearance(config.robot)
        self.half_length = np.float32(field.half_length)
        """From the center to a goal line."""
        self.half_width = np.float32(field.half_width)
        """From the center to a side wall."""
        self.half_mouth = np.float32(field.goal_width / 2)
        """Half the width of a goal."""
        self.contact_distance = np.float32(config.robot.bounding_radius + ball.radius)
        """Distance of robot and ball at which the robot's corners touch the ball."""
        self.max_x = np.float32(field.half_length - clearance)
        """Largest x, outside the goals, at which a robot can turn on the spot."""
        self.max_y = np.float32(field.half_width - clearance)
        """Largest y at which a robot can turn on the spot."""
        self._ball_x = np.float32(field.half_length - ball.radius)
        self._ball_y = np.float32(field.half_width - ball.radius)
        self._rolling = RollingLaw(ball)
        self._wall_distance = np.float32(ball.radius + WALL_GAP)
        self._goal_max_x = np.float32(field.half_length + field.goal_depth - clearance)
        self._goal_max_y = np.float32(field.goal_width / 2 - clearance)

    def clamp(self, x: Floats, y: Floats) -> XY:
        """Return the nearest positions at which a robot can turn on the spot.

        Args:
            x: (n, robots) m.
            y: (n, robots) m.

        Returns:
            x and y on the field or in a goal.
        """
        max_x = np.where(np.abs(y) < self._goal_max_y, self._goal_max_x, self.max_x)
        x = np.minimum(np.maximum(x, -max_x), max_x)
        return x, np.minimum(np.maximum(y, -self.max_y), self.max_y)

    def clamp_error(self, x: Floats, y: Floats) -> Floats:
        """Return the distance (m, x and y summed) by which `clamp` moves positions.

        Args:
            x: (n, robots) m.
            y: (n, robots) m.
        """
        clamped_x, clamped_y = self.clamp(x, y)
        error: Floats = np.abs(clamped_x - x) + np.abs(clamped_y - y)
        return error

    def at_walls(self, x: Floats, y: Floats) -> tuple[Mask, Mask]:
        """Test for balls so close to a wall that no robot fits between.

        Args:
            x: (n, robots) position of the ball, m.
            y: (n, robots) position of the ball, m.

        Returns:
            Whether the ball is at a side wall, and whether it is at an end wall beside the goal.
        """
        side: Mask = self.half_width - np.abs(y) < self._wall_distance
        end: Mask = self.half_length - np.abs(x) < self._wall_distance
        return side, end & (np.abs(y) > self.half_mouth)

    def predict_ball(self, ball: BallColumns, seconds: Floats | np.float32) -> XY:
        """Predict the position of the ball, with rolling friction and rebounds from walls.

        Args:
            ball: state of the ball, (n, robots, ...).
            seconds: time ahead, s; one number or (n, robots).

        Returns:
            Predicted x and y, m.
        """
        x, y = ball.position[..., 0], ball.position[..., 1]
        v_x, v_y = ball.velocity[..., 0], ball.velocity[..., 1]
        speed = norm(v_x, v_y)
        seconds, slowing = self._rolling.slowing(speed, seconds)
        slowing = slowing * reciprocal(speed, TINY)
        seconds = seconds - slowing  # time for the same path at the present speed
        return _rebound(x + v_x * seconds, self._ball_x), self.rebound_y(y + v_y * seconds)

    def rebound_y(self, y: Floats) -> Floats:
        """Return y of a ball that rebounds from the side walls.

        Args:
            y: (n, robots) y that the ball would reach without walls, m.
        """
        return _rebound(y, self._ball_y)

    def push_direction(self, x: Floats, y: Floats) -> XY:
        """Return the direction in which to push a ball: at the goal, or along a wall.

        A ball close to the own goal is pushed away from it.

        Args:
            x: (n, robots) position of the ball, m.
            y: (n, robots) position of the ball, m.

        Returns:
            Unit vectors.
        """
        side, end = self.at_walls(x, y)
        push_x, push_y = unit(self.half_length - x, -y)
        away_x, away_y = x + self.half_length, y
        distance = norm(away_x, away_y)
        share = np.minimum(np.maximum((FREE - distance) / (FREE - CLEARING), 0.0), np.float32(1.0))
        away_x, away_y = unit(away_x, away_y)
        push_x, push_y = push_x + share * (away_x - push_x), push_y + share * (away_y - push_y)
        # Along the opponents' end wall toward the goal, along the own one away from it.
        along_end = np.copysign(np.float32(1.0), -y * x)
        push_x = np.where(side, np.float32(1.0), np.where(end, np.float32(0.0), push_x))
        push_y = np.where(side, np.float32(0.0), np.where(end, along_end, push_y))
        return unit(push_x, push_y)


def _rebound(coordinate: Floats, limit: np.float32) -> Floats:
    excess = np.abs(coordinate) - limit
    rebounded = np.copysign(limit - REBOUND * excess, coordinate)
    result: Floats = np.where(excess > 0.0, rebounded, coordinate)
    return result
