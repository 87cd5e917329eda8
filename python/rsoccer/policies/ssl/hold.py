"""Robots that keep the ball: they stand with the dribbler on, or turn to receive it."""

from typing import Final, Literal

import numpy as np

from rsoccer.frame import Floats, length
from rsoccer.policies.base import Memory, Policy, PolicyInput
from rsoccer.policies.vectors import TINY
from rsoccer.rng import WorldRng
from rsoccer.task import Task

TURN: Final = np.float32(1.5)  # share of the fastest turn, per sine of the angle it is off
TURN_COLUMN, KICK, DRIBBLER = 2, 3, 4  # of an SSL robot's action


def check_ssl(policy: str, task: Task) -> None:
    """Refuse tasks whose robots have no dribbler."""
    if "dribbler" not in task.config.command_columns or task.action_size != 5:
        raise ValueError(f"{policy} drives robots with a dribbler, which {task.name} has not")


class Hold(Policy):
    """Stands with the dribbler on."""

    observes: Literal["nothing", "view", "observation"] = "nothing"

    def __init__(self, task: Task) -> None:
        """Refuse a task of other robots."""
        super().__init__(task)
        check_ssl("hold", task)

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """No motion, no kick, dribbler on; (n, robots, 5)."""
        actions = np.zeros(inputs.action_shape, np.float32)
        actions[..., KICK] = -1.0
        actions[..., DRIBBLER] = 1.0
        return actions


class Receive(Hold):
    """Stands with the dribbler on and turns to the ball."""

    observes: Literal["nothing", "view", "observation"] = "view"

    def act(self, inputs: PolicyInput, rng: WorldRng, memory: Memory) -> Floats:
        """Turns by the sine of the angle that it is off; (n, robots, 5)."""
        actions = super().act(inputs, rng, memory)
        if inputs.view is None:
            raise ValueError("receive needs a view, got none")
        ego = inputs.view.ego
        way = inputs.view.ball.position - ego.position
        x, y = way[..., 0], way[..., 1]
        cos, sin = ego.heading[..., 0], ego.heading[..., 1]
        left = (y * cos - x * sin) / np.maximum(length(x, y), TINY)
        behind = x * cos + y * sin < 0.0
        left = np.where(behind, np.copysign(np.float32(1.0), left), left)
        actions[..., TURN_COLUMN] = np.minimum(np.maximum(left * TURN, -1.0), 1.0)
        return actions
