"""What agents may see and do, as spaces; and discrete choices as actions.

Inside, an action is a row of numbers in [-1, 1]. A task with an `action_table` lets each agent
choose one of its rows instead; only the front doors know.
"""

import numpy as np
from gymnasium.spaces import Box, Discrete

from rsoccer.frame import Array, Floats
from rsoccer.task import Task

ActionSpace = Box[np.float32] | Discrete[np.int64]


def observation_space(task: Task) -> Box[np.float32]:
    """Bounds of what an agent sees, (o,) float32."""
    return Box(task.observation_low, task.observation_high)


def action_space(task: Task) -> ActionSpace:
    """What an agent does: (action,) float32 in [-1, 1], or one of the rows of the task's table."""
    if task.action_table is None:
        return Box(-1.0, 1.0, (task.action_size,))
    return Discrete(len(task.action_table))


def numbers(task: Task, chosen: Array) -> Array:
    """Actions (..., action) for what agents chose: that itself, or rows of the table for ints."""
    table = task.action_table
    if table is None:
        return chosen
    choices = np.asarray(chosen)
    if choices.dtype.kind not in "iu":
        raise TypeError(f"actions: expected whole numbers, got {choices.dtype}")
    if ((choices < 0) | (choices >= len(table))).any():
        wrong = choices[(choices < 0) | (choices >= len(table))].flat[0]
        raise ValueError(f"actions: expected 0 to {len(table) - 1}, got {wrong}")
    rows: Floats = table[choices]
    return rows
