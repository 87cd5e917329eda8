"""Check of a task by its author: `check_task(MyTask())`.

Typical faults of batched tasks do not show in a single match: a forgotten axis, state on self, a
world that reads another world's numbers. First each method is called by itself, so that an error
names the cause. Then the same worlds are played in a batch and alone, and every bit is compared.
Some faults need contacts, so the robots also drive at the ball.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

import numpy as np

from rsoccer import task_checks
from rsoccer.arrays import Floats, Mask
from rsoccer.controllers import Controller, resolve
from rsoccer.frame import team_of
from rsoccer.matches import Matches
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.registry import check_overrides, copied
from rsoccer.rng import WorldRng
from rsoccer.rules import Restart
from rsoccer.rules.base import begin
from rsoccer.task import LEARN, Play, Task
from rsoccer.testing.errors import TaskError, expect
from rsoccer.testing.kept_state import KeptState
from rsoccer.testing.limit_check import Excesses
from rsoccer.testing.match_check import check_batch, check_history
from rsoccer.testing.method_check import check_method, check_reading
from rsoccer.testing.method_results import (
    DURING_EPISODES,
    INITIAL_POSITIONS,
    NEW_MEMORY,
    RULES,
    RULES_BEGIN,
    START_EPISODE,
)
from rsoccer.testing.pressure import Pressing
from rsoccer.testing.reflection_check import check_reflection
from rsoccer.testing.senses_check import check_senses

PRESSURE_WORLDS: Final = 8
"""Worlds of the check under pressure per compared world; faults that need contacts are rare."""
CHECKED_STATES: Final = 20
"""States under pressure in which every method is checked by itself."""


def check_task(task: Task, worlds: int = 7, steps: int = 200, seed: int = 3) -> None:
    """Check that a task keeps the rules of batches and of reproducibility.

    Each method is checked by itself, on states of the start, of play and of ends of episodes:

    - It returns arrays of the documented shapes, float32 and finite. So is an `action_table`.
    - It only reads: frames, views, actions and commands never change. Memory changes in
      `start_episode` and `calculate_reward_and_done` alone, and keeps the names, shapes and types
      of `new_memory`. `play.game` and `play.events` change in the rules alone.
    - It keeps no state on self or on the class, and draws no global random numbers. Two calls with
      the same state return the same. `metrics` and `markers` do not draw.
    - Commands and observations follow from `play.sensed`, rules, rewards, ends and metrics from
      `play.frame`.
    - A world of a batch gets what it gets alone, and so many random numbers.
    - What a robot gets does not depend on which other robots observe.

    Then whole matches are played:

    - No method raises while every learner drives at the ball, so that robots press on each other
      and on walls and the ball leaves the field.
    - Half of the numbers of an observation or more are within its limits, beyond which they are
      clipped.
    - The reflections of `symmetry` are true.
    - Row i of a batch equals a single world seeded `seed + i`, bit for bit, in every autoreset mode
      and through resets of some worlds. An episode after others equals the same episode in fresh
      matches.

    Args:
        task: the task to check; it does not change.
        worlds: number of compared worlds, at least 2.
        steps: control steps of each part of the check. The time limit of episodes is shortened
            to a part of them, so that episodes end.
        seed: seed of the first world, at least 0.

    Raises:
        TaskError: a rule is broken, or no episode ended within the steps.
        ValueError: less than two worlds.

    Example:
        >>> import rsoccer
        >>> from rsoccer.testing import check_task
        >>> check_task(rsoccer.make_task("VSS-v0"), worlds=2, steps=40)
    """
    if worlds < 2:
        raise ValueError(f"worlds: expected at least 2, to compare neighbors, got {worlds}")
    long, task = _with_time_limit(task, steps), _with_time_limit(task, max(2, steps // 5))
    _check_definition(task)
    _check_start(task, worlds, seed)
    _check_pressure(long, worlds, steps, seed)
    kept = KeptState(task)
    try:
        check_reflection(task, PRESSURE_WORLDS * worlds, seed)
        for autoreset, divisor in {"same_step": 1, "next_step": 2, "disabled": 2}.items():
            check_batch(task, worlds, max(4, steps // divisor), seed, autoreset)
        check_history(task, worlds, steps // 2, seed)
    except TaskError:
        kept.expect_unchanged("it")  # the cause, if it shows in rare states alone
        raise
    kept.expect_unchanged("it")


def _with_time_limit(task: Task, max_steps: int) -> Task:
    """Copy of a task with a time limit so short that episodes end during the check."""
    limited = copied(task)
    vars(limited)["max_steps"] = min(task.max_steps, max_steps)
    return limited


def _check_definition(task: Task) -> None:
    """Check what matches check before they begin: options, attributes, controllers, sizes."""
    try:
        check_overrides(type(task))
        task_checks.definition(task)
        resolve(task, None)
    except (TypeError, ValueError) as error:
        raise TaskError(str(error)) from error
    kind = np.float32 if task.action_table is None else task.action_table.dtype
    expect(kind == np.float32, f"action_table: expected float32 numbers, got {kind}")


def _check_layout(task: Task) -> None:
    """Check the blocks of the observation and their bounds, from which the layout follows."""
    try:
        task.layout  # noqa: B018  (computed here)
    except Exception as error:
        if str(error).startswith(f"{type(task).__name__}."):
            raise TaskError(str(error)) from error
        # Otherwise the method has raised: its own check says so.


def _check_start(task: Task, worlds: int, seed: int) -> None:
    """Check the methods that begin episodes, and all others in the first state."""
    observers = [i for i, name in enumerate(task.robots) if team_of(name) in task.sides]
    rng = WorldRng.seeded(seed, worlds)
    try:
        play = new_play(task, worlds, new_viewpoint(task, observers), rng)
    except (TypeError, ValueError) as error:  # of the memory, which it names
        raise TaskError(str(error)) from error
    check_method(task, NEW_MEMORY, play)
    check_method(task, INITIAL_POSITIONS, play)
    frame = task.get_initial_positions_frame(play.rng)
    _check_fresh_starts(task, frame.rows, play.rng, seed)
    play.start(frame.rows)
    check_method(task, START_EPISODE, play)
    task.start_episode(play)
    check_method(task, RULES_BEGIN, play)
    begin(task.rules, play, np.arange(worlds))
    _check_layout(task)
    for method in DURING_EPISODES:
        check_method(task, method, play)


def _check_fresh_starts(task: Task, first: Floats, rng: WorldRng, seed: int) -> None:
    """Check that draws of an initial state advance the streams, so that episodes differ."""
    second = task.get_initial_positions_frame(rng).rows
    others = task.get_initial_positions_frame(WorldRng.seeded(seed + 1000, len(rng))).rows
    random = not np.array_equal(first, others)
    expect(
        not (random and np.array_equal(first, second)),
        "get_initial_positions_frame: every episode of a world starts alike; its draws do not "
        "advance rng, as those of rng.split and of rng[...] without rng.put",
    )


def _check_pressure(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Check that no method raises while all learners drive at the ball, and each by itself."""
    excesses, states = Excesses(task), 0
    for step, play, ending in _pressed(task, PRESSURE_WORLDS * worlds, steps, seed):
        # Each time other worlds, but first of all those that have just ended.
        order = (np.arange(len(ending)) + step * worlds) % len(ending)
        part = play.take(order[np.argsort(~ending[order], kind="stable")][:worlds])
        with _under_pressure(step):
            check_reading(task, part)
            excesses.count(play)
            if states < CHECKED_STATES and (ending.any() or step in (5, 25)):
                states += 1
                for method in DURING_EPISODES:
                    check_method(task, method, part)
                check_senses(task, part)
    excesses.check()


