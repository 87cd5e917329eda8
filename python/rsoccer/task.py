"""Base class of tasks: the author's definition, and what everything else reads of a task."""

from functools import cached_property

from rsoccer import task_checks
from rsoccer.frame import robot_names, team_of
from rsoccer.observation_layout import ObservationLayout
from rsoccer.play import Play
from rsoccer.task_definition import LEARN, Learn, TaskDefinition
from rsoccer.view import SIDES

__all__ = ["LEARN", "Learn", "Play", "Task"]


class Task(TaskDefinition):
    """Base class of tasks, batched over `n` worlds.

    A subclass defines what `TaskDefinition` requires: `action_size`, `max_steps`, `config` and four
    methods. `rsoccer.testing.check_task` tests it for common mistakes.

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
        controllers = task_checks.controllers(self)
        return tuple(name for name in self.robots if controllers[name] is LEARN)

    @property
    def two_sided(self) -> bool:
        """True where yellow can play blue's part, that is, where both teams learn.

        Such a task is evaluated from both sides, with `success` above 0 where blue has won, and
        below 0 where yellow has.
        """
        learning = {team_of(name) for name in self.agents}
        return set(SIDES) <= learning.intersection(self.sides)

    @cached_property
    def layout(self) -> ObservationLayout:
        """Layout of the flat observation: blocks, sizes, bounds."""
        return ObservationLayout(self)
