"""Check of a task that claims to be the same with left and right swapped."""

from __future__ import annotations

from typing import Final

import numpy as np

from rsoccer._core import CROSSINGS, Simulator
from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.new_play import initial_rows, new_play, new_viewpoint
from rsoccer.rng import WorldRng
from rsoccer.task import Play, Task
from rsoccer.testing.errors import TaskError

STEPS: Final = 3
"""Control steps from the start that are compared."""
TOLERANCE: Final = 1e-3
"""Largest difference that counts as rounding, relative to 1 or to the number."""

_LEFT, _RIGHT = CROSSINGS.index("touch_line_left"), CROSSINGS.index("touch_line_right")


def check_reflection(task: Task, worlds: int, seed: int) -> None:
    """Check `symmetry`: from reflected starts, reflected actions lead to the reflected match.

    A task that draws random numbers in `start_episode` is not checked: they are not reflected.

    Args:
        task: the task.
        worlds: number of worlds.
        seed: seed of the first world.

    Raises:
        TaskError: commands, observations, rewards or ends are not as the task claims.
    """
    symmetry = task.symmetry
    if symmetry is None or task.layout.reflection is None:
        return
    ours = _begin(task, worlds, seed, None)
    if (ours.rng.state != WorldRng.seeded(seed, worlds).state).any():
        return
    theirs = _begin(task, worlds, seed, reflected(ours.frame).rows)
    simulators = [Simulator(task.config, worlds) for _ in (ours, theirs)]
    for simulator, play in zip(simulators, (ours, theirs), strict=True):
        rows = play.frame.rows.copy()
        simulator.place(np.ones(worlds, np.bool_), rows, out=play.frame.rows)
    rng = np.random.default_rng(seed)
    for _ in range(STEPS):
        _compare_observations(task, ours, theirs)
        actions = rng.uniform(-0.5, 1.0, ours.actions.shape).astype(np.float32)
        _advance(task, simulators[0], ours, actions)
        _advance(task, simulators[1], theirs, symmetry.action.apply(actions))
        met = (ours.frame.robots.collision_speed + ours.frame.robots.touched_ball).any(axis=1)
        here, there = reflected(ours.frame).rows, theirs.frame.rows
        free = ~met  # solvers round in contacts
        _expect_close(here[free], there[free], "symmetry.action: the states that follow")
        # From here on only the task is compared, not the physics.
        theirs.frame.rows[:], theirs.last_frame.rows[:] = here, reflected(ours.last_frame).rows
        theirs.expire_views()
        _compare_rewards(task, ours, theirs)


def _begin(task: Task, worlds: int, seed: int, rows: Floats | None) -> Play:
    """The start of episodes, from rows or from the task's initial states."""
    observers = [task.robots.index(name) for name in task.agents]
    rng = WorldRng.seeded(seed, worlds)
    play = new_play(task, worlds, new_viewpoint(task, observers), rng)
    if rows is None:
        rows = initial_rows(task, WorldRng.seeded(seed, worlds))
    play.start(rows)
    task.start_episode(play)
    return play


def _advance(task: Task, simulator: Simulator, play: Play, actions: Floats) -> None:
    """One control step, without restarts."""
    play.commands = np.ascontiguousarray(task.get_commands(play, actions), np.float32)
    play.actions = actions
    simulator.step(play.commands, out=play.last_frame.rows)
    play.advance()
    play.steps += 1


def _compare_observations(task: Task, ours: Play, theirs: Play) -> None:
    layout = task.layout
    assert layout.reflection is not None, "a symmetric task"
    here, there = layout.reflection.apply(layout.observe(ours)), layout.observe(theirs)
    for name, block in layout.blocks.items():
        columns = block.columns
        _expect_close(here[..., columns], there[..., columns], f"symmetry.blocks: block {name!r}")


def _compare_rewards(task: Task, ours: Play, theirs: Play) -> None:
    (here, ended), (there, also_ended) = (
        task.calculate_reward_and_done(play) for play in (ours, theirs)
    )
    for name, term in here.items():
        _expect_close(term, there[name], f"symmetry: the reward term {name!r}")
    _expect_close(ended, also_ended, "symmetry: the end of episodes")


def _expect_close(here: Array, there: Array, what: str) -> None:
    if not np.allclose(here, there, TOLERANCE, TOLERANCE):
        raise TaskError(
            f"{what} is not that of the match with left and right swapped; correct it, or let "
            "symmetry return None"
        )


def reflected(frame: Frame) -> Frame:
    """Return the same state with y reversed, in new memory.

    Args:
        frame: state of n worlds.
    """
    other = frame.copy()
    for vectors in (
        *(other.ball.position, other.ball.velocity, other.ball.crossed_at),
        *(other.robots.position, other.robots.velocity, other.robots.heading),
    ):
        vectors[..., 1] *= -1
    other.robots.angular_velocity[...] *= -1
    other.ball.spin[..., [0, 2]] *= -1
    other.ball.crossed[frame.ball.crossed == _LEFT] = _RIGHT
    other.ball.crossed[frame.ball.crossed == _RIGHT] = _LEFT
    return other
