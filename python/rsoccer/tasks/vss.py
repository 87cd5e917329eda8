"""What all VSSS tasks share: starts, wheels, rewards and the score."""

from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import field as default
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks, rewards, spawn
from rsoccer._core import FASTEST, Field, SimConfig
from rsoccer.frame import Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.soccer import Soccer
from rsoccer.view import SIDES

# Per goal, per metre, per metre, per step at full power. Where the `chase` script plays against
# robots that stand still, goals are the largest part of what an episode pays.
REWARD_WEIGHTS: Final = {"goal": 10.0, "ball_to_goal": 10.0, "approach": 3.0, "energy": 0.0002}

# The mix of the paper's time, in these terms: a goal is some 10% of what an episode pays there.
PAPER_REWARD_WEIGHTS: Final = {
    "goal": 10.0,
    "ball_to_goal": 64.0,
    "approach": 20.0,
    "energy": 0.0184,
}

# Left and right power: forward, back, turns on the spot and in arcs, stop.
CHOICES: Final = np.array(
    [[1, 1], [-1, -1], [-1, 1], [1, -1], [0.5, 1], [1, 0.5], [-0.5, -1], [-1, -0.5], [0, 0]],
    np.float32,
)

APART: Final = 0.1  # metres between centres at the start


@dataclass(frozen=True)
class Vss(Soccer):
    """VSSS, by default on the field for three a side; subclasses say who plays.

    A match starts with everything at random places and ends with a goal of either side.
    """

    n_blue: int = 3
    n_yellow: int = 3
    max_steps: int = 1200  # 30 s
    ball_speed: float = 0.0  # m/s, the most that the ball starts with
    reward_weights: Mapping[str, float] | str = default(
        default_factory=dict
    )  # in place of REWARD_WEIGHTS; "paper"
    robot: str = "vss_440rpm"  # a robot model of the simulator
    discrete: bool = False  # whether agents choose one of CHOICES instead of two powers
    field: str = "vss_3v3"  # or "vss_5v5", whatever the sizes of the teams

    action_size = 2  # left and right wheel, of their top speed
    CHOICES: ClassVar[Floats] = CHOICES
    success = "goal_score"

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.whole("n_blue", self.n_blue, 1)
        checks.whole("n_yellow", self.n_yellow, 0)
        checks.whole("max_steps", self.max_steps, 1)
        checks.number("ball_speed", self.ball_speed, 0.0, FASTEST)
        checks.flag("discrete", self.discrete)
        object.__setattr__(
            self,
            "reward_weights",
            checks.reward_weights(self.reward_weights, REWARD_WEIGHTS, PAPER_REWARD_WEIGHTS),
        )
        checks.preset("field", self.field, Field)
        checks.robots(self.robot)
        checks.drive(self.config, "differential", "with two wheels")
        if self.config.field.touch_line_margin > 0.0:
            raise ValueError(f"field: expected one of VSSS, like 'vss_5v5', got {self.field!r}")

    @property
    def two_sided(self) -> bool:
        """Both teams play, whoever drives them."""
        return self.n_yellow > 0 and set(SIDES) <= set(self.sides)

    @cached_property
    def config(self) -> SimConfig:
        """The field of 1.50 x 1.30 m or the one that the option names, golf ball, 25 ms steps."""
        return SimConfig(self.field, self.n_blue, self.n_yellow, robot=self.robot)

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Ball and robots anywhere, apart; robots face anywhere."""
        frame = spawn.anywhere(rng, self.config, APART)
        frame.ball.velocity[:] = spawn.velocities(rng, self.ball_speed)
        spawn.roll(frame.ball, self.config.ball)
        return frame

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Wheel speeds, rad/s."""
        return actions * np.float32(self.config.robot.max_wheel_speed)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """A goal counts most. All are drawn behind the ball; who is at it is paid for moving it."""
        terms = {
            "goal": rewards.goal(play),
            "ball_to_goal": rewards.ball_to_goal(play, self.config.field) * rewards.nearest(play),
            "approach": rewards.approach(play, self.config.field),
            "energy": rewards.energy(play),
        }
        return rewards.weighted(terms, self.reward_weights), rewards.scored(play)

    def metrics(self, play: Play) -> dict[str, Floats]:
        """`goal_score`: +1 if blue has scored, -1 if yellow has, else 0."""
        return {"goal_score": rewards.goals_at(play.frame.ball)}
