"""What the tasks of both leagues share: what a robot sees, and the table of those that choose."""

import math
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer._core import Sight, limit
from rsoccer.frame import Floats
from rsoccer.task import Play, Task
from rsoccer.view import slots

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
        What each block holds is said by the core's `Sight`.
        """
        flat = self._seen(play)
        blocks: dict[str, Floats] = {}
        for name, columns, shape in self._seen_blocks:
            block = flat[:, :, columns]
            blocks[name] = block if len(shape) == 1 else block.reshape(*flat.shape[:2], *shape)
        return blocks

    def observe(self, play: Play) -> Floats:
        """The blocks side by side within their limits, a new array (n, seers, o)."""
        if type(self).frame_to_observations is not Soccer.frame_to_observations:
            return super().observe(play)
        flat = self._seen(play)  # nobody adds to them: they lie side by side already
        limit(flat, self.observation_high)
        return flat

    def observation_limits(self) -> dict[str, float]:
        """LIMITS."""
        return dict(LIMITS)

    @property
    def action_table(self) -> Floats | None:
        """CHOICES, if agents choose."""
        return self.CHOICES if self.discrete else None

    @cached_property
    def sight(self) -> Sight:
        """What robots see, in half lengths of the field and a robot's top speeds."""
        config = self.config
        return Sight(config.field, config.robot, *slots(self.n_blue, self.n_yellow, self.sides))

    @cached_property
    def _seen_blocks(self) -> tuple[tuple[str, slice, tuple[int, ...]], ...]:
        """Name, place and shape of each part of what `_seen` shows."""
        blocks, first = [], 0
        for name, shape in (*self.sight.blocks, ("action", (self.action_size,))):
            blocks.append((name, slice(first, first + math.prod(shape)), shape))
            first += math.prod(shape)
        return tuple(blocks)

    def _seen(self, play: Play) -> Floats:
        """What each robot that looks sees, and what it did: (n, seers, numbers), a new array."""
        size = self.action_size
        flat = self.sight.look(play.view.ball.data, play.view.robots.data, size)
        flat[:, :, -size:] = play.actions[:, play.seers]
        return flat

    @cached_property
    def per_metre(self) -> np.float32:
        """Scale of places in observations."""
        return np.float32(1.0 / self.config.field.half_length)
