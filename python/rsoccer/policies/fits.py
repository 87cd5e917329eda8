"""Checks that a network fits the observations and actions of a task."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rsoccer.history import ObservationStack

if TYPE_CHECKING:
    from rsoccer.task import Task


def check_fits(
    network: str,
    sizes: Mapping[str, int],
    layout: str | None,
    history: int,
    task: Task,
    observation_size: int,
) -> None:
    """Check that a network can play a task.

    Args:
        network: the network in words, such as "a network trained on 'VSS-v0'".
        sizes: its `observation_size`, a stacked one with a history, and its `action_size`.
        layout: text of the observation blocks that it observes; None if they are not known.
        history: observations in a stacked one.
        task: the task to be played.
        observation_size: numbers in one robot's plain observation.

    Raises:
        ValueError: the task has other observations or actions.
    """
    stacked = ObservationStack(history, observation_size, task.action_size).size
    wanted = {"observation_size": stacked, "action_size": task.action_size}
    known = "" if layout is None else f"the network observes {layout}, "
    stacking = f" with a history of {history}" if history > 1 else ""
    for name, size in sizes.items():
        if size != wanted[name]:
            raise ValueError(
                f"{network} has {name} {size}, but task {task.name!r}{stacking} has "
                f"{wanted[name]}: {known}the observations of the task are {task.layout.text}"
            )
    if layout not in (None, task.layout.text):
        raise ValueError(
            f"{network} observes {layout}, "
            f"but the observations of task {task.name!r} are {task.layout.text}"
        )
