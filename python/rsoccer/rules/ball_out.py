"""The rule of a ball that leaves the field: it is repositioned, and play goes on."""

from functools import cached_property
from typing import Final

import numpy as np

from rsoccer._core import SimConfig
from rsoccer.arrays import Floats
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, NO_CROSSING, BallColumns
from rsoccer.play import Play
from rsoccer.rules import free_places
from rsoccer.rules.base import Restart, Rule

LINE_DISTANCE: Final = 0.2
"""Distance from the line at which a ball that left the field is repositioned, m: SSL rules."""
GRID_SPACING: Final = 0.05
"""Distance between candidate positions of the ball, m."""
LINE_CANDIDATES: Final = 60
"""Number of candidate positions along the line."""


class BallOut(Rule):
    """A ball that leaves the field, other than into a goal, is repositioned at rest.

    Its place is `LINE_DISTANCE` inside the line, at the nearest position along the line that is
    free of robots, or the nearest free position of the field. The robots keep their state.
    """

    def __init__(self, config: SimConfig) -> None:
        """Prepare the rule.

        Args:
            config: field, ball and robots.
        """
        self.config = config

    def judge(self, play: Play) -> Restart | None:
        """Choose positions inside the line, free of robots, for balls that left the field."""
        frame = play.frame
        crossed = frame.ball.crossed
        if not np.count_nonzero(crossed):  # in most steps
            return None
        worlds = np.flatnonzero(
            (crossed != NO_CROSSING) & (crossed != GOAL_RIGHT) & (crossed != GOAL_LEFT)
        )
        if not len(worlds):
            return None
        left_at = frame.ball.crossed_at[worlds]
        ball = BallColumns(np.zeros_like(frame.ball.data[worlds]))
        ball.position[:] = self.free_positions(left_at, frame.robots.position[worlds])
        return Restart(worlds, balls=ball.data)

    def free_positions(self, left_at: Floats, robots: Floats) -> Floats:
        """Return the nearest free positions for balls that left the field.

        Args:
            left_at: (k, 2) where the balls crossed the line, m.
            robots: (k, robots, 2) positions of the robots, m.

        Returns:
            (k, 2) positions, m.
        """
        candidates = self._line_candidates(left_at)
        free = free_places.is_free(candidates, robots, self.clearance)
        first = np.argmax(free, axis=1)  # the nearest free one
        positions: Floats = candidates[np.arange(len(candidates)), first]
        for world in np.flatnonzero(~free.any(axis=1)):
            positions[world] = self._free_grid_position(left_at[world], robots[world])
        return positions

    @cached_property
    def clearance(self) -> float:
        """Least distance from the ball to the center of a robot, m."""
        radius = max(robot.bounding_radius for robot in self.config.robots)
        return radius + 2.0 * self.config.ball.radius

    @cached_property
    def grid(self) -> Floats:
        """(m, 2) grid positions over the field, m: more than all robots together can cover."""
        max_x, max_y = self._max_position
        return free_places.grid(max_x, max_y, GRID_SPACING)

    def _line_candidates(self, left_at: Floats) -> Floats:
        """(k, LINE_CANDIDATES, 2) positions along the crossed line, in both directions.

        They are in order of distance. Of two at the same distance, the one nearer to the middle of
        the line is first, so the choice is symmetric between the teams.
        """
        indices = np.arange(LINE_CANDIDATES)
        steps = indices // 2 + indices % 2
        shifts = (np.where(indices % 2, -1, 1) * steps).astype(np.float32)
        along_x = np.abs(left_at[:, 1]) > np.float32(self.config.field.half_width - 1e-3)
        outward = np.copysign(np.float32(GRID_SPACING), left_at)[:, None] * shifts[None, :, None]
        axis = np.stack([along_x, ~along_x], axis=-1)[:, None]
        return self._clip_inside(left_at[:, None] + np.where(axis, outward, np.float32(0.0)))

    def _free_grid_position(self, left_at: Floats, robots: Floats) -> Floats:
        """Free grid position (2,) nearest to (2,), with robots at (robots, 2)."""
        # The grid starts at the corner nearest to the ball, so that of two positions at the same
        # distance the choice is symmetric between the teams.
        positions = self.grid * np.copysign(np.float32(1.0), left_at)
        free = free_places.is_free(positions, robots, self.clearance)
        return free_places.nearest(positions, free, self._clip_inside(left_at))

    def _clip_inside(self, positions: Floats) -> Floats:
        """Positions (..., 2) clipped to `LINE_DISTANCE` inside the lines of the field."""
        inside: Floats = np.minimum(np.maximum(positions, -self._max_position), self._max_position)
        return inside

    @cached_property
    def _max_position(self) -> Floats:
        """(2,) greatest x and y of a ball that is repositioned, m."""
        field = self.config.field
        half = np.array([field.half_length, field.half_width], np.float32)
        return half - np.float32(LINE_DISTANCE)
