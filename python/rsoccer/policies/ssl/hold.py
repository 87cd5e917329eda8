"""The `hold` and `receive` policies: stand with the dribbler on."""

from typing import Final

import numpy as np

from rsoccer.arrays import Floats
from rsoccer.policies.base import Memory, Observes, Policy, PolicyInput
from rsoccer.policies.ssl.robot_control import DRIBBLER, KICK, TURN, require_dribbler
from rsoccer.rng import WorldRng
from rsoccer.task import Task
from rsoccer.vectors import TINY, norm, rotate_into_body

TURN_GAIN: Final = np.float32(1.5)  # share of the fastest turn, per sine of the heading error


class Hold(Policy):
    """A script that stands still with the dribbler on."""

    observes: Observes = "nothing"

    def __init__(self, task: Task) -> None:
        """Prepare the script for a task.

        Args:
            task: a task of robots with a dribbler.
        """
        super().__init__(task)
        require_dribbler(type(self).__name__.lower(), task)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, 5): no motion, no kick, dribbler on."""
        actions = np.zeros(inputs.action_shape, np.float32)
        actions[..., KICK] = -1.0
        actions[..., DRIBBLER] = 1.0
        return actions


class Receive(Hold):
    """A script that stands with the dribbler on and turns to the ball."""

    observes: Observes = "view"
    forecasts = True

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Return actions (n, robots, 5); the robots turn by the sine of the heading error."""
        actions = super().act(inputs, rng, memory)
        view = inputs.required_view("receive")
        to_ball = view.ball.position - view.ego.position
        x, y = to_ball[..., 0], to_ball[..., 1]
        ahead, left = rotate_into_body(x, y, view.ego.heading)
        sine = left / np.maximum(norm(x, y), TINY)
        sine = np.where(ahead < 0.0, np.copysign(np.float32(1.0), sine), sine)
        actions[..., TURN] = np.minimum(np.maximum(sine * TURN_GAIN, -1.0), 1.0)
        return actions
