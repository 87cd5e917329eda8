"""`SSLSelfPlay-v0`: a match of two SSL teams without a referee."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks, rewards, spawn
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import BallColumns, Frame
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks import passes
from rsoccer.tasks.ssl import Ssl

MIN_START_DISTANCE: Final = 0.3
"""Least distance between centres in the initial state, m."""
LINE_DISTANCE: Final = 0.2
"""Distance from the line at which a ball that left the field is repositioned, m: SSL rules."""
GRID_SPACING: Final = 0.05
"""Distance between candidate positions of the ball, m."""
LINE_CANDIDATES: Final = 60
"""Number of candidate positions along the line."""


@dataclass(frozen=True)
class SslSelfPlay(Ssl):
    """SSL match without a referee, in which all robots of both teams learn.

    Goal of the task: score in the goal at +x (blue) or -x (yellow).

    Initial state: ball and robots at uniform random positions, at rest, with random headings.

    A ball that leaves the field other than into a goal is repositioned at rest 0.2 m inside the
    line, at the nearest position along the line that is free of robots, or the nearest free
    position of the field. The robots keep their state.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    goal          1 for a goal of the robot's team, -1 for a goal against it          goals
    ball_to_goal  progress of the ball towards the attacked goal and away from the    m
                  own goal, for each team's robot nearest to the ball
    approach      decrease of the distance between the ball and the mouth, for the    m
                  same robots
    energy        negative mean magnitude of the action                               steps
    passes        1 for a pass of the robot's team that arrives; its default weight   passes
                  is 0
    ============  ==================================================================  ========

    Termination: a goal of either team. Truncation: after `max_steps`.

    Metrics: `goal_score`, 1 if blue scored, -1 if yellow scored, else 0; `blue_passes`, passes from
    a robot of blue to a teammate's mouth over at least 0.5 m; `yellow_passes`, those of yellow.

    Source: SSL rules for the position of a ball that left the field. The rSoccer paper has no such
    task, so its weights are the default ones.
    """

    n_blue: int = 3
    """Robots of team blue, 1 to 11."""
    n_yellow: int = 3
    """Robots of team yellow, 0 to 11."""

    success = "goal_score"
    """Metric that measures the success of an episode."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 2.0,
        "approach": 0.5,
        "energy": 0.0002,
        "passes": 0.0,
    }
    """Default weight of each reward term."""
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = REWARD_WEIGHTS
    """The default weights: the paper has no such task."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer("n_blue", self.n_blue, 1)
        checks.integer("n_yellow", self.n_yellow, 0)
        super().__post_init__()

    def team_sizes(self) -> tuple[int, int]:
        """Return the team sizes of the options."""
        return self.n_blue, self.n_yellow

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings."""
        return spawn.random_frame(rng, self.config, MIN_START_DISTANCE)

    def rule_memory(self, n: int) -> dict[str, Array]:
        """Create the memory of passes: see `passes.new_memory`."""
        return passes.new_memory(n)

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        """Choose positions inside the line, free of robots, for balls that left the field."""
        crossed = frame.ball.crossed
        worlds = np.flatnonzero((crossed != 0.0) & (rewards.goal_score(frame.ball) == 0.0))
        if not len(worlds):
            return None
        ball = BallColumns(np.zeros_like(frame.ball.data[worlds]))
        left_at, robots = frame.ball.crossed_at[worlds], frame.robots.position[worlds]
        ball.position[:] = self._free_positions(left_at, robots)
        return worlds, ball.data

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; a goal terminates."""
        nearest = rewards.nearest_to_ball(play)
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * nearest,
            "approach": rewards.approach_mouth(play, self.config) * nearest,
            "energy": rewards.energy(play),
            "passes": passes.count(play)[:, play.viewpoint.teams].astype(np.float32),
        }
        return rewards.weighted_terms(terms, self.term_weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute `goal_score`, `blue_passes` and `yellow_passes`, each (n,)."""
        blue, yellow = play.memory["passes"].T.astype(np.float32)
        return {
            "goal_score": rewards.goal_score(play.frame.ball),
            "blue_passes": blue,
            "yellow_passes": yellow,
        }

    def _free_positions(self, left_at: Floats, robots: Floats) -> Floats:
        """Free positions (k, 2) nearest to (k, 2), with robots at (k, robots, 2)."""
        candidates = self._line_candidates(left_at)
        free = self._is_free(candidates, robots)
        nearest = np.argmax(free, axis=1)  # the first free one
        positions: Floats = candidates[np.arange(len(candidates)), nearest]
        for world in np.flatnonzero(~free.any(axis=1)):
            positions[world] = self._free_grid_position(left_at[world], robots[world])
        return positions

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
        """Free grid position (2,) nearest to (2,), with robots at (robots, 2).

        The grid has more positions than all robots together can cover.
        """
        # The grid starts at the corner nearest to the ball, so that of two positions at the same
        # distance the choice is symmetric between the teams.
        positions = self._grid * np.copysign(np.float32(1.0), left_at)
        offset = positions - self._clip_inside(left_at)
        squared = offset[:, 0] * offset[:, 0] + offset[:, 1] * offset[:, 1]
        squared[~self._is_free(positions[None], robots[None])[0]] = np.inf
        position: Floats = positions[np.argmin(squared)]
        return position

    def _is_free(self, positions: Floats, robots: Floats) -> Mask:
        """(k, m) whether positions (k, m, 2) are free of robots at (k, robots, 2)."""
        clearance = np.float32(self.config.robot.bounding_radius + 2.0 * self.config.ball.radius)
        offset = positions[:, :, None] - robots[:, None]
        squared = offset[..., 0] * offset[..., 0] + offset[..., 1] * offset[..., 1]
        covered = squared < clearance * clearance
        free: Mask = np.logical_not(covered.any(axis=2))
        return free

    def _clip_inside(self, positions: Floats) -> Floats:
        """Positions (..., 2) clipped to `LINE_DISTANCE` inside the lines of the field."""
        inside: Floats = np.minimum(np.maximum(positions, -self._max_position), self._max_position)
        return inside

    @cached_property
    def _max_position(self) -> Floats:
        """(2,) greatest x and y of a repositioned ball, m."""
        return self._half_size - np.float32(LINE_DISTANCE)

    @cached_property
    def _grid(self) -> Floats:
        """(m, 2) grid positions over the field, symmetric about its centre, m."""
        x, y = (
            np.arange(int(high / GRID_SPACING), -int(high / GRID_SPACING) - 1, -1)
            for high in self._max_position
        )
        columns = np.repeat(x, len(y)), np.tile(y, len(x))
        return np.stack(columns, axis=-1).astype(np.float32) * np.float32(GRID_SPACING)
