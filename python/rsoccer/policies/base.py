"""What drives a robot that does not learn: one interface for scripts, noise and networks."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Literal

from rsoccer.frame import Array, Floats
from rsoccer.rng import WorldRng
from rsoccer.view import View

Memory = dict[str, Array]


@dataclass
class Seen:
    """What a policy is shown of the robots that it drives, in order."""

    shape: tuple[int, int, int]  # (n, robots, action): the shape of the actions to return
    view: View | None  # (n, robots, ...) unless it observes "nothing"
    observations: Floats | None  # (n, robots, o) if it observes "observation"


class Policy(ABC):
    """Drives some robots of each world. Holds no state of a match: that lives in `memory`."""

    observes: Literal["nothing", "view", "observation"]

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        """What it remembers when episodes start; arrays (n, ...), for shape (n, robots, action)."""
        return {}

    @abstractmethod
    def act(self, seen: Seen, rng: WorldRng, memory: Memory) -> Floats:
        """(n, robots, action) in [-1, 1]. Writes what it wants to remember into `memory`."""
