"""Check of a task by its author: `check_task(MyTask())`.

Typical faults of batched tasks do not show in a single match: a forgotten axis, state on self, a
world that reads another world's numbers. The check plays the same worlds in a batch and alone and
compares every bit. Other faults need contacts, so the robots also drive at the ball.
"""

import copy
import pickle
import random
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.task import Play, Task
from rsoccer.testing.pressure import Pressing

PRESSURE_WORLDS: Final = 8
"""Worlds of the check under pressure per compared world; faults that need contacts are rare."""


class TaskError(AssertionError):
    """Fault of a task that `check_task` found."""


def check_task(task: Task, worlds: int = 7, steps: int = 200, seed: int = 3) -> None:
    """Check that a task keeps the rules of batches and of reproducibility.

    - Row i of a batch equals a single world seeded `seed + i`, bit for bit, in every autoreset mode
      and through resets of some worlds.
    - An episode after others equals the same episode in fresh matches.
    - The task keeps no state on self and draws no global random numbers.
    - The task reads frames and views and never writes to them.
    - Observations, rewards, metrics and commands are float32 and finite.
    - All of this holds too while every learner drives at the ball, so that robots press on each
      other and on walls and the ball leaves the field; no method raises then.

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
        raise ValueError(f"worlds: expected at least 2, to compare neighbours, got {worlds}")
    long, task = _with_time_limit(task, steps), _with_time_limit(task, max(2, steps // 5))
    with _unchanged(task):
        _check_play(task, worlds, seed)
        _check_pressure(long, worlds, steps, seed)
        for autoreset, divisor in {"same_step": 1, "next_step": 2, "disabled": 2}.items():
            _check_batch(task, worlds, max(4, steps // divisor), seed, autoreset)
        _check_history(task, worlds, steps, seed)


def _with_time_limit(task: Task, max_steps: int) -> Task:
    """Copy of a task with a time limit so short that episodes end during the check."""
    limited = copy.copy(task)
    vars(limited)["max_steps"] = min(task.max_steps, max_steps)
    return limited


@contextmanager
def _unchanged(task: Task) -> Iterator[None]:
    """Expect that the block changes neither the task nor the global random state."""
    attributes, random_state = _attributes(task), _global_random_state()
    yield
    same_task, same_state = _attributes(task) == attributes, _global_random_state() == random_state
    _expect(same_task, "it keeps state on self; state of an episode belongs in play.memory")
    _expect(same_state, "it draws global random numbers instead of numbers from its rng")


def _attributes(task: Task) -> bytes:
    """All attributes of a task except its cached properties."""
    attributes = vars(task).items()
    cached = {
        name for name, _ in attributes if isinstance(_class_attribute(task, name), cached_property)
    }
    return pickle.dumps({name: value for name, value in attributes if name not in cached})


def _class_attribute(task: Task, name: str) -> object:
    return next((vars(c)[name] for c in type(task).__mro__ if name in vars(c)), None)


def _global_random_state() -> bytes:
    return pickle.dumps((random.getstate(), np.random.get_state()))  # noqa: NPY002  (only read)


def _check_play(task: Task, worlds: int, seed: int) -> None:
    """Check that all methods only read a match in progress and return finite float32."""
    matches = Matches(task, worlds, seed)
    matches.reset()
    rng = np.random.default_rng(seed)
    for _ in range(3):
        matches.step(_actions(rng, matches))
    play = matches.play.take(np.arange(worlds))
    before = [array.copy() for array in _state_arrays(play)]
    results: dict[str, Array] = {"get_commands": task.get_commands(play, play.actions)}
    results |= task.frame_to_observations(play)
    results |= task.calculate_reward_and_done(play)[0]
    results |= task.metrics(play)
    for name, array in results.items():
        _expect(array.dtype == np.float32, f"{name!r} is {array.dtype}, not float32")
        _expect(len(array) == worlds, f"{name!r} is {array.shape}, not ({worlds}, ...)")
        _expect(bool(np.isfinite(array).all()), f"{name!r} has NaN or infinite numbers")
    unchanged = all(map(_same, before, _state_arrays(play)))
    _expect(unchanged, "it writes into play.frame or play.view, which are read-only")


def _state_arrays(play: Play) -> list[Floats]:
    """Arrays that a task must not change."""
    views = [part.data for view in (play.view, play.last_view) for part in (view.ball, view.robots)]
    return [play.frame.rows, play.last_frame.rows, *views, play.actions]


def _check_batch(task: Task, worlds: int, steps: int, seed: int, autoreset: str) -> None:
    """Check that row i of a batch equals a single world seeded `seed + i`."""
    batch = Matches(task, worlds, seed, autoreset=autoreset)
    singles = [Matches(task, 1, seed + i, autoreset=autoreset) for i in range(worlds)]
    rng, pressing = np.random.default_rng(seed), Pressing(task, seed)
    ended = 0
    _compare(batch.reset(), [single.reset() for single in singles], "the first observations")
    for step in range(steps):
        actions = _actions(rng, batch) if autoreset == "same_step" else pressing.actions(batch)
        outcome = batch.step(actions)
        outcomes = [single.step(actions[i : i + 1]) for i, single in enumerate(singles)]
        where = f"in step {step} ({autoreset})"
        _compare_outcomes(outcome, outcomes, where)
        _compare(batch.frame.rows, [single.frame.rows for single in singles], f"the frame {where}")
        ended += int(outcome.ended.sum())
        mask = rng.random(worlds) < 0.02
        if autoreset == "disabled":
            mask |= batch.done & (rng.random(worlds) < 0.3)  # the others wait for a while
        if mask.any():
            rows = [single.reset() for single, resets in zip(singles, mask, strict=True) if resets]
            _compare(batch.reset(mask=mask)[mask], rows, f"a reset of some worlds {where}")
    _expect(ended > 0, "no episode ended, so resets were not compared; give it more steps")


def _check_history(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Check that episodes after others equal the same episodes in fresh matches."""
    used, fresh = Matches(task, worlds, seed + worlds), Matches(task, worlds, seed)
    rng = np.random.default_rng(seed)
    used.reset()
    for _ in range(steps // 4):
        used.step(_actions(rng, used))
    _compare(used.reset(seed), [fresh.reset()], "a reset after other episodes")
    for step in range(steps // 4):
        actions = _actions(rng, fresh)
        outcome, expected = used.step(actions), fresh.step(actions)
        _compare_outcomes(outcome, [expected], f"in step {step} after other episodes")


def _check_pressure(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Check that no method raises or returns NaN while all learners drive at the ball."""
    matches, pressing = Matches(task, PRESSURE_WORLDS * worlds, seed), Pressing(task, seed)
    matches.reset()
    for step in range(steps):
        where = f"in step {step} under pressure, when all drive at the ball"
        try:
            outcome = matches.step(pressing.actions(matches))
        except Exception as error:
            raise TaskError(f"{type(error).__name__} {where}: {error}") from error
        terms, metrics = outcome.terms.items(), outcome.metrics.items()
        arrays = {"the observation": outcome.final_observations, **dict(terms), **dict(metrics)}
        for name, array in arrays.items():
            finite = bool(np.isfinite(array).all())
            _expect(finite, f"{name!r} has NaN or infinite numbers {where}")


def _actions(rng: np.random.Generator, matches: Matches) -> Floats:
    """Random actions (n, agents, action), mostly forward, so that robots meet."""
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return rng.uniform(-0.5, 1.0, shape).astype(np.float32)


def _compare_outcomes(batch: Outcome, singles: list[Outcome], where: str) -> None:
    for name in ("observations", "final_observations", "rewards", "terminated", "truncated"):
        parts = [getattr(single, name) for single in singles]
        _compare(getattr(batch, name), parts, f"{name} {where}")
    for name, term in batch.terms.items():
        _compare(term, [single.terms[name] for single in singles], f"term {name!r} {where}")
    for name, metric in batch.metrics.items():
        _compare(metric, [single.metrics[name] for single in singles], f"metric {name!r} {where}")


def _compare(batch: Array, singles: list[Array], label: str) -> None:
    """Expect that the rows of an array equal the rows of the other arrays, bit for bit."""
    expected = np.concatenate(singles)
    if not _same(batch, expected):
        pairs = enumerate(zip(batch, expected, strict=True))
        worlds = [i for i, (row, single) in pairs if not _same(row, single)]
        raise TaskError(f"{label}: worlds {worlds} of a batch differ from the same worlds alone")


def _same(a: Array, b: Array) -> bool:
    """Compare every bit, so NaN equals itself."""
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()


def _expect(holds: bool, fault: str) -> None:
    if not holds:
        raise TaskError(fault)
