"""Base class of the VSSS tasks: options, initial state, wheel commands, rewards and metrics."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer._core import MAX_PLACED_SPEED, Field, RobotModel, SimConfig
from rsoccer.arrays import Floats, Mask
from rsoccer.frame import Frame
from rsoccer.reflection import Reflection
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings, FreeBalls, Rule
from rsoccer.task import Play
from rsoccer.tasks import options
from rsoccer.tasks.soccer import Soccer
from rsoccer.view import SIDES

DISCRETE_ACTIONS: Final = np.array(
    [[1, 1], [-1, -1], [-1, 1], [1, -1], [0.5, 1], [1, 0.5], [-0.5, -1], [-1, -0.5], [0, 0]],
    np.float32,
)
"""(9, 2) left and right wheel: forward, back, turns on the spot, arcs forward and back, stop."""

MIN_START_DISTANCE: Final = 0.1
"""Least distance between centers in the initial state, m."""


@dataclass(frozen=True)
class Vss(Soccer):
    """Base class of the VSSS tasks; subclasses define which robots learn.

    Goal of the task: score in the goal at +x (blue) or -x (yellow).

    Initial state: ball and robots at uniform random positions without overlap, robots with random
    headings and at rest, the ball at rest or with up to `ball_speed`.

    Action of a robot:

    =====  ============================  =====================================  =======
    Index  Meaning                       Value of 1                             Range
    =====  ============================  =====================================  =======
    0      speed of the left wheel       `config.robot.max_wheel_speed`, rad/s  -1 to 1
    1      speed of the right wheel      `config.robot.max_wheel_speed`, rad/s  -1 to 1
    =====  ============================  =====================================  =======

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

    Source: rules of the IEEE VSSS league for field, robots and ball; the idea of the task is from
    Martins et al., "rSoccer: A Framework for Studying Reinforcement Learning in Small and Very
    Small Size Robot Soccer" (2021).

    Raises:
        TypeError: an option of a wrong type.
        ValueError: an option outside its range.
    """

    n_blue: int = 3
    """Robots of team blue, 1 to 5."""
    n_yellow: int = 3
    """Robots of team yellow, 0 to 5."""
    ball_speed: float = 0.0
    """Upper bound of the ball's uniform initial speed, m/s, 0 to 20."""
    robot: str | RobotModel = "vss_440rpm"
    """Robot model with a differential drive: a preset's name, a .json file or a `RobotModel`."""
    discrete: bool = False
    """True: agents choose from `DISCRETE_ACTIONS` instead of giving two wheel speeds."""
    field: str | Field = "vss_3v3"
    """VSSS field: "vss_3v3", "vss_5v5", a .json file or a `Field`, for any team sizes."""
    free_ball: bool = False
    """True: a ball that is stuck for 10 s leads to a free ball at the mark of its quarter."""

    action_size = 2
    """Left and right wheel."""
    DISCRETE_ACTIONS: ClassVar[Floats] = DISCRETE_ACTIONS
    """(9, 2) left and right wheel."""
    ACTION_REFLECTION: ClassVar[Reflection] = Reflection.of([1, 1], order=[1, 0])
    """(2,) the wheels are exchanged."""
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
    success = "goal_score"
    """Metric that measures the success of an episode."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer("n_blue", self.n_blue, 1)
        checks.integer("n_yellow", self.n_yellow, 0)
        super().__post_init__()
        checks.number_in_range("ball_speed", self.ball_speed, 0.0, MAX_PLACED_SPEED)
        options.drive(self.config, "differential", "with a differential drive")
        if self.config.field.touch_line_margin > 0.0:
            raise ValueError(f"field: expected one of VSSS, like 'vss_5v5', got {self.field!r}")
        checks.boolean("free_ball", self.free_ball)
        if self.free_ball:
            FreeBalls(self.config)  # raises for a field without space around the marks

    @property
    def two_sided(self) -> bool:
        """True where both teams have robots, whether they learn or not."""
        return self.n_yellow > 0 and set(SIDES) <= set(self.sides)

    @cached_property
    def config(self) -> SimConfig:
        """Configuration with the field and robots of the options, a golf ball and 25 ms steps."""
        return SimConfig(
            self.field, self.n_blue, self.n_yellow, robot=self.robot, engine=self.engine
        )

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

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions to wheel speeds (n, robots, 2), rad/s."""
        return actions * self._wheel_speed

    @cached_property
    def _wheel_speed(self) -> np.float32:
        """Wheel speed of a full action, rad/s."""
        return np.float32(self.config.robot.max_wheel_speed)

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
