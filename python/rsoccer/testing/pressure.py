"""Actions under which robots press: every learner drives at the ball, and all meet there.

Random actions seldom do that: robots drift apart. Whoever learns drives at the ball soon, and keeps
on driving, also when robots, walls and ball are in the way.
"""

from typing import Final

import numpy as np

from rsoccer.frame import Array, Floats
from rsoccer.matches import Matches
from rsoccer.task import Task
from rsoccer.tasks.ssl import Ssl

NOISE: Final = 0.3  # on every number of an action: crowds that stir
KICKS: Final = 0.03  # share of actions of the SSL that kick
HELD: Final = 20  # steps for which a push lasts where nothing is known of what actions do


class Pressing:
    """Drives all learners of matches at the ball; random numbers are its own."""

    def __init__(self, task: Task, seed: int = 0) -> None:
        """Find out from its robots what the actions of `task` do."""
        self._rng = np.random.default_rng(seed)
        self._pushes: Floats = np.zeros((0, 0, 0), np.float32)
        self._steps = 0
        self._drive = _known_drive(task)

    def actions(self, matches: Matches) -> Floats:
        """What to do now, (n, agents, action)."""
        shape = (matches.worlds, len(matches.agents), matches.action_size)
        if self._drive == "unknown":
            return self._lasting(shape)
        ahead, left, x, y = _to_ball(matches)
        noise = self._rng.uniform(-NOISE, NOISE, shape)
        if self._drive == "wheels":
            way = np.stack([ahead - left, ahead + left], axis=-1)
            return _action(way + noise)
        if self._drive == "robot":
            x, y = ahead, left
        way = np.stack([x, y, left, np.full_like(x, -1.0), np.ones_like(x)], axis=-1) + noise
        kicks = self._rng.random(shape[:2]) < KICKS
        way[..., 3] = np.where(kicks, self._rng.random(shape[:2]), -1.0)
        return _action(way)

    def _lasting(self, shape: tuple[int, int, int]) -> Floats:
        """Pushes that last, mostly forward."""
        if self._steps % HELD == 0 or self._pushes.shape != shape:
            self._pushes = _action(self._rng.uniform(-0.5, 1.5, shape))
        self._steps += 1
        return self._pushes.copy()


def _action(numbers: Array) -> Floats:
    """Numbers as an action may have them."""
    action: Floats = np.clip(numbers, -1.0, 1.0).astype(np.float32)
    return action


def _known_drive(task: Task) -> str:
    """What the actions of a task ask of its robots, as its league's tasks have it, or "unknown"."""
    drives = {robot.drive for robot in task.config.robots}
    if drives == {"differential"} and task.action_size == 2:
        return "wheels"
    if drives == {"omni"} and isinstance(task, Ssl) and task.action_size == 5:
        return task.velocity_frame
    return "unknown"


def _to_ball(matches: Matches) -> tuple[Floats, Floats, Floats, Floats]:
    """The way from each learner to the ball, (n, agents): ahead, left, along x and y; length 1."""
    view = matches.play.view.select(matches.assignment.learner_indices)
    way = view.ball.position - view.ego.position
    x, y = np.moveaxis(way / np.maximum(np.linalg.norm(way, axis=-1, keepdims=True), 1e-6), -1, 0)
    cos, sin = view.ego.heading[..., 0], view.ego.heading[..., 1]
    return x * cos + y * sin, y * cos - x * sin, x, y
