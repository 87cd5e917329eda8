"""What drives a robot that does not learn: one interface for scripts, noise and networks."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal

from rsoccer._core import SimConfig
from rsoccer.frame import Array, Floats
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.view import View

Memory = dict[str, Array]


@dataclass
class PolicyInput:
    """What a policy is shown of the robots that it drives, in order."""

    action_shape: tuple[int, int, int]  # (n, robots, action): the shape of the actions to return
    view: View | None  # (n, robots, ...) unless it observes "nothing"
    observations: Floats | None  # (n, robots, o) if it observes "observation"


class Policy(ABC):
    """Drives some robots of each world. Holds no state of a match: that lives in `memory`."""

    observes: Literal["nothing", "view", "observation"]

    _made_for: tuple[SimConfig, tuple[str, ...]] | None = None  # what it knows; None: nothing

    def __init__(self, task: Task | None = None) -> None:
        """Know the field and the teams of `task`, or need to know none."""
        if task is not None:
            self._made_for = task.config, tuple(task.sides)

    @property
    def task_name(self) -> str | None:
        """Name of the task that it was trained on, for `make_task`; None if it was not trained."""
        return None

    @property
    def knows_task(self) -> bool:
        """Whether it was made for one field and its teams."""
        return self._made_for is not None

    def check_fits(self, task: Task, observation_size: int) -> None:
        """ValueError for a task of other robots, teams or another field than it was made for."""
        if self._made_for not in (None, (task.config, tuple(task.sides))):
            raise ValueError(
                f"policy: expected one for the field, robots and teams of {task.name}, got a "
                f"{type(self).__name__} that was made for others; make it for this task, "
                "or give its name"
            )

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """What it remembers when episodes start; arrays (n, ...), for shape (n, robots, action)."""
        return {}

    @abstractmethod
    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) in [-1, 1]. Writes what it wants to remember into `memory`."""
