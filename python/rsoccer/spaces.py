"""Observation and action spaces of one agent, and the space of global states.

Actions are vectors of numbers in [-1, 1]. For a task with an `action_table`, an agent chooses the
index of one of the table's rows.
"""

from __future__ import annotations  # `Box` has parameters at run time since Gymnasium 1.4 only

from typing import TypeAlias

import numpy as np
from gymnasium.spaces import Box, Discrete

from rsoccer import checks
from rsoccer.arrays import Array, Floats
from rsoccer.global_state import LIMIT, StateEncoder
from rsoccer.history import ObservationStack
from rsoccer.task import Task

ActionSpace: TypeAlias = "Box[np.float32] | Discrete[np.int64]"


def observation_space(task: Task, history: int = 1) -> Box[np.float32]:
    """Return the observation space of one agent.

    Args:
        task: the task that is played.
        history: observations in a stacked one, at least 1; see `rsoccer.history`.

    Returns:
        Box (o,) float32 from `task.layout.low` to `task.layout.high`; `task.layout.blocks`
        names its parts. With a longer history, the bounds of the past observations and those of
        the past actions, -1 and 1, follow.

    Raises:
        TypeError: `history` is not a whole number.
        ValueError: it is below 1.
    """
    stack = ObservationStack.of(task, history)
    action = np.ones(task.action_size, np.float32)
    return Box(stack.join(task.layout.low, -action), stack.join(task.layout.high, action))


def action_space(task: Task) -> ActionSpace:
    """Return the action space of one agent.

    Args:
        task: the task that is played.

    Returns:
        Box (action,) float32 from -1 to 1; for a task with an `action_table`, Discrete with the
        number of its rows.
    """
    if task.action_table is None:
        return Box(-1.0, 1.0, (task.action_size,))
    return Discrete(len(task.action_table))


def state_space(task: Task) -> Box[np.float32]:
    """Return the space of the global state of one match.

    Args:
        task: the task that is played.

    Returns:
        Box (state,) float32 from -`LIMIT` to `LIMIT`; `StateEncoder` names its columns.
    """
    return Box(-LIMIT, LIMIT, (StateEncoder(task.config).size,))


def action_vectors(task: Task, actions: Array) -> Array:
    """Return actions as vectors.

    Args:
        task: the task that is played.
        actions: (..., action) vectors, returned unchanged; for a task with an `action_table`,
            (...) indices of its rows.

    Returns:
        (..., action) vectors.

    Raises:
        TypeError: indices that are not integers.
        ValueError: an index out of range.
    """
    table = task.action_table
    if table is None:
        return actions
    indices = checks.as_array("actions", actions)
    if indices.dtype.kind not in "iu":
        raise TypeError(f"actions: expected whole numbers, got {indices.dtype}")
    outside = (indices < 0) | (indices >= len(table))
    if outside.any():
        raise ValueError(f"actions: expected 0 to {len(table) - 1}, got {indices[outside].flat[0]}")
    vectors: Floats = table[indices]
    return vectors
