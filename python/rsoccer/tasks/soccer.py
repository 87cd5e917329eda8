"""What the tasks of both leagues share: what a robot sees, and the table of those that choose."""

from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer.frame import Floats
from rsoccer.task import Play, Task
from rsoccer.tasks import sight
from rsoccer.tasks.scales import Scales

LIMITS: Final = {
    "ball": 4.0,
    "me": 2.0,
    "mates": 2.0,
    "foes": 2.0,
    "action": 1.0,
    "ball_from_me": 3.0,
    "goal_from_me": 3.0,
    "shot": 1.0,
    "motion_from_me": 4.0,
    "places_from_me": 3.0,
}
"""In half lengths of the field and top speeds of a robot; a ball that is hit has more."""


class Soccer(Task):
    """A task with a ball and two goals."""

    CHOICES: ClassVar[Floats]  # (choices, action) what agents that choose may do
    discrete: bool  # an option of all: whether they choose one of these instead of numbers

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """The whole game in the robot's view, and ball and goal from where it stands and faces.

        A robot has 7 numbers, and 8 where it has a break beam; there the ball has heights too.
        """
        view, scales = play.view, self.scales
        has_mouth = self.config.robot.has_mouth
        robots = scales.robots(view, beam=has_mouth)
        return {
            "ball": scales.ball_in_space(view) if has_mouth else scales.ball(view),  # 6 or 4
            "me": robots[:, :, 0],  # (n, seers, 7 or 8)
            "mates": robots[:, :, 1 : 1 + view.n_mates],  # (n, seers, mates, 7 or 8)
            "foes": robots[:, :, 1 + view.n_mates :],  # (n, seers, foes, 7 or 8)
            "action": play.actions[:, play.seers],  # (n, seers, action)
            **sight.from_me(view, self.goal, scales.per_metre, scales.per_speed),
        }

    def observation_limits(self) -> dict[str, float]:
        """LIMITS."""
        return dict(LIMITS)

    @property
    def action_table(self) -> Floats | None:
        """CHOICES, if agents choose."""
        return self.CHOICES if self.discrete else None

    @cached_property
    def scales(self) -> Scales:
        """Scales of the observations."""
        return Scales(self.config)

    @cached_property
    def goal(self) -> Floats:
        """(2,) metres, the middle of the goal attacked."""
        return np.array([self.config.field.half_length, 0.0], np.float32)
