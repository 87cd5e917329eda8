"""Checks that a network fits the observations and actions of a task."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from rsoccer.history import ObservationStack
from rsoccer.registry import list_tasks, make_task, options_of

if TYPE_CHECKING:
    from rsoccer.task import Task


def check_fits(
    network: str,
    sizes: Mapping[str, int],
    layout: str | None,
    history: int,
    task: Task,
    observation_size: int,
    trained: tuple[str, Mapping[str, Any]] | None = None,
) -> None:
    """Check that a network can play a task.

    Args:
        network: the network in words, such as "a network trained on 'VSS-v0'".
        sizes: its `observation_size`, a stacked one with a history, and its `action_size`.
        layout: text of the observation blocks that it observes; None if they are not known.
        history: observations in a stacked one.
        task: the task to be played.
        observation_size: numbers in one robot's plain observation.
        trained: name and options of the task that it was trained on; None if they are not known.

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
                f"{wanted[name]}{_what_it_plays(trained, task)}: {known}the observations of the "
                f"task are {task.layout.text}"
            )
    if layout not in (None, task.layout.text):
        raise ValueError(
            f"{network} observes {layout}, "
            f"but the observations of task {task.name!r} are {task.layout.text}"
            f"{_what_it_plays(trained, task)}"
        )


def _what_it_plays(trained: tuple[str, Mapping[str, Any]] | None, task: Task) -> str:
    """Words for the task that a network plays, where it does not fit `task`."""
    if trained is None or trained[0] not in list_tasks():
        return ""
    name, options = trained
    given = options_of(task) if task.name == name else None
    if given is None:
        shown = dict(options)
    else:  # the options that differ, with the values of the training
        usual = make_task(name)
        differing = [key for key in {**given, **options} if given.get(key) != options.get(key)]
        shown = {key: options[key] if key in options else getattr(usual, key) for key in differing}
    words = ", ".join(f"{key}={value!r}" for key, value in shown.items())
    return f"; it plays {name!r}" + (f" with {words}" if words else "")
