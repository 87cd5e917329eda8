"""Tasks, actions and comparisons for tests of several areas."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from rsoccer import SimConfig
from rsoccer.arrays import Array, Floats
from rsoccer.controllers import Controllers
from rsoccer.evaluate import Interval, Results
from rsoccer.frame import Frame
from rsoccer.matches import Matches
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.tasks import VssSelfPlay
from rsoccer.vectors import norm


@dataclass(frozen=True)
class Crowd(VssSelfPlay):
    """All robots start close to the ball, in front of a goal: contacts in every step, and goals."""

    max_steps: int = 40

    def get_initial_positions_frame(self, rng: WorldRng) -> Frame:
        frame = Frame.empty(len(rng), self.n_blue, self.n_yellow)
        angle = rng.uniform(0.0, 1.0)[:, None] + np.linspace(0.0, 2.0 * np.pi, 6, endpoint=False)
        center = (
            np.array([0.55, 0.05], np.float32) * np.where(rng.uniform(-1, 1) < 0, -1, 1)[:, None]
        )
        ring = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * 0.12
        frame.ball.position[:] = center
        frame.robots.position[:] = center[:, None] + ring[:, : self.n_blue + self.n_yellow]
        frame.robots.heading[:] = -ring / 0.12
        return frame


def ssl_crowd(task: Task, rng: WorldRng) -> Frame:
    """Initial positions like those of `Crowd`, for a task with SSL robots."""
    frame = Frame.empty(len(rng), task.n_blue, task.n_yellow)
    robots = task.n_blue + task.n_yellow
    angle = rng.uniform(0.0, 1.0)[:, None] + np.linspace(0.0, 2.0 * np.pi, robots, endpoint=False)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=-1).astype(np.float32)
    center = np.array([0.4, 0.05], np.float32)  # no task ends here in its first step
    frame.ball.position[:] = center
    frame.robots.position[:] = center + ring * np.float32(max(0.13, 0.032 * robots))
    frame.robots.heading[:] = -ring
    return frame


def touches(frame: Frame, config: SimConfig) -> int:
    """Number of pairs that certainly touch: their inscribed circles are within a millimeter."""
    robot = config.robot
    # Round robots meet the ball with a flat front, and each other as discs.
    half, front = (
        (robot.radius, robot.front_distance) if robot.has_mouth else (robot.side_length / 2,) * 2
    )
    robots, ball = frame.robots.position, frame.ball.position[:, None]
    to_ball = _distances(robots, ball) < front + config.ball.radius + 1e-3
    to_robots = _distances(robots[:, :, None], robots[:, None]) < 2 * half + 1e-3
    return int(to_ball.sum()) + int(np.triu(to_robots, 1).sum())


def body_columns(task: Task) -> slice:
    """Columns of an observation with positions and velocities: others are at their limits."""
    blocks = task.layout.blocks
    others = [blocks[name].columns.start for name in ("presence", "action") if name in blocks]
    return slice(0, min(others))


def pushing(rng: np.random.Generator, matches: Matches) -> Floats:
    """Random actions (n, agents, action), mostly forward, so that robots meet."""
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    actions = rng.uniform(-0.3, 1.0, shape).astype(np.float32)
    if matches.action_size >= 5:  # SSL: turns are small and kicks rare, so that the ball stays near
        actions[..., 2] *= 0.2
        actions[..., 3] -= 0.95
    return actions


def zeros(matches: Matches) -> Floats:
    """Actions of zeros."""
    return np.zeros((matches.worlds, len(matches.agents), matches.action_size), np.float32)


def begun(
    task: Task | None = None,
    worlds: int = 5,
    seed: int = 0,
    threads: int = 1,
    controllers: Controllers | None = None,
    autoreset: str = "same_step",
) -> Matches:
    """Matches after their first reset."""
    task = task or VssSelfPlay()
    matches = Matches(task, worlds, seed, threads, controllers=controllers, autoreset=autoreset)
    matches.reset()
    return matches


def bounds(found: Results | Interval) -> tuple[float, float]:
    """Return the interval of a mean, which must have one."""
    assert found.low is not None and found.high is not None, "too few matches"
    return found.low, found.high


def comparable(value: Any) -> Any:  # noqa: ANN401
    """Value that `==` compares to the last bit: arrays as bytes, containers by element."""
    if isinstance(value, dict):
        return {key: comparable(part) for key, part in value.items()}
    if isinstance(value, tuple | list):
        return [comparable(part) for part in value]
    if isinstance(value, np.ndarray) and value.dtype == np.object_:
        return ("objects", [comparable(part) for part in value])
    return (value.dtype.str, value.shape, value.tobytes()) if hasattr(value, "tobytes") else value


def same(a: Array, b: Array) -> bool:
    """Compare every bit."""
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()


def _distances(a: Floats, b: Floats) -> Floats:
    x, y = a[..., 0] - b[..., 0], a[..., 1] - b[..., 1]
    return norm(x, y)
