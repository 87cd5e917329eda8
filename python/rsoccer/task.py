"""A task: the four methods that a researcher writes, for all worlds at once.

A task has no state. What two frames cannot tell goes into `play.memory`; options are the fields
of a frozen dataclass. Who drives which robot is no business of a task: it names only defaults.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from enum import Enum
from functools import cached_property
from typing import ClassVar, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer._core import SimConfig, limit
from rsoccer.frame import Array, Floats, Frame, Mask, robot_names
from rsoccer.markers import Marker
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.view import SIDES, Viewpoint

__all__ = ["DEFAULT_LIMIT", "LEARN", "Block", "Learn", "Play", "Task"]

DEFAULT_LIMIT: Final = 10.0


class Learn(Enum):
    """Marks a robot whose actions come from outside."""

    LEARN = "learn"


LEARN: Final = Learn.LEARN


class Block(NamedTuple):
    """Where one named part of the observation lies in the flat one."""

    shape: tuple[int, ...]  # of one observer's block
    columns: slice  # of the flat observation

    @property
    def size(self) -> int:
        """Numbers in it."""
        return math.prod(self.shape)


class Task(ABC):
    """What a researcher writes. Every array is batched over `n` worlds; no state on self."""

    name: str = "unnamed"
    action_size: int  # numbers that drive one robot, each in [-1, 1]
    max_steps: int  # the clock; ending by it is truncation, not `done`
    sides: Sequence[str] = SIDES  # teams whose robots may look: views have room for these
    success: ClassVar[str | None] = None  # the metric that says how well an episode went, if any

    @property
    @abstractmethod
    def config(self) -> SimConfig:
        """Field, robots, ball and time step, for the simulator."""

    def new_memory(self, n: int) -> dict[str, Array]:
        """Per-world facts that two frames cannot tell, as they are when an episode starts."""
        return {}

    @abstractmethod
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """A starting frame for each of `len(rng)` worlds."""

    @abstractmethod
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """(n, robots, action) in [-1, 1] -> (n, robots, command) in SI units."""

    @abstractmethod
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Named blocks, each (n, observers, ...): what each robot that looks is shown."""

    @abstractmethod
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Weighted terms, each (n, observers) or (n, 1), and whether each world's task ended (n,)."""

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """What a picture of one world shows on the floor: targets, gates, areas."""
        return ()

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        """Worlds (k,) where the ball goes on from elsewhere, and balls (k, ball column); or None.

        Asked after each step: for a ball that left the field and comes back. Position, velocity
        and spin count, as `frame.ball.data` has them; worlds may be in any order. Robots go on as
        they are. What was between is not to be rewarded, so there `last_frame` becomes equal to
        `frame`.
        """
        return None

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Facts of each world (n,) that count at the end of an episode."""
        return {}

    @property
    def full_success(self) -> float | None:
        """Value of `success` with which all is reached; None where more is always better."""
        return 1.0

    @property
    def two_sided(self) -> bool:
        """Whether yellow can play blue's part, as it can where both teams learn.

        Then a policy is evaluated from both sides, and `success` is +1, 0 or -1 as blue sees it.
        """
        learning = {name.rsplit("_", 1)[0] for name in self.agents}
        return set(SIDES) <= learning.intersection(self.sides)

    @property
    def action_table(self) -> Floats | None:
        """Actions (choices, action) that agents choose from; None where they give numbers."""
        return None

    def default_controllers(self) -> dict[str, str | Learn]:
        """Who drives each robot if nobody says otherwise: `LEARN` or a policy's name."""
        return dict.fromkeys(self.robots, LEARN)

    def observation_limits(self) -> dict[str, float]:
        """Blocks and the largest magnitude they show; others are clipped to 10."""
        return {}

    @property
    def n_blue(self) -> int:
        """Robots of the team that attacks +x."""
        return self.config.n_blue

    @property
    def n_yellow(self) -> int:
        """Robots of the other team."""
        return self.config.n_yellow

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of all robots, in the order of a row."""
        return robot_names(self.n_blue, self.n_yellow)

    @property
    def agents(self) -> tuple[str, ...]:
        """Names of the robots that learn unless `Matches` is told otherwise."""
        controllers = self.default_controllers()
        return tuple(name for name in self.robots if controllers[name] is LEARN)

    @cached_property
    def blocks(self) -> dict[str, Block]:
        """Name, shape and place of each part of the flat observation, found by a trial."""
        blocks, first = {}, 0
        for name, block in self.frame_to_observations(self._trial()).items():
            shape = block.shape[2:]
            blocks[name] = Block(shape, slice(first, first + math.prod(shape)))
            first += math.prod(shape)
        return blocks

    @property
    def observation_size(self) -> int:
        """Numbers in the flat observation."""
        return sum(block.size for block in self.blocks.values())

    @property
    def layout(self) -> str:
        """The blocks and their shapes as text: what a network was made for."""
        sizes = {name: "x".join(map(str, block.shape)) for name, block in self.blocks.items()}
        return ", ".join(f"{name} {size}" for name, size in sizes.items())

    @cached_property
    def observation_high(self) -> Floats:
        """(o,) largest value of each number; the least is its negative."""
        limits = self.observation_limits()
        high = np.empty(self.observation_size, np.float32)
        for name, block in self.blocks.items():
            high[block.columns] = limits.get(name, DEFAULT_LIMIT)
        return high

    @cached_property
    def observation_low(self) -> Floats:
        """(o,) least value of each number."""
        return -self.observation_high

    def observe(self, play: Play) -> Floats:
        """The blocks side by side within their limits, a new array (n, observers, o)."""
        n, observers = len(play.frame), len(play.observers)
        flat = np.empty((n, observers, len(self.observation_high)), np.float32)
        if observers:
            blocks = self.frame_to_observations(play).values()
            sized = [b if b.ndim == 3 else b.reshape(n, observers, -1) for b in blocks]
            np.concatenate(sized, axis=-1, out=flat, casting="same_kind")
            limit(flat, self.observation_high)
        return flat

    def new_viewpoint(self, observers: Sequence[int]) -> Viewpoint:
        """What shows frames to robots `observers`."""
        return Viewpoint(self.n_blue, self.n_yellow, observers, self.sides)

    def new_play(self, n: int, viewpoint: Viewpoint, rng: WorldRng) -> Play:
        """Buffers for n worlds with fresh memory; the frames are yet to be filled."""
        robots = self.n_blue + self.n_yellow
        return Play(
            frame=Frame.empty(n, self.n_blue, self.n_yellow),
            last_frame=Frame.empty(n, self.n_blue, self.n_yellow),
            view=viewpoint.new_view(n),
            last_view=viewpoint.new_view(n),
            commands=np.zeros((n, robots, len(self.config.command_columns)), np.float32),
            actions=np.zeros((n, robots, self.action_size), np.float32),
            rng=rng,
            memory=checks.memory("new_memory", self.new_memory(n), n),
            observers=viewpoint.observers,
            steps=np.zeros(n, np.int64),
        )

    def _trial(self) -> Play:
        """One world, one observer, at a start: enough to read sizes off."""
        observer = 0 if "blue" in self.sides and self.n_blue else self.n_blue
        viewpoint = self.new_viewpoint([observer])
        play = self.new_play(1, viewpoint, WorldRng.seeded(0, 1))
        play.start(self.get_initial_positions_frame(play.rng).rows, viewpoint)
        return play
