"""What the tasks of both leagues share: what a robot sees, and the table of those that choose."""

import math
from functools import cached_property
from typing import ClassVar, Final

import numpy as np

from rsoccer._core import Sight, limit
from rsoccer.frame import Floats
from rsoccer.task import Play, Task
from rsoccer.view import slot_counts

LIMITS: Final = {
    "ball": 4.0,
    "ego": 2.0,
    "teammates": 2.0,
    "opponents": 2.0,
    "action": 1.0,
    "ball_polar": 3.0,
    "goal_polar": 3.0,
    "shot": 1.0,
    "body_velocities": 4.0,
    "body_positions": 3.0,
}
"""In half lengths of the field and top speeds of a robot; a ball that is hit has more."""


_NEW: Final = {
    "me": "ego",
    "mates": "teammates",
    "foes": "opponents",
    "ball_from_me": "ball_polar",
    "goal_from_me": "goal_polar",
    "motion_from_me": "body_velocities",
    "places_from_me": "body_positions",
}


class Soccer(Task):
    """A task with a ball and two goals."""

    CHOICES: ClassVar[Floats]  # (choices, action) what agents that choose may do
    discrete: bool  # an option of all: whether they choose one of these instead of numbers

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """The whole game in the robot's view, and ball and goal from where it stands and faces.

        A robot has 7 numbers, and 8 where it has a break beam; there the ball has heights too.
        What each block holds is said by the core's `Sight`.
        """
        flat = self._features(play)
        blocks: dict[str, Floats] = {}
        for name, columns, shape in self._flat_blocks:
            block = flat[:, :, columns]
            blocks[name] = block if len(shape) == 1 else block.reshape(*flat.shape[:2], *shape)
        return blocks

    def observe(self, play: Play) -> Floats:
        """The blocks side by side within their limits, a new array (n, observers, o)."""
        if type(self).frame_to_observations is not Soccer.frame_to_observations:
            return super().observe(play)
        flat = self._features(play)  # nobody adds to them: they lie side by side already
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
    def ego_features(self) -> Sight:
        """What robots see, in half lengths of the field and a robot's top speeds."""
        config = self.config
        return Sight(
            config.field, config.robot, *slot_counts(self.n_blue, self.n_yellow, self.sides)
        )

    @cached_property
    def _flat_blocks(self) -> tuple[tuple[str, slice, tuple[int, ...]], ...]:
        """Name, place and shape of each part of what `_features` shows."""
        blocks, first = [], 0
        core = [(_NEW.get(name, name), shape) for name, shape in self.ego_features.blocks]
        for name, shape in (*core, ("action", (self.action_size,))):
            blocks.append((name, slice(first, first + math.prod(shape)), shape))
            first += math.prod(shape)
        return tuple(blocks)

    def _features(self, play: Play) -> Floats:
        """What each robot that looks sees, and what it did: (n, observers, numbers), a new array."""
        size = self.action_size
        flat = self.ego_features.look(play.view.ball.data, play.view.robots.data, size)
        flat[:, :, -size:] = play.actions[:, play.observers]
        return flat

    @cached_property
    def per_metre(self) -> np.float32:
        """Scale of places in observations."""
        return np.float32(1.0 / self.config.field.half_length)
