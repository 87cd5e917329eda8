"""Base class of the SSL tasks: options, field, actions and poses."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import (
    COMMAND_COLUMNS,
    BallModel,
    Field,
    RobotModel,
    SimConfig,
    Simulator,
    Steering,
)
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.reflection import Reflection
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from rsoccer.tasks import options
from rsoccer.tasks.soccer import Soccer

MAX_ANGULAR_VELOCITY: Final = 10.0
"""Angular velocity of a full deflection, rad/s: the limit of rsoccer-gym."""
MAX_LEGAL_KICK_SPEED: Final = 6.5
"""Speed limit of a kick, m/s: SSL rules."""
CHIP_ANGLE: Final = math.pi / 4
"""Angle of a chip kick above the floor, radians: it carries farthest at 45 degrees."""
VELOCITY_FRAMES: Final = ("field", "robot")
"""Values of the option `velocity_frame`."""
TRIAL_STARTS: Final = 16
"""Initial states that are tried on a field other than the task's default."""

_DIRECTIONS = [(x, y, 0.0) for x in (-1.0, 0.0, 1.0) for y in (-1.0, 0.0, 1.0)]
DISCRETE_ACTIONS: Final = np.array(
    [(*motion, -1.0, 1.0) for motion in [*_DIRECTIONS, (0.0, 0.0, 0.5), (0.0, 0.0, -0.5)]]
    + [(0.0, 0.0, 0.0, 1.0, -1.0)],
    np.float32,
)
"""(12, 5) eight directions and stop, turn left, turn right, all with dribbler; kick at rest."""
_FLAT, _CHIP = np.full((len(DISCRETE_ACTIONS), 1), -1.0), [(0.0, 0.0, 0.0, 1.0, -1.0, 1.0)]
DISCRETE_ACTIONS_WITH_CHIP: Final = np.concatenate(
    [np.hstack([DISCRETE_ACTIONS, _FLAT]), _CHIP]
).astype(np.float32)
"""(13, 6) the same with flat kicks, and chip at rest."""


_CHIP_COSINE, _CHIP_SINE = np.float32(math.cos(CHIP_ANGLE)), np.float32(math.sin(CHIP_ANGLE))
_KICK, _CHIP_SWITCH = 3, 5  # indices in an action
_KICK_ALONG, _KICK_UP = (COMMAND_COLUMNS["omni"].index(f"kick_v_{axis}") for axis in "xz")


