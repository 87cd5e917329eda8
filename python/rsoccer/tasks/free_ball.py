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
from rsoccer.frame import Frame
from rsoccer.play import Play

STUCK_SECONDS: Final = 10.0
"""Time after which a stuck ball leads to a free ball, s: FIRA laws."""
STUCK_DISTANCE: Final = 0.1
"""Distance from its place that a stuck ball does not leave, m.

The laws leave the judgement to the referee. A ball that robots squeeze moves to and fro by some
centimetres, and robots that push it by less than this in 10 s, little more than their own length,
make no progress. Measured over 100 matches between two learned teams: 77 free balls with 0.03 m, 81
with 0.1 m, 84 with 0.2 m. Between two scripted teams, whose crowds drift: 0, 28 and 53.
"""
LARGE_FIELD_LENGTH: Final = 2.2
"""Length of the field for five a side, m. Shorter fields have the marks of three a side."""
GRID_SPACING: Final = 0.05
"""Distance between candidate positions of robots that leave the quarter, m."""
MARGIN: Final = 1e-3
"""Free space around a placed robot, m, for differences in rounding."""


class FreeBalls:
    """The rule for one configuration: memory of stuck balls, and states after a free ball."""

    def __init__(self, config: SimConfig) -> None:
        """Compute the marks.

        Args:
            config: field, ball and robots.

        Raises:
            ValueError: the robots do not fit between the mark and the walls.
        """
        field = config.field
        large = field.length >= LARGE_FIELD_LENGTH - MARGIN
        self.config = config
        self.mark = np.array(
            [field.half_length / 2.0, field.half_width - (0.30 if large else 0.25)], np.float32
        )
        """(2,) mark in the quarter where x and y are positive, m."""
        self.robot_distance = 0.30 if large else 0.20
        """Distance along x between the ball and the robots beside it, m."""
        self._radius = max(robot.bounding_radius for robot in config.robots)
        self._limit = round(STUCK_SECONDS / config.time_step)
        x, y = self.mark
        gaps = (x - self.robot_distance, field.half_length - x - self.robot_distance, y)
        if min(gaps) < self._radius or self.robot_distance < self._radius + config.ball.radius:
            raise ValueError(
                f"free_ball: expected False for robots of radius {self._radius:.3f} m in a field "
                f"of {field.length:g} x {field.width:g} m, got True"
            )

    def new_memory(self, n: int) -> dict[str, Array]:
        """Return memory at the start of episodes.

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

    def start_episode(self, play: Play) -> None:
        """Begin the time at the initial state.

        Args:
            play: initial state of n worlds; its memory is changed.
        """
        play.memory["stuck_at"][:] = play.frame.ball.position

    def restart(self, play: Play) -> tuple[NDArray[np.intp], Floats] | None:
        """Update the memory after a step, and return the states of free balls.

        Args:
            play: state of n worlds after the step; its memory is changed.

        Returns:
            (k,) indices of the worlds with a free ball, and (k, row) their new states; None for
            no world.
        """
        worlds = np.flatnonzero(self._stuck(play))
        if not len(worlds):
            return None
        frame = self._restarted(play.frame.take(worlds))
        play.memory["free_balls"][worlds] += 1
        play.memory["stuck_steps"][worlds] = 0
        play.memory["stuck_at"][worlds] = frame.ball.position
        return worlds, frame.rows

    def _stuck(self, play: Play) -> Mask:
        """(n,) worlds whose ball has been stuck for the time of the rule."""
        ball, memory = play.frame.ball, play.memory
        place, steps = memory["stuck_at"], memory["stuck_steps"]
        offset = ball.position - place
        squared = offset[:, 0] * offset[:, 0] + offset[:, 1] * offset[:, 1]
        left = squared > np.float32(STUCK_DISTANCE * STUCK_DISTANCE)
        place[left] = ball.position[left]
        steps += 1
        steps[left] = 0
        in_play = ball.crossed == 0.0  # a ball may creep over the goal line
        stuck: Mask = (steps >= self._limit) & in_play
        return stuck

    def _restarted(self, frame: Frame) -> Frame:
        """States at rest, of k worlds, with the ball at the mark of its quarter."""
        new = Frame.empty(len(frame), frame.n_blue, frame.n_yellow)
        new.robots.heading[:] = frame.robots.heading
        for world in range(len(frame)):
            ball, robots = frame.ball.position[world], frame.robots.position[world]
            quarter = np.copysign(np.float32(1.0), ball)
            takers = self._takers(ball, robots)
            # Within the loop all positions are mirrored into the quarter of positive x and y, so
            # that the choice between equal positions is symmetric between the teams.
            placed = robots * quarter
            new.ball.position[world] = self.mark * quarter
            for robot, side in takers.items():
                shift = np.array([side * quarter[0] * self.robot_distance, 0.0], np.float32)
                placed[robot] = self.mark + shift
                new.robots.heading[world, robot] = (-side, 0.0)
            self._clear_quarter(placed, ball * quarter, list(takers))
            new.robots.position[world] = placed * quarter
        return new

    def _takers(self, ball: Floats, robots: Floats) -> dict[int, float]:
        """The robot of each team nearest to the ball, with the sign of its own side along x."""
        squared = ((robots - ball) ** 2).sum(axis=1)
        n_blue = self.config.n_blue
        takers = {int(np.argmin(squared[:n_blue])): -1.0}
        if self.config.n_yellow:
            takers[n_blue + int(np.argmin(squared[n_blue:]))] = 1.0
        return takers

    def _clear_quarter(self, placed: Floats, ball: Floats, takers: list[int]) -> None:
        """Move robots (robots, 2), changed in place, out of the quarter of positive x and y.

        A robot outside keeps its place. Those inside move to the nearest free place outside, the
        one nearest to the ball first.
        """
        settled = list(takers)
        squared = ((placed - ball) ** 2).sum(axis=1)
        leaving = []
        for robot in np.argsort(squared, kind="stable").tolist():
            if robot in takers:
                continue
            inside = bool((placed[robot] > 0.0).all())
            if inside or not self._is_free(placed[robot : robot + 1], placed[takers])[0]:
                leaving.append(robot)
            else:
                settled.append(robot)
        for robot in leaving:
            offset = self._grid - placed[robot]
            distance = offset[:, 0] * offset[:, 0] + offset[:, 1] * offset[:, 1]
            distance[~self._is_free(self._grid, placed[settled])] = np.inf
            placed[robot] = self._grid[np.argmin(distance)]
            settled.append(robot)

    def _is_free(self, positions: Floats, robots: Floats) -> Mask:
        """(m,) whether robots at positions (m, 2) would be clear of robots (r, 2)."""
        clearance = np.float32(2.0 * self._radius + MARGIN)
        offset = positions[:, None] - robots
        squared = offset[..., 0] * offset[..., 0] + offset[..., 1] * offset[..., 1]
        free: Mask = np.logical_not((squared < clearance * clearance).any(axis=1))
        return free

    @cached_property
    def _grid(self) -> Floats:
        """(m, 2) positions of robots outside the quarter of positive x and y, m."""
        field, radius = self.config.field, self._radius + MARGIN
        x, y = (
            np.arange(
                int((half - radius) / GRID_SPACING), -int((half - radius) / GRID_SPACING) - 1, -1
            )
            for half in (field.half_length, field.half_width)
        )
        columns = np.repeat(x, len(y)), np.tile(y, len(x))
        grid = np.stack(columns, axis=-1).astype(np.float32) * np.float32(GRID_SPACING)
        outside = (grid <= -radius).any(axis=1)
        # The face of a corner block is the line |x| + |y| = const at 45 degrees.
        diagonal = field.half_length + field.half_width - field.corner_leg - 2.0**0.5 * radius
        free: Floats = grid[outside & (np.abs(grid).sum(axis=1) <= diagonal)]
        return free