def _pressed(task: Task, worlds: int, steps: int, seed: int) -> Iterator[tuple[int, Play, Mask]]:
    """Each step, its state, and the mask (n,) of the matches that ended in it."""
    controllers: dict[str, Controller] = {
        name: LEARN for name in task.robots if team_of(name) in task.sides
    }
    matches = _CheckedRestarts(task, worlds, seed, controllers=controllers, autoreset="disabled")
    pressing, kept = Pressing(task, seed), KeptState(task)
    matches.reset()
    for step in range(steps):
        with _under_pressure(step):
            try:
                if matches.done.any():
                    matches.reset(mask=matches.done)
                outcome = matches.step(pressing.actions(matches))
            except TaskError:
                raise
            except Exception as error:
                kept.expect_unchanged("it")
                check_reading(task, matches.play)  # it names the method
                raise TaskError(f"{type(error).__name__}: {error}") from error
        yield step, matches.play, outcome.ended
    kept.expect_unchanged("it")


class _CheckedRestarts(Matches):
    """Matches that check the rules on the first states in which play restarts."""

    _checked = 0

    def _judge(self) -> list[Restart]:
        before = self.play.take(np.arange(self.worlds))
        restarts = super()._judge()
        stopped = [world for restart in restarts for world in restart.worlds.tolist()]
        if stopped and self._checked < CHECKED_STATES:
            self._checked += 1
            order = np.unique([*stopped, 0, 1])  # two worlds at least
            check_method(self.task, RULES, before.take(order))
        return restarts


@contextmanager
def _under_pressure(step: int) -> Iterator[None]:
    """Say in errors when they happened."""
    try:
        yield
    except TaskError as error:
        raise TaskError(
            f"{error} (in step {step} under pressure, when all drive at the ball)"
        ) from error
