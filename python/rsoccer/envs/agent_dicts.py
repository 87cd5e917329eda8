"""Conversion between dictionaries by agent name and arrays of one match."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rsoccer import checks, spaces
from rsoccer.arrays import Array, Floats
from rsoccer.task import Task


def stack_actions(actions: Mapping[str, Array], agents: Sequence[str], task: Task) -> Array:
    """Stack the actions of all agents.

    Args:
        actions: an element of the action space by agent name.
        agents: names of the agents, in the order of the array.
        task: the task that is played.

    Returns:
        (1, agents, action) actions; `Matches` checks their values.

    Raises:
        LookupError: an agent without an action.
        TypeError: actions of the wrong type.
        ValueError: a wrong number of actions, or of numbers in an action. `check_actions` names
            the agent.
    """
    rows = [checks.as_array(f"actions[{agent!r}]", actions[agent]) for agent in agents]
    if task.action_table is not None:
        rows = [spaces.action_vectors(task, row) for row in rows]
    if len(actions) != len(agents) or {row.dtype.kind for row in rows} != {"f"}:
        # Stacking would convert one agent's integers to floats without an error.
        raise ValueError("actions: see check_actions")
    return np.array([rows])


def split_by_agent(agents: Sequence[str], rows: Floats) -> dict[str, Floats]:
    """Return the rows of one match by agent name.

    Args:
        agents: names of the agents, in the order of the array.
        rows: (1, agents, ...) values; the dictionary holds views of this array.
    """
    return dict(zip(agents, rows[0], strict=True))


def check_actions(actions: object, agents: Sequence[str], task: Task) -> None:
    """Find the agent whose action is missing, unknown or wrong, if any.

    A check of each agent takes longer than the rest of a step outside the simulator, so it runs
    only after `stack_actions` or `Matches.step` failed.

    Args:
        actions: argument of `step`.
        agents: names of the agents.
        task: the task that is played.

    Raises:
        TypeError: not a dictionary, or an action of the wrong type.
        ValueError: a missing or unknown agent, or an action with a wrong shape or value.
    """
    if not isinstance(actions, Mapping):
        raise TypeError(f"actions: expected a dictionary by agent, got {type(actions).__name__}")
    missing = [agent for agent in agents if agent not in actions]
    unknown = [agent for agent in actions if agent not in agents]
    if missing or unknown:
        raise ValueError(
            f"actions: expected one for each of {list(agents)}, "
            f"missing {missing}, unknown {unknown}"
        )
    for agent in agents:
        name = f"actions[{agent!r}]"
        if task.action_table is not None and np.ndim(checks.as_array(name, actions[agent])):
            raise ValueError(f"{name}: expected a whole number, got {actions[agent]!r}")
        try:
            row = spaces.action_vectors(task, actions[agent])
        except (TypeError, ValueError) as error:
            raise type(error)(name + str(error).removeprefix("actions")) from None
        checks.floats(name, row, (task.action_size,))
