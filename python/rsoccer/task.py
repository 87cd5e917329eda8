"""Base class of tasks: initial states, commands, observations, rewards and terminations.

A task is stateless and batched: every method handles all worlds at once. State that two
consecutive frames do not contain goes into `play.memory`. Options are the fields of a frozen
dataclass. A task names only default controllers; `Matches` assigns the actual ones.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from enum import Enum
from functools import cached_property
from typing import Any, ClassVar, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rsoccer import checks
from rsoccer._core import SimConfig, Threads, clip_in_place
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame, robot_names, team_of
from rsoccer.markers import Marker
from rsoccer.play import Play
from rsoccer.reflection import Reflection
from rsoccer.rng import WorldRng
from rsoccer.view import SIDES, Viewpoint

__all__ = ["DEFAULT_LIMIT", "LEARN", "Block", "Learn", "Play", "Task"]

DEFAULT_LIMIT: Final = 10.0
"""Bound of observation blocks without a bound of their own."""


class Learn(Enum):
    """Type of `LEARN`."""

    LEARN = "learn"
    """Controller of a robot whose actions are passed to `Matches.step`."""


LEARN: Final = Learn.LEARN
"""Controller of a robot whose actions are passed to `Matches.step`."""


class Block(NamedTuple):
    """Shape and position of one named block of the observation."""

    shape: tuple[int, ...]
    """Shape of the block of one observer."""
    columns: slice
    """Columns of the flat observation that hold the block."""

    @property
    def size(self) -> int:
        """Number of columns."""
        return math.prod(self.shape)


class Task(ABC):
    """Base class of tasks, batched over `n` worlds.

    A subclass defines `action_size`, `max_steps`, `config` and the four methods
    `get_initial_positions_frame`, `get_commands`, `frame_to_observations` and
    `calculate_reward_and_done`. `rsoccer.testing.check_task` tests it for common mistakes.

    Example:
        >>> from dataclasses import dataclass
        >>> from rsoccer.rewards import energy
        >>> from rsoccer.tasks import VssSelfPlay
        >>> @dataclass(frozen=True)
        ... class LazyVss(VssSelfPlay):
        ...     def calculate_reward_and_done(self, play):
        ...         terms, terminated = super().calculate_reward_and_done(play)
        ...         return terms | {"lazy": energy(play)}, terminated
    """

    name: str = "unnamed"
    """Registered name, set by `register`."""
    action_size: int
    """Numbers in the action of one robot, each in [-1, 1]."""
    max_steps: int
    """Control steps after which an episode is truncated, at least 1."""
    sides: Sequence[str] = SIDES
    """Teams whose robots may observe. The views have slots for the largest of these teams."""
    success: ClassVar[str | None] = None
    """Metric that measures the success of an episode; None for the return."""
    training_options: ClassVar[tuple[str, ...]] = ("reward_weights",)
    """Options that change how a policy learns, not how it plays. The task on which a policy was
    trained is evaluated and shown without them."""

    @property
    @abstractmethod
    def config(self) -> SimConfig:
        """Configuration of the simulator: field, robots, ball and time step."""

    def new_memory(self, n: int) -> dict[str, Array]:
        """Create the task's own state at the start of an episode.

        Args:
            n: number of worlds.

        Returns:
            Arrays (n, ...) by name. `Play.memory` holds copies of them, which `restart_play` and
            `calculate_reward_and_done` update in place; a reset renews them. Default: none.
        """
        return {}

    def rule_memory(self, n: int) -> dict[str, Array]:
        """Create the memory of rules that derived tasks keep, whatever their `new_memory` is.

        Args:
            n: number of worlds.

        Returns:
            Arrays (n, ...) by name, as `new_memory`. Default: none.
        """
        return {}

    @abstractmethod
    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        """Draw the initial state of episodes.

        Args:
            rng: (n,) random streams, one per world. World `i` must depend on stream `i` only.

        Returns:
            One frame of n worlds.
        """

    def start_episode(self, play: Play) -> None:  # noqa: B027  (no task needs to override it)
        """Fit the memory of new episodes to their initial state. Default: leave it as it is.

        Called once for each episode, before its first observation.

        Args:
            play: state of n worlds with the memory of `new_memory`, which may be changed in place.
                Draws from `play.rng` are allowed.
        """

    @abstractmethod
    def get_commands(self, play: Play, actions: Floats) -> Floats:
        """Convert actions to robot commands.

        Args:
            play: state of n worlds.
            actions: (n, robots, action_size) in [-1, 1].

        Returns:
            (n, robots, command) in SI units, with the columns `config.command_columns`.
        """

    @abstractmethod
    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        """Compute the observation of each observer as named blocks.

        Args:
            play: state of n worlds; `play.view` is in the coordinates of each observer.

        Returns:
            Blocks (n, observers, ...) by name. `observe` concatenates them in this order and
            clips them to `observation_limits`.
        """

    @abstractmethod
    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        """Return the reward terms of the last step and the terminations.

        Args:
            play: state of n worlds after the step.

        Returns:
            Weighted reward terms by name, each (n, observers) or (n, 1); and (n,) the episodes
            that terminate. The reward is the sum of the terms. `max_steps` truncates episodes
            separately.
        """

    def markers(self, play: Play, world: int) -> tuple[Marker, ...]:
        """Return the floor markers for pictures of one world: targets, gates, areas.

        Args:
            play: state of n worlds.
            world: index of the world, 0 to n - 1.
        """
        return ()

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        """Choose the balls to move after a step, such as a ball that left the field.

        Robots keep their state. Where a ball is moved, `last_frame` is set equal to `frame`, so
        the jump of the ball is not rewarded.

        Args:
            frame: (n, ...) state after the step.

        Returns:
            (k,) indices of worlds, each at most once, in any order; and (k, ball column) the new
            balls with the columns of `frame.ball.data`, of which position, velocity and spin are
            used. None for no world, which is the default.
        """
        return None

    def restart_play(self, play: Play) -> tuple[NDArray[np.intp], Floats] | None:
        """Choose matches that continue from another state after a step, as a referee restarts play.

        It is called after `reposition_ball`, before `play.steps` counts the step. The episode
        continues: clock, policies and memory are kept. Where play restarts, `last_frame` is set
        equal to `frame`, so the jump is not rewarded.

        Args:
            play: state of n worlds after the step; its memory may be updated in place.

        Returns:
            (k,) indices of worlds, each at most once, in any order; and (k, row) their new states,
            as for a start of an episode. None for no world, which is the default.
        """
        return None

    def metrics(self, play: Play) -> dict[str, Floats]:
        """Compute metrics of each episode; the values at its end are reported.

        Args:
            play: state of n worlds.

        Returns:
            Arrays (n,) by name. Default: none.
        """
        return {}

    @property
    def full_success(self) -> float | None:
        """Value of the metric `success` at full success; None for a metric without a maximum."""
        return 1.0

    @property
    def two_sided(self) -> bool:
        """True where yellow can play blue's part, that is, where both teams learn.

        Such a task is evaluated from both sides, with `success` +1, 0 or -1 for blue.
        """
        learning = {team_of(name) for name in self.agents}
        return set(SIDES) <= learning.intersection(self.sides)

    @property
    def action_table(self) -> Floats | None:
        """(choices, action_size) actions of a discrete task; None for continuous actions."""
        return None

    def default_controllers(self) -> Mapping[str, Any]:
        """Return the default controller of each robot by name: `LEARN`, a policy or its name."""
        return dict.fromkeys(self.robots, LEARN)

    def observation_limits(self) -> dict[str, float]:
        """Return the bounds of observation blocks by name.

        A block is clipped to [-bound, bound]. The bound of other blocks is `DEFAULT_LIMIT`.
        """
        return {}

    def block_reflections(self) -> dict[str, Reflection]:
        """Return how observation blocks change with left and right swapped.

        Returns:
            Reflection of the last axis by the name of the block. Default: none.
        """
        return {}

    @property
    def action_reflection(self) -> Reflection | None:
        """Reflection (action_size,) of actions; None, the default, if it is not known."""
        return None

    @property
    def is_symmetric(self) -> bool:
        """True if the task is the same with left and right swapped.

        That is, from reflected states, reflected actions lead to reflected observations and equal
        rewards. By default it is True if the reflections of actions and of all blocks are known. A
        task whose rules tell left from right returns False.
        """
        return self.action_reflection is not None and set(self.blocks) <= set(
            self.block_reflections()
        )

    @cached_property
    def observation_reflection(self) -> Reflection:
        """Reflection of the flat observation, (observation_size,), of a symmetric task.

        Raises:
            KeyError: a block without a reflection.
        """
        reflections = self.block_reflections()
        return Reflection.join(
            reflections[name]
            for name, block in self.blocks.items()
            for _ in range(math.prod(block.shape[:-1]))
        )

    @property
    def n_blue(self) -> int:
        """Number of robots in team blue, which attacks +x."""
        return self.config.n_blue

    @property
    def n_yellow(self) -> int:
        """Number of robots in team yellow, which attacks -x."""
        return self.config.n_yellow

    @property
    def robots(self) -> tuple[str, ...]:
        """Names of all robots in the order of a state row: blue_0, ..., yellow_0, ..."""
        return robot_names(self.n_blue, self.n_yellow)

    @property
    def agents(self) -> tuple[str, ...]:
        """Names of the robots that learn under the default controllers."""
        controllers = self.default_controllers()
        return tuple(name for name in self.robots if controllers[name] is LEARN)

    @cached_property
    def blocks(self) -> dict[str, Block]:
        """Blocks of the flat observation by name, found by computing one observation."""
        blocks, first = {}, 0
        for name, block in self.frame_to_observations(self._sample_play()).items():
            shape = block.shape[2:]
            blocks[name] = Block(shape, slice(first, first + math.prod(shape)))
            first += math.prod(shape)
        return blocks

    @property
    def observation_size(self) -> int:
        """Numbers in the flat observation of one robot."""
        return sum(block.size for block in self.blocks.values())

    @property
    def action_meaning(self) -> str:
        """Meaning of the actions where options change it, as text; empty for the default one."""
        return ""

    @property
    def layout(self) -> str:
        """Blocks of the observation, their shapes, and `action_meaning` as text.

        Networks save it, and fit only tasks with the same.
        """
        sizes = {name: "x".join(map(str, block.shape)) for name, block in self.blocks.items()}
        blocks = ", ".join(f"{name} {size}" for name, size in sizes.items())
        return f"{blocks}; {self.action_meaning}" if self.action_meaning else blocks

    @cached_property
    def observation_high(self) -> Floats:
        """(observation_size,) upper bounds of the flat observation."""
        limits = self.observation_limits()
        high = np.empty(self.observation_size, np.float32)
        for name, block in self.blocks.items():
            high[block.columns] = limits.get(name, DEFAULT_LIMIT)
        return high

    @cached_property
    def observation_low(self) -> Floats:
        """(observation_size,) lower bounds of the flat observation, the negative upper bounds."""
        return -self.observation_high

    def observe(self, play: Play, out: Floats | None = None) -> Floats:
        """Compute the flat observation of each observer, clipped to the bounds.

        Args:
            play: state of n worlds.
            out: (n, observers, observation_size) float32 output; None for a new array.

        Returns:
            The output (n, observers, observation_size).
        """
        n, observers = len(play.frame), len(play.observers)
        shape = (n, observers, len(self.observation_high))
        flat = np.empty(shape, np.float32) if out is None else out
        if observers:
            blocks = self.frame_to_observations(play).values()
            flat_blocks = [b if b.ndim == 3 else b.reshape(n, observers, -1) for b in blocks]
            np.concatenate(flat_blocks, axis=-1, out=flat, casting="same_kind")
            clip_in_place(flat, self.observation_high)
        return flat

    def new_viewpoint(self, observers: Sequence[int]) -> Viewpoint:
        """Create the converter from frames to the views of some robots.

        Args:
            observers: indices of robots in the order of a state row.

        Returns:
            A viewpoint of these robots.
        """
        return Viewpoint(self.n_blue, self.n_yellow, observers, self.sides)

    def new_play(
        self, n: int, viewpoint: Viewpoint, rng: WorldRng, threads: Threads | None = None
    ) -> Play:
        """Create the state of n worlds, with new memory and empty frames.

        Args:
            n: number of worlds.
            viewpoint: defines the observers.
            rng: (n,) random streams of the task.
            threads: threads that share the work on many worlds; None for the caller's alone.

        Returns:
            State whose frames are still to be filled, by `Play.start`.
        """
        robots = self.n_blue + self.n_yellow
        return Play(
            frame=Frame.empty(n, self.n_blue, self.n_yellow),
            last_frame=Frame.empty(n, self.n_blue, self.n_yellow),
            commands=np.zeros((n, robots, len(self.config.command_columns)), np.float32),
            actions=np.zeros((n, robots, self.action_size), np.float32),
            rng=rng,
            memory=checks.memory("new_memory", self.new_memory(n), n) | self.rule_memory(n),
            viewpoint=viewpoint,
            steps=np.zeros(n, np.int64),
            threads=threads or Threads(),
        )

    def _sample_play(self) -> Play:
        """State of one world with one observer at an initial state, for reading sizes."""
        observer = 0 if "blue" in self.sides and self.n_blue else self.n_blue
        viewpoint = self.new_viewpoint([observer])
        play = self.new_play(1, viewpoint, WorldRng.seeded(0, 1))
        play.start(self.get_initial_positions_frame(play.rng).rows)
        return play
