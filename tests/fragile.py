"""A task, a policy and a simulator that fail when they are told to."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rsoccer import Matches, Simulator
from rsoccer.frame import Array, Floats, Frame, Mask
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.rng import WorldRng
from rsoccer.task import Play
from tests.helpers import Crowd, pushing

METHODS = (
    "get_commands",
    "reposition_ball",
    "calculate_reward_and_done",
    "frame_to_observations",
    "metrics",
    "new_memory",
    "get_initial_positions_frame",
)


class Broken(Exception):
    """What fails here."""


@dataclass
class Fuse:
    """Says when what fails: the name of a method, or of what stands in for it."""

    armed: str = ""

    def burn(self, name: str) -> None:
        if name == self.armed:
            self.armed = ""  # once
            raise Broken(f"{name} fails")


@dataclass(frozen=True)
class Fragile(Crowd):
    """A crowd with memory and chance, of which any method fails when it is told to."""

    max_steps: int = 12
    fuse: Fuse = field(default_factory=Fuse)

    def new_memory(self, n: int) -> dict[str, Array]:
        self.fuse.burn("new_memory")
        return {"count": np.zeros(n, np.int64)}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        self.fuse.burn("get_initial_positions_frame")
        return frame

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        self.fuse.burn("get_commands")
        return super().get_commands(play, actions)

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        self.fuse.burn("reposition_ball")
        return None

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        self.fuse.burn("frame_to_observations")
        return super().frame_to_observations(play)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["count"] += 1
        self.fuse.burn("calculate_reward_and_done")
        terms, done = super().calculate_reward_and_done(play)
        return terms, done | (play.rng.uniform(0.0, 1.0) < 0.05)

    def metrics(self, play: Play) -> dict[str, Floats]:
        self.fuse.burn("metrics")
        return super().metrics(play)


class FragilePolicy(Policy):
    """Draws, counts, and fails when it is told to."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, fuse: Fuse) -> None:
        super().__init__()
        self._fuse = fuse

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"drawn": np.zeros((shape[0], 1), np.float32)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        memory["drawn"] += rng.uniform(0.0, 1.0, (1,))
        self._fuse.burn("policy")
        return rng.uniform(-1.0, 1.0, inputs.action_shape[1:])


class FragileSimulator:
    """The simulator, of which world 1 is lost when it is told so; the others have stepped."""

    def __init__(self, task: Fragile, worlds: int) -> None:
        self._own, self._fuse = Simulator(task.config, worlds), task.fuse
        self.place, self.reposition_balls = self._own.place, self._own.reposition_balls
        self.snapshot, self.restore = self._own.snapshot, self._own.restore

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._own.step(commands, out, active)
        self._fuse.burn("simulator")


def fragile(worlds: int = 4, autoreset: str = "same_step") -> tuple[Matches, Fuse]:
    """Matches under way, and what makes them fail."""
    task = Fragile()
    matches = Matches(
        task,
        worlds,
        seed=3,
        controllers={"yellow": FragilePolicy(task.fuse)},
        autoreset=autoreset,
        simulator=FragileSimulator(task, worlds),
    )
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(7):
        matches.step(pushing(rng, matches))
    return matches, task.fuse
