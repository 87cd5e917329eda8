"""New states of worlds for a task, before their episodes begin."""

from collections.abc import Sequence

import numpy as np

from rsoccer import checks, task_checks
from rsoccer._core import Threads
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import Events, new_game
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.rules.base import columns
from rsoccer.task_definition import TaskDefinition
from rsoccer.view import Viewpoint


def new_viewpoint(task: TaskDefinition, observers: Sequence[int]) -> Viewpoint:
    """Return the converter from frames to the views of some robots.

    Args:
        task: the task.
        observers: indices of robots in the order of a state row.
    """
    return Viewpoint(task.config.n_blue, task.config.n_yellow, observers, task.sides)


def new_play(
    task: TaskDefinition,
    n: int,
    viewpoint: Viewpoint,
    rng: WorldRng,
    threads: Threads | None = None,
) -> Play:
    """Return the state of n worlds, with new memory and empty frames.

    Args:
        task: the task.
        n: number of worlds.
        viewpoint: defines the observers.
        rng: (n,) random streams of the task.
        threads: threads that share the work on many worlds; None for the caller's alone.

    Returns:
        State whose frames are still to be filled, by `Play.start`.

    Raises:
        TypeError: memory of the task that is no mapping.
        ValueError: memory of the task or a column of a rule whose first axis is not n.
    """
    config = task.config
    robots = config.n_blue + config.n_yellow
    return Play(
        frame=Frame.empty(n, config.n_blue, config.n_yellow),
        last_frame=Frame.empty(n, config.n_blue, config.n_yellow),
        commands=np.zeros((n, robots, len(config.command_columns)), np.float32),
        actions=np.zeros((n, robots, task.action_size), np.float32),
        rng=rng,
        memory=checks.memory(task_checks.label(task, "new_memory"), task.new_memory(n), n),
        game=new_game(n, columns(task.rules, n)),
        events=Events.empty(n),
        viewpoint=viewpoint,
        steps=np.zeros(n, np.int64),
        threads=threads or Threads(),
    )


def initial_rows(task: TaskDefinition, rng: WorldRng) -> Floats:
    """Return initial states of episodes as the task draws them, (n, row).

    Args:
        task: the task.
        rng: (n,) random streams.

    Raises:
        TypeError: the task returned no frame.
        ValueError: a frame of other robots or of another number of worlds.
    """
    return task_checks.initial_rows(task, task.get_initial_positions_frame(rng), len(rng))


def sample_play(task: TaskDefinition) -> Play:
    """Return one world with one observer at an initial state, for reading sizes.

    Args:
        task: the task.
    """
    n_blue = task.config.n_blue
    observer = 0 if "blue" in task.sides and n_blue else n_blue
    play = new_play(task, 1, new_viewpoint(task, [observer]), WorldRng.seeded(0, 1))
    play.start(initial_rows(task, play.rng))
    return play