@dataclass(frozen=True)
class Ssl(Soccer):
    """Base class of the SSL tasks; subclasses define goal, initial state, rewards and end.

    Action of a robot:

    =====  ==========================================  ==================================  =======
    Index  Meaning                                     Value of 1                          Range
    =====  ==========================================  ==================================  =======
    0      velocity toward the attacked goal, or       `config.robot.top_speed`, m/s       -1 to 1
           ahead if `velocity_frame` is "robot"
    1      velocity to the left of that                `config.robot.top_speed`, m/s       -1 to 1
    2      angular velocity, counterclockwise          10 rad/s                            -1 to 1
    3      kick speed; no kick up to 0                 6.5 m/s (SSL rules), or the         -1 to 1
                                                       robot's maximum if that is less
    4      dribbler: on above 0, off up to 0           full speed, for any value above 0   -1 to 1
    =====  ==========================================  ==================================  =======

    With the option `chip_kick` an action has a sixth number, a switch like that of the dribbler:
    above 0 the kick is a chip at 45 degrees, and 1 in number 3 is a speed of 6.5 m/s or the robot's
    maximum chip speed if that is less; up to 0 the kick is flat. It is a switch, because the
    chippers of robots have a fixed angle. A sign of the kick speed would leave no room for
    exploration without a kick between kicks and chips. A script that leaves the number out kicks
    flat.

    Source: the SSL hardware challenges of 2021 (field and challenges) and Martins et al., "rSoccer:
    A Framework for Studying Reinforcement Learning in Small and Very Small Size Robot Soccer"
    (2021; choice of tasks).

    Raises:
        TypeError: an option of a wrong type.
        ValueError: an option outside its range, or a field without space for the initial state.
    """

    field: str | Field = "ssl_challenge"
    """SSL field: "ssl_challenge" (6 x 4 m), "ssl_b" (9 x 6 m), "ssl_a" (12 x 9 m), a .json file or
    a `Field`."""
    robot: str | RobotModel = "ssl_generic"
    """Robot model with an omnidirectional drive: a preset's name, a .json file or a
    `RobotModel`."""
    discrete: bool = False
    """True: agents choose from `DISCRETE_ACTIONS` instead of giving five numbers."""
    velocity_frame: str = "field"
    """Axes of the velocity in actions: "field" (of the robot's team) or "robot" (of its body)."""
    ball: str | BallModel = "ssl_tigers"
    """Ball model: a preset's name, a .json file or a `BallModel`."""
    chip_kick: bool = False
    """True: actions have a sixth number, above 0 for a chip kick."""

    action_size = 5
    """Velocity x and y, angular velocity, kick speed, dribbler."""
    DISCRETE_ACTIONS: ClassVar[Floats] = DISCRETE_ACTIONS
    """(12, 5) actions."""
    ACTION_REFLECTION: ClassVar[Reflection] = Reflection.of([1, -1, -1, 1, 1])
    """(5,) velocity to the left and angular velocity change sign."""
    half_only: ClassVar[bool] = False
    """True: blue_0 must stay in the opponents' half and out of their goal area."""

    def __post_init__(self) -> None:
        """Validate the options."""
        super().__post_init__()
        if checks.boolean("chip_kick", self.chip_kick):
            object.__setattr__(self, "action_size", self.action_size + 1)
            object.__setattr__(self, "optional_action_size", 1)
        if self.velocity_frame not in VELOCITY_FRAMES:
            raise ValueError(
                f"velocity_frame: expected one of {VELOCITY_FRAMES}, got {self.velocity_frame!r}"
            )
        object.__setattr__(self, "ball", options.model("ball", self.ball, BallModel))
        options.drive(self.config, "omni", "with an omnidirectional drive")
        if not self.config.field.touch_line_margin > 0.0:
            raise ValueError(f"field: expected one of the SSL, like 'ssl_b', got {self.field!r}")
        if self.field != type(self).field:
            self._check_starts("field")

    def team_sizes(self) -> tuple[int, int]:
        """Return the numbers of blue and of yellow robots."""
        return 1, 0

    @cached_property
    def config(self) -> SimConfig:
        """Configuration with the field, robots and ball of the options and 25 ms steps."""
        n_blue, n_yellow = self.team_sizes()
        return SimConfig(
            self.field, n_blue, n_yellow, robot=self.robot, ball=self.ball, engine=self.engine
        )

    @property
    def action_meaning(self) -> str:
        """The axes of the velocity where they are the robot's, and the chip kick."""
        axes = ["velocity in the robot's axes"] if self.velocity_frame == "robot" else []
        return "; ".join([*axes, *(["chip kick"] if self.chip_kick else [])])

    @property
    def action_table(self) -> Floats | None:
        """`DISCRETE_ACTIONS` with the option `discrete`, and with a chip with `chip_kick`."""
        if self.discrete and self.chip_kick:
            return DISCRETE_ACTIONS_WITH_CHIP
        return super().action_table

    @property
    def action_reflection(self) -> Reflection:
        """Reflection of an action: velocity to the left and angular velocity change sign."""
        flat = self.ACTION_REFLECTION
        return Reflection.join([flat, Reflection.of([1])]) if self.chip_kick else flat

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions to velocity (m/s), angular velocity (rad/s), kick (m/s) and dribbler."""
        if not self.chip_kick:
            return self._steering.commands(actions, play.sensed.rows, play.threads)
        flat = np.ascontiguousarray(actions[..., :_CHIP_SWITCH])
        commands = self._steering.commands(flat, play.sensed.rows, play.threads)
        chips = actions[..., _CHIP_SWITCH] > 0.0
        speed = np.maximum(actions[..., _KICK], 0.0) * self.chip_scale
        along, up = speed * _CHIP_COSINE, speed * _CHIP_SINE
        np.copyto(commands[..., _KICK_ALONG], along, where=chips)
        np.copyto(commands[..., _KICK_UP], up, where=chips)
        return commands

    def is_off_field(self, positions: Floats) -> Mask:
        """Return the positions that are beyond the lines of the field.

        Args:
            positions: (n, 2) meters.

        Returns:
            (n,).
        """
        beyond = np.abs(positions) > self._half_size
        return np.logical_or(beyond[:, 0], beyond[:, 1])

    def is_in_goal_area(self, positions: Floats, margin: float | np.float32 = 0.0) -> Mask:
        """Return the positions that are in the goal area at +x, or beyond its front line.

        Args:
            positions: (..., 2) meters.
            margin: distance by which the area is extended to all sides, m.

        Returns:
            (...).
        """
        field = self.config.field
        front = np.float32(field.half_length - field.goal_area_depth - margin)
        half_width = np.float32(field.goal_area_width / 2 + margin)
        return np.logical_and(positions[..., 0] > front, np.abs(positions[..., 1]) < half_width)

    @cached_property
    def mouth_offset(self) -> np.float32:
        """Distance from a robot's center to the center of a ball in its mouth, m."""
        return np.float32(self.config.robot.front_distance + self.config.ball.radius)

    @cached_property
    def action_scales(self) -> Floats:
        """(5,) values of a full deflection: m/s, m/s, rad/s, m/s of a kick, 1 for the dribbler."""
        robot = self.config.robot
        kick = min(robot.max_kick_speed, MAX_LEGAL_KICK_SPEED)
        return np.array(
            [robot.top_speed, robot.top_speed, MAX_ANGULAR_VELOCITY, kick, 1.0], np.float32
        )

    @cached_property
    def chip_scale(self) -> np.float32:
        """Speed of a chip kick of a full deflection, m/s."""
        return np.float32(min(self.config.robot.max_chip_speed, MAX_LEGAL_KICK_SPEED))

    @cached_property
    def _half_size(self) -> Floats:
        """(2,) half length and half width of the field, m."""
        return np.array([self.config.field.half_length, self.config.field.half_width], np.float32)

    @cached_property
    def _steering(self) -> Steering:
        """Converter from actions to commands."""
        return Steering(self.action_scales.tolist(), self.velocity_frame == "field", self.n_blue)

    def _check_starts(self, option: str) -> None:
        """Raise ValueError unless matches can start with an option other than the default."""
        rng = WorldRng.seeded(0, TRIAL_STARTS)
        try:
            rows = self.get_initial_positions_frame(rng).rows
            simulator = Simulator(self.config, TRIAL_STARTS)
            simulator.place(np.ones(TRIAL_STARTS, np.bool_), rows, rows.copy())
        except ValueError as error:
            raise ValueError(
                f"{option}: no space for the initial state of this task on {self.field!r}: {error}"
            ) from error


def ball_at_mouth(frame: Frame, robot: int, mouth_offset: np.float32) -> Floats:
    """Compute the position of a ball in the mouth of a robot.

    Args:
        frame: state of n worlds.
        robot: index of the robot in the order of a state row.
        mouth_offset: distance from the robot's center to the ball's, m.

    Returns:
        (n, 2) meters.
    """
    robots = frame.robots
    position: Floats = robots.position[:, robot] + robots.heading[:, robot] * mouth_offset
    return position


def rotated_180(poses: Array) -> Array:
    """Rotate poses by 180 degrees about the center of the field.

    Args:
        poses: (..., 3) x and y, m; heading, rad.

    Returns:
        (..., 3) float64 poses of a team that attacks the other goal.
    """
    rotated = np.asarray(poses, np.float64) * [-1.0, -1.0, 1.0]
    rotated[..., 2] += np.pi
    return rotated
