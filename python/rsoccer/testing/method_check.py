"""Checks of single methods of a task on a given state, each promise with its own error."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.new_play import new_viewpoint
from rsoccer.task import Play, Task
from rsoccer.testing.errors import TaskError, expect
from rsoccer.testing.frozen_play import VIEWS, freezable, frozen
from rsoccer.testing.kept_state import KeptState
from rsoccer.testing.method_results import (
    DURING_EPISODES,
    START_EPISODE,
    Method,
    Results,
    differing,
    fields_of,
    names_of,
)

_KEPT: Final = ("memory", "game", "events")
_DRAWING: Final = [m for m in (START_EPISODE, *DURING_EPISODES) if m.draws]


def check_method(task: Task, method: Method, play: Play) -> None:
    """Check all promises of a method on a state; its causes are found before their symptoms.

    Args:
        task: the task; it does not change unless it is at fault.
        method: the method.
        play: state of n worlds, at least 2, with all observers of the task; it does not change.

    Raises:
        TaskError: the method raises or breaks a promise.
    """
    kept = KeptState(task)
    results = _results(task, method, play)
    kept.expect_unchanged(method.name)
    kept = KeptState(task)  # now with the properties that it caches
    again = _results(task, method, play)
    kept.expect_unchanged(method.name)
    if names := differing(results, again):
        raise TaskError(
            f"{method.name}: {_listed(names)} differ between two calls with the same state; "
            "random numbers come from its rng alone, and state from play.memory"
        )
    _check_alone(task, method, play, results)
    _check_observers(task, method, play, results)


def check_reading(task: Task, play: Play) -> None:
    """Check what all methods of a step return on a state, and that they only read.

    Args:
        task: the task.
        play: state of n worlds; it does not change.

    Raises:
        TaskError: a method raises, returns another form, or writes.
    """
    for method in DURING_EPISODES:
        _results(task, method, play)


def _results(task: Task, method: Method, play: Play) -> Results:
    """Streams and memory after the method, and what it returns, for a read-only copy of a state."""
    parts = [name for name in freezable(play) if name not in method.updates]
    copy = frozen(play, parts)
    values = {name: getattr(copy, name) for name in parts if name not in (*VIEWS, *_KEPT)}
    try:
        results = method.call(task, copy)
    except TaskError as error:
        raise TaskError(f"{method.name}: {error}") from error
    except Exception as error:
        _expect_no_write(task, method, play, parts)
        raise TaskError(f"{method.name}: {type(error).__name__}: {error}") from error
    for name, value in values.items():
        _expect_kept(method, name, play, value, getattr(copy, name))
    kept = [_arrays_after(method, name, play, copy) for name in _KEPT]
    return {**_draws_after(method, play, copy), **kept[0], **kept[1], **kept[2], **results}


def _expect_kept(method: Method, name: str, play: Play, value: object, after: object) -> None:
    """Expect that a part of a state is the same object with the same numbers after a method."""
    fault = f"{method.name}: it replaces play.{name}, which is read-only for this method"
    expect(after is value, fault)
    before, now = ({name: _numbers(each)} for each in (getattr(play, name), value))
    fault = f"{method.name}: it writes into play.{name}, which is read-only for this method"
    expect(not differing(before, now), fault)


def _numbers(value: object) -> Array:
    """Array of a part of a state."""
    return value.rows if isinstance(value, Frame) else np.asarray(value)


def _expect_no_write(task: Task, method: Method, play: Play, parts: list[str]) -> None:
    """Raise `TaskError` if a method fails because, and only because, parts are read-only."""
    if not _fails(task, method, frozen(play, ())):
        written = [f"play.{part}" for part in parts if _fails(task, method, frozen(play, [part]))]
        raise TaskError(
            f"{method.name}: it writes into {_listed(written, quoted=False)}, which is read-only "
            "for this method"
        )


def _fails(task: Task, method: Method, play: Play) -> bool:
    try:
        method.call(task, play)
    except Exception:
        return True
    return False


def _arrays_after(method: Method, field: str, play: Play, after: Play) -> Results:
    """Arrays of a field of a state after a method, by their names in messages."""
    arrays, found = getattr(play, field), getattr(after, field)
    where, source = f"{method.name}: play.{field}", "new_memory" if field == "memory" else "before"
    unknown = sorted(set(found) ^ set(arrays))
    expect(not unknown, f"{where} has other names than {source}: {unknown}")
    for name, array in arrays.items():
        expect(
            (found[name].dtype, found[name].shape) == (array.dtype, array.shape),
            f"{where}[{name!r}] becomes {found[name].dtype} {found[name].shape} from "
            f"{array.dtype} {array.shape}",
        )
    results = fields_of(after, field)
    if field not in method.updates:
        names = differing(fields_of(play, field), results)
        updating = [m for m in (START_EPISODE, *DURING_EPISODES) if field in m.updates]
        fault = f"it replaces {_listed(names, quoted=False)}; {field} changes in"
        expect(not names, f"{method.name}: {fault} {names_of(updating)} alone")
    return results


def _draws_after(method: Method, play: Play, after: Play) -> Results:
    """State of the streams after a method."""
    state = after.rng.state
    if not method.draws:
        drawn = bool((state != play.rng.state).any())
        fault = f"it draws from play.rng; random numbers are drawn in {names_of(_DRAWING)} alone"
        expect(not drawn, f"{method.name}: {fault}")
    return {"random stream": state}


def _check_alone(task: Task, method: Method, play: Play, results: Results) -> None:
    """Check that each world of a batch gets what it gets alone."""
    n = len(play.frame)
    singles = [_results(task, method, play.take(np.array([world]))) for world in range(n)]
    for name in {name: None for single in singles for name in single} | results:
        rows = [single.get(name) for single in singles]
        batch = results.get(name)
        worlds = [i for i, row in enumerate(rows) if not _equal_row(batch, i, row)]
        if worlds:
            raise TaskError(
                f"{method.name}: {_listed([name])} of worlds {worlds} of a batch differ from the "
                "same worlds alone; a mix-up of axes, or of worlds"
            )


def _equal_row(batch: Array | None, world: int, single: Array | None) -> bool:
    """Whether a row equals that of a single world; one of no restart may be missing or zero."""
    if batch is None or single is None:
        present = batch[world] if batch is not None else single
        return present is None or not np.any(present)
    row = batch[world : world + 1]
    return row.shape == single.shape and row.tobytes() == single.tobytes()


def _check_observers(task: Task, method: Method, play: Play, results: Results) -> None:
    """Check that what a robot gets does not depend on the other robots that observe."""
    for index, observer in enumerate(play.observers):
        viewpoint = new_viewpoint(task, [int(observer)])
        robot = task.robots[observer]
        try:
            alone = _results(task, method, replace(play, viewpoint=viewpoint))
        except TaskError as error:
            raise TaskError(f"{error} (where {robot} alone observes)") from error
        for name, array in alone.items():
            expected = _column(results.get(name), array, index, len(play.observers))
            if expected is None or not _close(expected, array):
                raise TaskError(
                    f"{method.name}: {_listed([name])} of {robot} depends on which other robots "
                    "observe; a mix-up of axes, or of observers"
                )


def _column(full: Array | None, alone: Array, observer: int, observers: int) -> Array | None:
    """Part of an array that one of several observers should get alone."""
    if full is None or full.shape == alone.shape:
        return full
    is_own = full.shape[:2] == (len(full), observers) and alone.shape[1:2] == (1,)
    return full[:, observer : observer + 1] if is_own else full


def _close(a: Array, b: Array) -> bool:
    """Whether arrays are equal; the last bits of floats may depend on the shape."""
    if a.shape != b.shape:
        return False
    return bool(np.allclose(a, b, 1e-5, 1e-6) if a.dtype.kind == "f" else np.array_equal(a, b))


def _listed(names: list[str], *, quoted: bool = True) -> str:
    """Names as text; those of memory and streams are no names of the author."""
    return ", ".join(
        repr(name) if quoted and not name.startswith(("play.", "random ")) else name
        for name in names
    )
