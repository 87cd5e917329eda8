"""What all SSL tasks share: the field of the hardware challenges, and actions.

An action is five numbers in [-1, 1]: velocity along the axes of the field as the robot's side sees
it (or of the robot, by option), turn rate, kick (none below 0, up to the legal limit) and dribbler
(off below 0).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from dataclasses import field as default
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import BallModel, Field, SimConfig, Simulator, Steering
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks.soccer import Soccer

TURN: Final = 10.0  # rad/s, the fastest that an action asks for: rSoccer's own limit
LEGAL_KICK: Final = 6.5  # m/s, SSL rules
VELOCITY_FRAMES: Final = ("field", "robot")
STARTS: Final = 16  # that are tried on another field than a task's own

# What agents that choose may do: stand, eight ways to drive, turn left and right, each with the
# dribbler running; kick, standing; in the order of an action's numbers.
_WAYS = [(x, y, 0.0) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0)]
CHOICES: Final = np.array(
    [(*way, -1.0, 1.0) for way in [*_WAYS, (0.0, 0.0, 0.5), (0.0, 0.0, -0.5)]]
    + [(0.0, 0.0, 0.0, 1.0, -1.0)],
    np.float32,
)


@dataclass(frozen=True)
class Ssl(Soccer):
    """A task on an SSL field; subclasses say what is to be done."""

    field: str = "ssl_challenge"  # a field of the simulator
    max_steps: int = 1200  # 30 s
    velocity_frame: str = "field"  # of the velocities: "field" or "robot"
    reward_weights: Mapping[str, float] | str = default(
        default_factory=dict
    )  # replace REWARD_WEIGHTS; "paper"
    robot: str = "ssl_generic"  # a robot model of the simulator
    ball: str = "ssl_tigers"  # a ball of the simulator
    discrete: bool = False  # whether agents choose one of CHOICES instead of five numbers

    action_size = 5
    CHOICES: ClassVar[Floats] = CHOICES
    half_only: ClassVar[bool] = (
        False  # whether play keeps to the opponents' half, out of their area
    )
    REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {}
    PAPER_REWARD_WEIGHTS: ClassVar[Mapping[str, float]] = {}

    def __post_init__(self) -> None:
        """Refuse options that make no task, by name."""
        checks.whole("max_steps", self.max_steps, 1)
        if self.velocity_frame not in VELOCITY_FRAMES:
            raise ValueError(
                f"velocity_frame: expected one of {VELOCITY_FRAMES}, got {self.velocity_frame!r}"
            )
        weights = checks.reward_weights(
            self.reward_weights, self.REWARD_WEIGHTS, self.PAPER_REWARD_WEIGHTS
        )
        object.__setattr__(self, "reward_weights", weights)
        checks.flag("discrete", self.discrete)
        checks.preset("field", self.field, Field)
        checks.robots(self.robot)
        if self.ball is not None:
            checks.preset("ball", self.ball, BallModel)
        checks.drive(self.config, "omni", "that is told its body's velocity")
        if not self.config.field.touch_line_margin > 0.0:
            raise ValueError(f"field: expected one of the SSL, like 'ssl_b', got {self.field!r}")
        if self.field != type(self).field:
            self._check_room()

    def _check_room(self) -> None:
        """ValueError unless a match can start on a field that is not the task's own."""
        rng = WorldRng.seeded(0, STARTS)
        try:
            rows = self.get_initial_positions_frame(rng).rows
            Simulator(self.config, STARTS).place(np.ones(STARTS, np.bool_), rows, rows.copy())
        except ValueError as error:
            raise ValueError(f"field: no room for this task on {self.field!r}: {error}") from error

    def team_sizes(self) -> tuple[int, int]:
        """Robots of blue and of yellow."""
        return 1, 0

    @cached_property
    def config(self) -> SimConfig:
        """25 ms steps; the field, robots and ball that the options name."""
        n_blue, n_yellow = self.team_sizes()
        return SimConfig(self.field, n_blue, n_yellow, robot=self.robot, ball=self.ball)

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Velocity in the robot's frame (m/s), turn rate (rad/s), kick (m/s), dribbler."""
        return self._steering.commands(actions, play.frame.rows)

    def is_off_field(self, places: Floats) -> Mask:
        """(n,) whether places (n, 2) are beyond the field's lines."""
        beyond = np.abs(places) > self._corner
        return np.logical_or(beyond[:, 0], beyond[:, 1])

    @cached_property
    def reach(self) -> np.float32:
        """Metres from a robot's centre to that of a ball at its front."""
        return np.float32(self.config.robot.front + self.config.ball.radius)

    @cached_property
    def action_scales(self) -> Floats:
        """(5,) what a 1 in an action asks for: m/s, m/s, rad/s, m/s of a kick, dribbler on."""
        robot = self.config.robot
        kick = min(robot.max_kick, LEGAL_KICK)
        return np.array([robot.top_speed, robot.top_speed, TURN, kick, 1.0], np.float32)

    @cached_property
    def _corner(self) -> Floats:
        """(2,) where two lines of the field meet, metres."""
        return np.array([self.config.field.half_length, self.config.field.half_width], np.float32)

    @cached_property
    def _steering(self) -> Steering:
        """What actions ask for."""
        return Steering(self.action_scales.tolist(), self.velocity_frame == "field", self.n_blue)


def ball_at_mouth(frame: Frame, robot: int, reach: np.float32) -> Floats:
    """Where a ball in the mouth of `robot` is, (n, 2) metres."""
    robots = frame.robots
    at: Floats = robots.position[:, robot] + robots.heading[:, robot] * reach
    return at


def half_turned(poses: Array) -> Array:
    """Poses (..., 3) of x, y and heading for the other goal: the field turned half round."""
    turned = np.asarray(poses, np.float64) * [-1.0, -1.0, 1.0]
    turned[..., 2] += np.pi
    return turned
