"""A task, a policy and a simulator in which a chosen method raises an error."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from rsoccer import Matches, Simulator
from rsoccer.arrays import Array, Floats, Mask
from rsoccer.frame import Frame
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
    "start_episode",
)


class InjectedError(Exception):
    """Error of the chosen method."""


@dataclass
class Failure:
    """Name of the method that fails in its next call: of the task, "policy" or "simulator"."""

    method: str = ""

    def raise_in(self, name: str) -> None:
        if name == self.method:
            self.method = ""  # it fails once
            raise InjectedError(f"{name} fails")


@dataclass(frozen=True)
class FailingTask(Crowd):
    """A crowd with memory and random ends, in which the chosen method fails."""

    max_steps: int = 12
    failure: Failure = field(default_factory=Failure)

    def new_memory(self, n: int) -> dict[str, Array]:
        self.failure.raise_in("new_memory")
        return {"count": np.zeros(n, np.int64)}

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = super().get_initial_positions_frame(rng)
        self.failure.raise_in("get_initial_positions_frame")
        return frame

    def start_episode(self, play: Play) -> None:
        self.failure.raise_in("start_episode")

    def get_commands(self, play: Play, actions: Floats) -> Floats:
        self.failure.raise_in("get_commands")
        return super().get_commands(play, actions)

    def reposition_ball(self, frame: Frame) -> tuple[NDArray[np.intp], Floats] | None:
        self.failure.raise_in("reposition_ball")
        return None

    def frame_to_observations(self, play: Play) -> dict[str, Floats]:
        self.failure.raise_in("frame_to_observations")
        return super().frame_to_observations(play)

    def calculate_reward_and_done(self, play: Play) -> tuple[dict[str, Floats], Mask]:
        play.memory["count"] += 1
        self.failure.raise_in("calculate_reward_and_done")
        terms, done = super().calculate_reward_and_done(play)
        return terms, done | (play.rng.uniform(0.0, 1.0) < 0.05)

    def metrics(self, play: Play) -> dict[str, Floats]:
        self.failure.raise_in("metrics")
        return super().metrics(play)


class FailingPolicy(Policy):
    """A policy with random numbers and memory that fails if it is chosen."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def __init__(self, failure: Failure) -> None:
        super().__init__()
        self._fuse = failure

    def new_memory(self, shape: tuple[int, int, int], rng: WorldRng) -> Memory:
        return {"drawn": np.zeros((shape[0], 1), np.float32)}

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        memory["drawn"] += rng.uniform(0.0, 1.0, (1,))
        self._fuse.raise_in("policy")
        return rng.uniform(-1.0, 1.0, inputs.action_shape[1:])


class FailingSimulator:
    """A simulator that fails, if it is chosen, after all its worlds have stepped."""

    def __init__(self, task: FailingTask, worlds: int) -> None:
        self._own, self._fuse = Simulator(task.config, worlds), task.failure
        self.place, self.restart = self._own.place, self._own.restart
        self.reposition_balls = self._own.reposition_balls
        self.snapshot, self.restore = self._own.snapshot, self._own.restore

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> None:
        self._own.step(commands, out, active)
        self._fuse.raise_in("simulator")


def failing_matches(worlds: int = 4, autoreset: str = "same_step") -> tuple[Matches, Failure]:
    """Matches in progress, and the switch that makes them fail."""
    task = FailingTask()
    matches = Matches(
        task,
        worlds,
        seed=3,
        controllers={"yellow": FailingPolicy(task.failure)},
        autoreset=autoreset,
        simulator=FailingSimulator(task, worlds),
    )
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(7):
        matches.step(pushing(rng, matches))
    return matches, task.failure
