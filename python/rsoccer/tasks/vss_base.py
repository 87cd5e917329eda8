"""Base class of all VSSS tasks: options, configuration, wheel commands."""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer import checks
from rsoccer._core import Field, RobotModel, SimConfig
from rsoccer.arrays import Floats
from rsoccer.reflection import Reflection
from rsoccer.task import Play
from rsoccer.tasks import options
from rsoccer.tasks.soccer import Soccer

DISCRETE_ACTIONS: Final = np.array(
    [[1, 1], [-1, -1], [-1, 1], [1, -1], [0.5, 1], [1, 0.5], [-0.5, -1], [-1, -0.5], [0, 0]],
    np.float32,
)
"""(9, 2) left and right wheel: forward, back, turns on the spot, arcs forward and back, stop."""


@dataclass(frozen=True)
class VssBase(Soccer):
    """Base class of all VSSS tasks; subclasses define initial state, rules, rewards and end.

    Goal of the task: score in the goal at +x (blue) or -x (yellow).

    Action of a robot:

    =====  ============================  =====================================  =======
    Index  Meaning                       Value of 1                             Range
    =====  ============================  =====================================  =======
    0      speed of the left wheel       `config.robot.max_wheel_speed`, rad/s  -1 to 1
    1      speed of the right wheel      `config.robot.max_wheel_speed`, rad/s  -1 to 1
    =====  ============================  =====================================  =======

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
    robot: str | RobotModel = "vss_440rpm"
    """Robot model with a differential drive: a preset's name, a .json file or a `RobotModel`."""
    discrete: bool = False
    """True: agents choose from `DISCRETE_ACTIONS` instead of giving two wheel speeds."""
    field: str | Field = "vss_3v3"
    """VSSS field: "vss_3v3", "vss_5v5", a .json file or a `Field`, for any team sizes."""

    action_size = 2
    """Left and right wheel."""
    DISCRETE_ACTIONS: ClassVar[Floats] = DISCRETE_ACTIONS
    """(9, 2) left and right wheel."""
    ACTION_REFLECTION: ClassVar[Reflection] = Reflection.of([1, 1], order=[1, 0])
    """(2,) the wheels are exchanged."""
    FEWEST_YELLOW: ClassVar[int] = 0
    """Fewest robots of team yellow."""
    success = "goal_score"
    """Metric that measures the success of an episode."""

    def __post_init__(self) -> None:
        """Validate the options."""
        checks.integer("n_blue", self.n_blue, 1)
        checks.integer("n_yellow", self.n_yellow, self.FEWEST_YELLOW)
        super().__post_init__()
        options.drive(self.config, "differential", "with a differential drive")
        if self.config.field.touch_line_margin > 0.0:
            raise ValueError(f"field: expected one of VSSS, like 'vss_5v5', got {self.field!r}")

    @cached_property
    def config(self) -> SimConfig:
        """Configuration with the field and robots of the options, a golf ball and 25 ms steps."""
        return SimConfig(
            self.field, self.n_blue, self.n_yellow, robot=self.robot, engine=self.engine
        )

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions to wheel speeds (n, robots, 2), rad/s."""
        return actions * self._wheel_speed

    @cached_property
    def _wheel_speed(self) -> np.float32:
        """Wheel speed of a full action, rad/s."""
        return np.float32(self.config.robot.max_wheel_speed)
