"""`SSLSelfPlay-v0`: a match of two SSL teams without a referee."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import EventKind
from rsoccer.rng import WorldRng
from rsoccer.rules import BallOut, Crossings, Possession, Rule
from rsoccer.task import Play
from rsoccer.tasks.ssl import Ssl
from rsoccer.view import SIDES

MIN_START_DISTANCE: Final = 0.3
"""Least distance between centers in the initial state, m."""
MIN_PASS_LENGTH: Final = 0.5
"""Least length of a pass, m: more than two robots side by side."""


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
    ball_to_goal  progress of the ball toward the attacked goal and away from the     m
                  own goal, for each team's robot nearest to the ball
    approach      decrease of the distance between the ball and the mouth, for the    m
                  same robots
    energy        negative mean magnitude of the action                               steps
    passes        1 for a pass of the robot's team that arrives; its default weight   passes
                  is 0
    ============  ==================================================================  ========

    Termination: a goal of either team. Truncation: after `max_steps`.

    Metrics: `goal_score`, 1 if blue scored, -1 if yellow scored, else 0; `blue_passes`, passes from
    a robot of blue to a teammate's mouth over at least 0.5 m; `yellow_passes`, those of yellow;
    `blue_possession`, share of the time after the first touch in which blue touched the ball last;
    `yellow_possession`, that of yellow; `blue_interceptions`, balls of yellow that a robot of blue
    caught after at least 0.5 m; `yellow_interceptions`, those of yellow.

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

    @cached_property
    def rules(self) -> Sequence[Rule]:
        """Goals count, a ball that leaves the field is repositioned, possession is counted."""
        return Crossings(), BallOut(self.config), Possession(MIN_PASS_LENGTH)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Compute the reward terms of the class's table; a goal terminates."""
        nearest = rewards.nearest_to_ball(play)
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * nearest,
            "approach": rewards.approach_mouth(play, self.config) * nearest,
            "energy": rewards.energy(play),
            "passes": self._passes(play),
        }
        return rewards.weighted_terms(terms, self.term_weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute the metrics of the class's documentation, each (n,)."""
        game = play.game
        with_ball = np.maximum(game.possession_steps.sum(axis=1, keepdims=True), 1)
        of_teams = {
            "passes": game.passes,
            "possession": game.possession_steps / with_ball,
            "interceptions": game.interceptions,
        }
        counted = {
            f"{side}_{name}": values[:, team].astype(np.float32)
            for name, values in of_teams.items()
            for team, side in enumerate(SIDES)
        }
        return {"goal_score": rewards.goal_score(play), **counted}

    def _passes(self, play: Play) -> Floats:
        """Passes of each observer's team that arrived in the last step, (n, observers)."""
        arrived = play.events.by_team(EventKind.PASS).astype(np.float32)
        return arrived[:, play.viewpoint.teams]
