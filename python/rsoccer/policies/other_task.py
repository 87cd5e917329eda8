"""Policies in tasks that they were not trained on: from skills to matches.

A robot that plays a whole match needs what it has learned in single attacks. Observations of tasks
of a league have the same blocks, and some have more of them, or more robots in a block. A policy
takes its weights along by the names of blocks, and numbers that it does not know get weights of 0.
A run of the trainer may begin with it, and `best` plays a match with it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.history import ObservationStack
from rsoccer.observation_layout import ObservationLayout
from rsoccer.policies.network import Network
from rsoccer.policies.shield import shield_error
from rsoccer.registry import options_of, task_with_options
from rsoccer.task import Task

Layers = list[tuple[Floats, Floats]]
"""Weight (out, in) and bias (out,) of each layer."""

SELF_AND_BALL: Final = 1
"""Rows of `body_positions` and `presence` before those of other robots: ball, and the robot."""
MIXED: Final = ("body_positions", "presence")
"""Blocks with a row for the ball or the robot, and then for each teammate and each opponent."""


def fitted(policy: Network, task: Task) -> Network:
    """Return a policy for a task with the weights of a policy of another task.

    Numbers of the task's observation and of its action that the policy does not have get weights
    of 0. Robots beyond those of the task are left out.

    Args:
        policy: a policy of another task of the league.
        task: the task to play or to train on.

    Returns:
        The policy for the task, in the same mode, with the same history, and with its shield if it
        may act there.

    Raises:
        ValueError: a policy of the other league, with other observations than those of its task,
            with another head than a plain Gaussian, or with an action that is longer than the
            task's.
    """
    source = task_with_options(policy.task_name, policy.task_options)
    old, new = source.layout, task.layout
    if old.text != policy.metadata.get("layout"):
        raise ValueError(
            "expected a policy whose task has the observations of its training, got one of "
            f"{policy.task_name!r} with others"
        )
    if policy.head.kind != "gaussian" or policy.head.deviation is not None:
        raise ValueError(
            "expected a policy with a plain Gaussian, whose weights another task can take along, "
            f"got the head {policy.head.kind!r}"
        )
    if source.config.command_columns != task.config.command_columns:
        raise ValueError(
            f"expected a policy of the league of {task.name}, got one of {policy.task_name}"
        )
    if policy.action_size > task.action_size:
        raise ValueError(
            f"expected a policy with at most the {task.action_size} numbers of an action of "
            f"{task.name}, got {policy.action_size}"
        )
    stack = ObservationStack(policy.history, old.size, policy.action_size)
    wider = ObservationStack(policy.history, new.size, task.action_size)
    from_columns, to_columns = _common_columns(old, new)
    actions = np.arange(policy.action_size)
    from_columns = stack.columns(policy.history, from_columns, actions)
    to_columns = wider.columns(policy.history, to_columns, actions)
    size = wider.size

    def widened(layers: Layers) -> Layers:
        """The same layers for the wider observation."""
        (weight, bias), *others = layers
        first = np.zeros((len(weight), size), np.float32)
        first[:, to_columns] = weight[:, from_columns]
        return [(first, bias), *others]

    mean, std = np.zeros(size, np.float32), np.ones(size, np.float32)
    mean[to_columns], std[to_columns] = policy.mean[from_columns], policy.std[from_columns]
    *hidden, (last, last_bias) = widened(policy.layers)
    more = task.action_size - policy.action_size
    last, last_bias = np.pad(last, ((0, more), (0, 0))), np.pad(last_bias, (0, more))
    deviation, value = policy.action_std, policy.value
    if value is not None:
        value = replace(value, layers=widened(value.layers))
    shield = policy.metadata.get("shield")
    if shield is not None and shield_error(shield, task) is not None:
        shield = None
    network = Network.from_layers(
        task,
        [*hidden, (last, last_bias)],
        None if deviation is None else np.pad(deviation, (0, more), mode="edge"),
        activation=policy.activation,
        action_repeat=policy.action_repeat,
        history=policy.history,
        mean=mean,
        std=std,
        clip=float(policy.clip),
        task_name=task.name,  # of a class that is not registered too: the result is to be played
        task_options=options_of(task),
        sensing=policy.sensing,
        randomization=policy.randomization,
        shield=shield,
        value=value,
    )
    network.mode = policy.mode
    return network


def _common_columns(old: ObservationLayout, new: ObservationLayout) -> tuple[Array, Array]:
    """Columns of the numbers that two layouts have in common, in each of them."""
    pairs = [
        (before.ravel(), after.ravel())
        for name in old.blocks
        if name in new.blocks
        for before, after in _common_rows(name, old, new)
    ]
    return np.concatenate([a for a, _ in pairs]), np.concatenate([b for _, b in pairs])


def _common_rows(
    name: str, old: ObservationLayout, new: ObservationLayout
) -> list[tuple[Array, Array]]:
    """Columns of the rows of a block that two layouts have in common."""
    before, after = _columns(old, name), _columns(new, name)
    if name not in MIXED:
        return [_shortened(before, after)]
    parts = []
    for first, last in zip(_starts(old), _starts(new), strict=True):
        parts.append(_shortened(before[slice(*first)], after[slice(*last)]))
    return parts


def _starts(layout: ObservationLayout) -> list[tuple[int, int]]:
    """First row, and the one after the last, of the parts of a mixed block."""
    counts = [
        layout.blocks[name].shape[0] if name in layout.blocks else 0
        for name in ("teammates", "opponents")
    ]
    ends = np.cumsum([SELF_AND_BALL, *counts]).tolist()
    return list(zip([0, *ends], ends, strict=False))


def _shortened(before: Array, after: Array) -> tuple[Array, Array]:
    """The common part of two arrays of columns."""
    common = tuple(slice(min(pair)) for pair in zip(before.shape, after.shape, strict=True))
    return before[common], after[common]


def _columns(layout: ObservationLayout, name: str) -> Array:
    """Columns of a block, in its shape."""
    block = layout.blocks[name]
    columns: Array = np.arange(layout.size)[block.columns].reshape(block.shape)
    return columns
