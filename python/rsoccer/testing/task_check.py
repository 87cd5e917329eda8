"""Checks of a task that its author can run: `check_task(MyTask())`.

A batched task fails in ways that no single run shows: a forgotten axis, state on self, a world
that reads its neighbour's numbers. So the same worlds are played together and alone, and must not
differ in one bit. Other faults show only under pressure, so robots are also driven at the ball.
"""

import copy
import pickle
import random
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cached_property
from typing import Final

import numpy as np

from rsoccer.frame import Array, Floats
from rsoccer.matches import Matches, Outcome
from rsoccer.task import Play, Task
from rsoccer.testing.pressure import Pressing

PRESSED: Final = 8  # times as many worlds as are compared: what breaks under pressure is rare


class TaskError(AssertionError):
    """What a task does wrong."""


def check_task(task: Task, worlds: int = 7, steps: int = 200, seed: int = 3) -> None:
    """Raise `TaskError` unless `task` keeps the rules that batches and repetition rest on.

    Row i of a batch equals a single world seeded `seed + i`, in every autoreset mode and through
    partial resets; an episode after others equals the same one in fresh matches; nothing is kept
    on the task; no global random numbers; play is read, not written; numbers are float32, finite.
    All that holds too when every learner drives at the ball, so that robots press on each other and
    on walls, and the ball leaves the field; what raises then is a fault as well.
    """
    if worlds < 2:
        raise ValueError(f"worlds: expected at least 2, to compare neighbours, got {worlds}")
    lasting, task = _hurried(task, steps), _hurried(task, max(2, steps // 5))
    with _leaves_no_trace(task):
        _check_play(task, worlds, seed)
        _check_pressure(lasting, worlds, steps, seed)
        for autoreset, share in {"same_step": 1, "next_step": 2, "disabled": 2}.items():
            _check_alone(task, worlds, max(4, steps // share), seed, autoreset)
        _check_history(task, worlds, steps, seed)


def _hurried(task: Task, max_steps: int) -> Task:
    """The task with a clock so short that episodes end while it is checked."""
    hurried = copy.copy(task)
    vars(hurried)["max_steps"] = min(task.max_steps, max_steps)
    return hurried


@contextmanager
def _leaves_no_trace(task: Task) -> Iterator[None]:
    """The block must change neither the task nor any global random state."""
    kept, drawn = _options(task), _global_random()
    yield
    _expect(_options(task) == kept, "it keeps state on self; what must last belongs in play.memory")
    _expect(_global_random() == drawn, "it draws global random numbers, not from the rng given")


def _options(task: Task) -> bytes:
    """What is on the task, but for what it derives once and for all."""
    kept = vars(task).items()
    derived = {name for name, _ in kept if isinstance(_of_class(task, name), cached_property)}
    return pickle.dumps({name: value for name, value in kept if name not in derived})


def _of_class(task: Task, name: str) -> object:
    return next((vars(c)[name] for c in type(task).__mro__ if name in vars(c)), None)


def _global_random() -> bytes:
    return pickle.dumps((random.getstate(), np.random.get_state()))  # noqa: NPY002  (to see it)


def _check_play(task: Task, worlds: int, seed: int) -> None:
    """Each method reads a play in progress, writes nothing into it, and gives float32."""
    matches = Matches(task, worlds, seed)
    matches.reset()
    rng = np.random.default_rng(seed)
    for _ in range(3):
        matches.step(_actions(rng, matches))
    play = matches.play.take(np.arange(worlds))
    before = [array.copy() for array in _moments(play)]
    found: dict[str, Array] = {"get_commands": task.get_commands(play, play.actions)}
    found |= task.frame_to_observations(play)
    found |= task.calculate_reward_and_done(play)[0]
    found |= task.metrics(play)
    for name, array in found.items():
        _expect(array.dtype == np.float32, f"{name!r} is {array.dtype}, not float32")
        _expect(len(array) == worlds, f"{name!r} is {array.shape}, not ({worlds}, ...)")
        _expect(bool(np.isfinite(array).all()), f"{name!r} has NaN or infinite numbers")
    unchanged = all(map(_same, before, _moments(play)))
    _expect(unchanged, "it writes into play.frame or play.view, which are to be read only")


def _moments(play: Play) -> list[Floats]:
    views = [part.data for view in (play.view, play.last_view) for part in (view.ball, view.robots)]
    return [play.frame.rows, play.last_frame.rows, *views, play.actions]


def _check_alone(task: Task, worlds: int, steps: int, seed: int, autoreset: str) -> None:
    """Row i of a batch = a single world seeded `seed + i`, whatever ends and begins meanwhile."""
    many = Matches(task, worlds, seed, autoreset=autoreset)
    ones = [Matches(task, 1, seed + i, autoreset=autoreset) for i in range(worlds)]
    rng, pressing = np.random.default_rng(seed), Pressing(task, seed)
    ended = 0
    _compare(many.reset(), [one.reset() for one in ones], "the first observations")
    for step in range(steps):
        actions = _actions(rng, many) if autoreset == "same_step" else pressing.actions(many)
        outcome = many.step(actions)
        alone = [one.step(actions[i : i + 1]) for i, one in enumerate(ones)]
        where = f"in step {step} ({autoreset})"
        _compare_outcomes(outcome, alone, where)
        _compare(many.frame.rows, [one.frame.rows for one in ones], f"the frame {where}")
        ended += int(outcome.ended.sum())
        again = rng.random(worlds) < 0.02
        if autoreset == "disabled":
            again |= many.done & (rng.random(worlds) < 0.3)  # so that some stand still for a while
        if again.any():
            rows = [one.reset() for one, begins in zip(ones, again, strict=True) if begins]
            _compare(many.reset(mask=again)[again], rows, f"a reset of some worlds {where}")
    _expect(ended > 0, "no episode ended, so restarts were not compared; give it more steps")


def _check_history(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Episodes after others = the same episodes in fresh matches."""
    used, fresh = Matches(task, worlds, seed + worlds), Matches(task, worlds, seed)
    rng = np.random.default_rng(seed)
    used.reset()
    for _ in range(steps // 4):
        used.step(_actions(rng, used))
    _compare(used.reset(seed), [fresh.reset()], "a reset after other episodes")
    for step in range(steps // 4):
        actions = _actions(rng, fresh)
        ours, theirs = used.step(actions), fresh.step(actions)
        _compare_outcomes(ours, [theirs], f"in step {step} after other episodes")


def _check_pressure(task: Task, worlds: int, steps: int, seed: int) -> None:
    """Robots that all drive at the ball, in many worlds: nothing breaks, and nothing is NaN."""
    matches, pressing = Matches(task, PRESSED * worlds, seed), Pressing(task, seed)
    matches.reset()
    for step in range(steps):
        where = f"in step {step} under pressure, when all drive at the ball"
        try:
            outcome = matches.step(pressing.actions(matches))
        except Exception as error:
            raise TaskError(f"{type(error).__name__} {where}: {error}") from error
        terms, metrics = outcome.terms.items(), outcome.metrics.items()
        numbers = {"the observation": outcome.final_observations, **dict(terms), **dict(metrics)}
        for name, array in numbers.items():
            finite = bool(np.isfinite(array).all())
            _expect(finite, f"{name!r} has NaN or infinite numbers {where}")


def _actions(rng: np.random.Generator, matches: Matches) -> Floats:
    """Full of contacts: pushes that last, with noise on top."""
    shape = (matches.worlds, len(matches.agents), matches.action_size)
    return rng.uniform(-0.5, 1.0, shape).astype(np.float32)


def _compare_outcomes(many: Outcome, ones: list[Outcome], where: str) -> None:
    for name in ("observations", "final_observations", "rewards", "terminated", "truncated"):
        _compare(getattr(many, name), [getattr(one, name) for one in ones], f"{name} {where}")
    for name, term in many.terms.items():
        _compare(term, [one.terms[name] for one in ones], f"term {name!r} {where}")
    for name, metric in many.metrics.items():
        _compare(metric, [one.metrics[name] for one in ones], f"metric {name!r} {where}")


def _compare(many: Array, ones: list[Array], what: str) -> None:
    """Rows of one array against arrays that are to hold the same, bit for bit."""
    expected = np.concatenate(ones)
    if not _same(many, expected):
        differing = [
            i for i, (a, b) in enumerate(zip(many, expected, strict=True)) if not _same(a, b)
        ]
        raise TaskError(f"{what}: worlds {differing} of a batch differ from the same worlds alone")


def _same(a: Array, b: Array) -> bool:
    """Equal in every bit, so that NaN equals itself."""
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()


def _expect(holds: bool, fault: str) -> None:
    if not holds:
        raise TaskError(fault)
