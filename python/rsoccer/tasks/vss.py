"""Base class of the VSSS tasks that end with a goal: initial state, rewards and metrics."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer._core import MAX_PLACED_SPEED
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, FreeBalls, Rule
from rsoccer.task import Play
from rsoccer.tasks.vss_base import VssBase
from rsoccer.view import SIDES

MIN_START_DISTANCE: Final = 0.1
"""Least distance between centers in the initial state, m."""


@dataclass(frozen=True)
class Vss(VssBase):
    """Base class of the VSSS tasks that end with a goal; subclasses define which robots learn.

    Initial state: ball and robots at uniform random positions without overlap, robots with random
    headings and at rest, the ball at rest or with up to `ball_speed`.

    Actions are those of `VssBase`.

    Reward terms, unweighted:

    ============  ==================================================================  ========
    Term          Meaning                                                             Unit
    ============  ==================================================================  ========
    goal          1 for a goal of the robot's team, -1 for a goal against it          goals
    ball_to_goal  progress of the ball toward the attacked goal and away from the     m
                  own goal, for each team's robot nearest to the ball
    approach      progress of the robot toward the point just behind the ball         m
    energy        negative mean magnitude of the action                               steps
    ============  ==================================================================  ========

    Termination: a goal of either team. Truncation: after `max_steps`.

    Free ball, with the option `free_ball`: a ball that stays within 0.1 m of a place for 10 s is
    placed at the mark of its quarter of the field, (0.375, 0.4) m from the center, and (0.55, 0.6)
    m on a field of at least 2.2 m. The robot of each team nearest to the ball stands beside it
    along x, on its own side, at a distance of 0.2 m, or 0.3 m on that field. Other robots leave the
    quarter, to the nearest free place, and all bodies are at rest. The move is not rewarded. Goal
    kicks and penalties, which the league has in goal areas, are free balls too.

    Metrics: `goal_score`, 1 if blue scored, -1 if yellow scored, else 0; with the option
    `free_ball` also `free_balls`, their number in the episode.

    Raises:
        TypeError: an option of a wrong type.
        ValueError: an option outside its range.
    """

    ball_speed: float = 0.0
    """Upper bound of the ball's uniform initial speed, m/s, 0 to 20."""
    free_ball: bool = False
    """True: a ball that is stuck for 10 s leads to a free ball at the mark of its quarter."""

    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 10.0,
        "approach": 3.0,
        "energy": 0.0002,
    }
    """Default weights: per goal, per meter, per meter, per step at full speed.

    With the policy `chase` against robots at rest, goals are the largest part of the return.
    """
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {
        "goal": 10.0,
        "ball_to_goal": 64.0,
        "approach": 20.0,
        "energy": 0.0184,
    }
    """Weights of the rSoccer paper (2021) in these terms.

    Goals are some 10% of the return there.
    """

    def __post_init__(self) -> None:
        """Validate the options."""
        super().__post_init__()
        checks.number_in_range("ball_speed", self.ball_speed, 0.0, MAX_PLACED_SPEED)
        checks.boolean("free_ball", self.free_ball)
        if self.free_ball:
            FreeBalls(self.config)  # raises for a field without space around the marks

    @property
    def two_sided(self) -> bool:
        """True where both teams have robots, whether they learn or not."""
        return self.n_yellow > 0 and set(SIDES) <= set(self.sides)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw random positions and headings, and a rolling ball where `ball_speed` is above 0."""
        frame = spawn.random_frame(rng, self.config, MIN_START_DISTANCE)
        frame.ball.velocity[:] = spawn.velocities(rng, self.ball_speed)
        spawn.set_rolling_spin(frame.ball, self.config.ball)
        return frame

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """Goals count; with the option `free_ball` a stuck ball leads to a free ball."""
        return (Crossings(), FreeBalls(self.config)) if self.free_ball else (Crossings(),)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; a goal terminates."""
        nearest = rewards.nearest_to_ball(play)
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * nearest,
            "approach": rewards.approach_behind_ball(play, self.config.field),
            "energy": rewards.energy(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute `goal_score` (n,), and `free_balls` (n,) with the rule `FreeBalls`."""
        metrics = {"goal_score": rewards.goal_score(play)}
        if "free_balls" in play.game:
            metrics["free_balls"] = play.game.free_balls.astype(np.float32)
        return metrics
