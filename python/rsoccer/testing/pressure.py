"""Actions that cause contacts: every learner drives at the ball, so robots press on each other.

Under random actions robots drift apart and contacts are rare. Trained robots drive at the ball and
keep driving while robots, walls and the ball are in the way; these actions do the same.
"""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.matches import Matches
from rsoccer.task import Task
from rsoccer.tasks.ssl import Ssl
from rsoccer.vectors import rotate_into_body

NOISE: Final = 0.3
"""Half width of the uniform noise on every number of an action."""
KICK_FRACTION: Final = 0.03
"""Fraction of the SSL robots' actions that kick."""
PUSH_STEPS: Final = 20
"""Control steps between new random actions where the meaning of actions is unknown."""


class Pressing:
    """Actions that drive all learners of matches at the ball, with random streams of their own."""

    def __init__(self, task: Task, seed: int = 0) -> None:
        """Find the meaning of the task's actions.

        Args:
            task: the task that is played. The actions of wheels and of SSL velocities are known;
                any other robots get random actions, mostly forward, that last `PUSH_STEPS` steps.
            seed: seed of the noise.
        """
        self._rng = np.random.default_rng(seed)
        self._pushes: Floats = np.zeros((0, 0, 0), np.float32)
        self._steps = 0
        self._action_kind = _action_kind(task)

    def actions(self, matches: Matches) -> Floats:
        """Return the actions of the next step.

        Args:
            matches: matches of the task.

        Returns:
            (n, agents, action) float32 in [-1, 1].
        """
        shape = (matches.worlds, len(matches.agents), matches.action_size)
        if self._action_kind == "unknown":
            return self._lasting_pushes(shape)
        ahead, left, x, y = _directions_to_ball(matches)
        noise = self._rng.uniform(-NOISE, NOISE, shape)
        if self._action_kind == "wheels":
            wheels = np.stack([ahead - left, ahead + left], axis=-1)
            return _clipped(wheels + noise)
        if self._action_kind == "robot":
            x, y = ahead, left
        action = noise  # of a chip kick, where the task has it, nothing else
        action[..., :5] += np.stack([x, y, left, np.full_like(x, -1.0), np.ones_like(x)], axis=-1)
        kicks = self._rng.random(shape[:2]) < KICK_FRACTION
        action[..., 3] = np.where(kicks, self._rng.random(shape[:2]), -1.0)
        return _clipped(action)

    def _lasting_pushes(self, shape: tuple[int, int, int]) -> Floats:
        """Random actions, mostly forward, that change every `PUSH_STEPS` steps."""
        if self._steps % PUSH_STEPS == 0 or self._pushes.shape != shape:
            self._pushes = _clipped(self._rng.uniform(-0.5, 1.5, shape))
        self._steps += 1
        return self._pushes.copy()


def _clipped(numbers: Array) -> Floats:
    """Actions within [-1, 1], float32."""
    actions: Floats = np.clip(numbers, -1.0, 1.0).astype(np.float32)
    return actions


def _action_kind(task: Task) -> str:
    """Meaning of a task's actions: "wheels", velocities in "field" or "robot", or "unknown"."""
    drives = {robot.drive for robot in task.config.robots}
    if drives == {"differential"} and task.action_size == 2:
        return "wheels"
    if drives == {"omni"} and isinstance(task, Ssl) and task.action_size in (5, 6):
        return task.velocity_frame
    return "unknown"


def _directions_to_ball(matches: Matches) -> tuple[Floats, Floats, Floats, Floats]:
    """Unit vectors (n, agents) from each learner to the ball: ahead, left, and along x, y."""
    view = matches.play.sensed_view.select(matches.assignment.learner_indices)
    offset = view.ball.position - view.ego.position
    distance = np.maximum(np.linalg.norm(offset, axis=-1, keepdims=True), 1e-6)
    x, y = np.moveaxis(offset / distance, -1, 0)
    return *rotate_into_body(x, y, view.ego.heading), x, y
