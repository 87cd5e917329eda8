"""Free balls of VSSS matches: the ball that is stuck, and the positions of the restart.

Rule: a referee calls a free ball when the ball is stuck for 10 s. The ball is placed at the mark
of its quarter of the field, and one robot of each team beside it along x, on its own side. The
other robots stand outside that quarter. All bodies are at rest.

Sources: FIRA laws, "Free-Ball" (10 s, quarter, other robots), from which the rules of the IEEE
VSSS league derive; VSSReferee, the league's automatic referee of 2021-22, for marks and distances
(replacer.cpp). It judges otherwise in two points: it counts 5 s with the ball at 0.1 m/s or slower,
and in a goal area it calls a goal kick or a penalty, which these tasks do not have.
"""

from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import SimConfig
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import NO_CROSSING, Frame
from rsoccer.game import EventKind
from rsoccer.play import Play
from rsoccer.rules import free_places
from rsoccer.rules.base import Restart, Rule

STUCK_SECONDS: Final = 10.0
"""Time after which a stuck ball leads to a free ball, s: FIRA laws."""
STUCK_DISTANCE: Final = 0.1
"""Distance from its place that a stuck ball does not leave, m.

The laws leave the judgment to the referee. A ball that robots squeeze moves to and fro by some
centimeters, and robots that push it by less than this in 10 s, little more than their own length,
make no progress. Measured over 100 matches between two learned teams: 77 free balls with 0.03 m, 81
with 0.1 m, 84 with 0.2 m. Between two scripted teams, whose crowds drift: 0, 28 and 53.
"""
LARGE_FIELD_LENGTH: Final = 2.2
"""Length of the field for five a side, m: robots stand farther from the ball there."""
GRID_SPACING: Final = 0.05
"""Distance between candidate positions of robots that leave the quarter, m."""
MARGIN: Final = 1e-3
"""Free space around a placed robot, m, for differences in rounding."""


