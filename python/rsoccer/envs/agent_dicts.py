"""Dictionaries by agent name to arrays of one match, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rsoccer import checks
from rsoccer.envs import spaces
from rsoccer.frame import Array, Floats
from rsoccer.task import Task


def stack(actions: Mapping[str, Array], agents: Sequence[str], task: Task) -> Array:
    """Actions side by side, (1, agents, action); what they hold is for `Matches` to check."""
    rows = [np.asarray(spaces.numbers(task, actions[agent])) for agent in agents]
    if len(actions) != len(agents) or any(row.dtype.kind != "f" for row in rows):
        raise ValueError("see name_fault")  # else one agent's integers would pass unseen
    return np.array([rows])


def split(agents: Sequence[str], rows: Floats) -> dict[str, Floats]:
    """Rows of `rows` (1, agents, ...) by name; views, so nobody else may hold that array."""
    return dict(zip(agents, rows[0], strict=True))


def name_fault(actions: object, agents: Sequence[str], task: Task) -> None:
    """Raise an error that names the agent whose action is missing, unknown or wrong, if any.

    Asked only after a failure: looking at each agent on its own costs more than a step's rest.
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
        try:
            row = spaces.numbers(task, actions[agent])
        except (TypeError, ValueError) as error:
            raise type(error)(name + str(error).removeprefix("actions")) from None
        checks.floats(name, row, (task.action_size,))