class FreeBalls(Rule):
    """A ball that is stuck leads to a free ball at the mark of its quarter."""

    def __init__(self, config: SimConfig) -> None:
        """Prepare the rule.

        Args:
            config: field, ball and robots.

        Raises:
            ValueError: the robots do not fit between the mark and the walls.
        """
        field = config.field
        large = field.length >= LARGE_FIELD_LENGTH - MARGIN
        self.config = config
        self.mark = np.array([field.free_ball_x, field.free_ball_y], np.float32)
        """(2,) mark in the quarter where x and y are positive, m."""
        self.robot_distance = 0.30 if large else 0.20
        """Distance along x between the ball and the robots beside it, m."""
        self._radius = max(robot.bounding_radius for robot in config.robots)
        self._limit = round(STUCK_SECONDS / config.time_step)
        x, y = self.mark
        gaps = (
            x - self.robot_distance,
            field.half_length - x - self.robot_distance,
            field.half_width - y,
            y,
        )
        if min(gaps) < self._radius or self.robot_distance < self._radius + config.ball.radius:
            raise ValueError(
                f"free_ball: expected False for robots of radius {self._radius:.3f} m in a field "
                f"of {field.length:g} x {field.width:g} m, got True"
            )

    def columns(self, n: int) -> dict[str, Array]:
        """Create the state of stuck balls.

        Args:
            n: number of worlds.

        Returns:
            `stuck_at` (n, 2), place of the ball since which it is stuck, m; `stuck_steps` (n,),
            control steps since then; `free_balls` (n,), free balls of the episode.
        """
        counts = np.zeros((2, n), np.int64)
        return {
            "stuck_at": np.zeros((n, 2), np.float32),
            "stuck_steps": counts[0],
            "free_balls": counts[1],
        }

    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        """Begin the time of stuck balls."""
        play.game.stuck_at[worlds] = play.frame.ball.position[worlds]
        play.game.stuck_steps[worlds] = 0

    def judge(self, play: Play) -> Restart | None:
        """Count the time of stuck balls, and place the bodies for free balls."""
        worlds = np.flatnonzero(self._stuck(play))
        if not len(worlds):
            return None
        play.game.free_balls[worlds] += 1
        before = play.frame.take(worlds)
        play.events.add(worlds, EventKind.NO_PROGRESS_IN_GAME, position=before.ball.position)
        return Restart(worlds, rows=self._restarted(before).rows)

    def _stuck(self, play: Play) -> Mask:
        """(n,) worlds whose ball has been stuck for the time of the rule."""
        ball, place, steps = play.frame.ball, play.game.stuck_at, play.game.stuck_steps
        offset = ball.position - place
        squared = offset[:, 0] * offset[:, 0] + offset[:, 1] * offset[:, 1]
        left = squared > np.float32(STUCK_DISTANCE * STUCK_DISTANCE)
        np.copyto(place, ball.position, where=left[:, None])
        steps += 1
        np.copyto(steps, 0, where=left)
        stuck = steps >= self._limit
        if np.count_nonzero(stuck):  # in few steps
            stuck &= ball.crossed == NO_CROSSING  # a ball may creep over the goal line
        return stuck

    def _restarted(self, frame: Frame) -> Frame:
        """States at rest, of k worlds, with the ball at the mark of its quarter."""
        new = Frame.empty(len(frame), frame.n_blue, frame.n_yellow)
        new.robots.heading[:] = frame.robots.heading
        new.robots.absent[:] = frame.robots.absent
        for world in range(len(frame)):
            ball, robots = frame.ball.position[world], frame.robots.position[world]
            present = frame.robots.absent[world] == 0.0
            quarter = np.copysign(np.float32(1.0), ball)
            takers = self._takers(ball, robots, present)
            # Within the loop all positions are mirrored into the quarter of positive x and y, so
            # that the choice between equal positions is symmetric between the teams.
            placed = robots * quarter
            new.ball.position[world] = self.mark * quarter
            for robot, side in takers.items():
                shift = np.array([side * quarter[0] * self.robot_distance, 0.0], np.float32)
                placed[robot] = self.mark + shift
                new.robots.heading[world, robot] = (-side, 0.0)
            self._clear_quarter(placed, ball * quarter, list(takers), present)
            new.robots.position[world] = placed * quarter
        return new

    def _takers(self, ball: Floats, robots: Floats, present: Mask) -> dict[int, float]:
        """The robot of each team nearest to the ball, with the sign of its own side along x."""
        squared = np.where(present, ((robots - ball) ** 2).sum(axis=1), np.inf)
        teams = (slice(None, self.config.n_blue), -1.0), (slice(self.config.n_blue, None), 1.0)
        indices = np.arange(len(robots))
        return {
            int(indices[team][np.argmin(squared[team])]): side
            for team, side in teams
            if present[team].any()
        }

    def _clear_quarter(
        self, placed: Floats, ball: Floats, takers: list[int], present: Mask
    ) -> None:
        """Move robots (robots, 2), changed in place, out of the quarter of positive x and y.

        A robot outside keeps its place. Those inside move to the nearest free place outside, the
        one nearest to the ball first.
        """
        settled = list(takers)
        squared = ((placed - ball) ** 2).sum(axis=1)
        leaving = []
        for robot in np.argsort(squared, kind="stable").tolist():
            if robot in takers or not present[robot]:
                continue
            inside = bool((placed[robot] > 0.0).all())
            if inside or not self._is_free(placed[robot : robot + 1], placed[takers])[0]:
                leaving.append(robot)
            else:
                settled.append(robot)
        for robot in leaving:
            free = self._is_free(self._grid, placed[settled])
            placed[robot] = free_places.nearest(self._grid, free, placed[robot])
            settled.append(robot)

    def _is_free(self, positions: Floats, robots: Floats) -> Mask:
        """(m,) whether robots at positions (m, 2) would be clear of robots (r, 2)."""
        return free_places.is_free(positions, robots, 2.0 * self._radius + MARGIN)

    @cached_property
    def _grid(self) -> Floats:
        """(m, 2) positions of robots outside the quarter of positive x and y, m."""
        field, radius = self.config.field, self._radius + MARGIN
        grid = free_places.grid(field.half_length - radius, field.half_width - radius, GRID_SPACING)
        outside = (grid <= -radius).any(axis=1)
        # The face of a corner block is the line |x| + |y| = const at 45 degrees.
        diagonal = field.half_length + field.half_width - field.corner_leg - 2.0**0.5 * radius
        free: Floats = grid[outside & (np.abs(grid).sum(axis=1) <= diagonal)]
        return free
