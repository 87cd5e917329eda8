"""Results of each method of a task, as arrays with a row for each world."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Final, Literal, cast, get_args

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.markers import Marker
from rsoccer.matches import result_checks
from rsoccer.rules.base import begin, judge
from rsoccer.task import Play, Task
from rsoccer.testing.errors import expect

Results = dict[str, Array]
"""Arrays (n, ...) by their names in error messages."""


@dataclass(frozen=True)
class Method:
    """A method of a task, and what it may do."""

    name: str
    """name of the method"""
    call: Callable[[Task, Play], Results]
    """calls it, checks the form of what it returns, and returns that"""
    updates: tuple[str, ...] = ()
    """fields of `play` that it may change, of "memory", "game" and "events" """
    draws: bool = False
    """whether it may draw from `play.rng`"""
    reads: Literal["sensed", "truth", "any"] = "any"
    """state that it may read: what robots sense, the true one, or either"""


def _new_memory(task: Task, play: Play) -> Results:
    n = len(play.frame)
    memory = _mapping(task.new_memory(n))
    arrays = {name: np.asarray(array) for name, array in memory.items()}
    for name, array in arrays.items():
        expect(array.shape[:1] == (n,), f"{name!r} is {array.shape}, not ({n}, ...)")
        expect(array.dtype != np.object_, f"{name!r} holds objects, which cannot be saved")
    return arrays


def _initial_positions(task: Task, play: Play) -> Results:
    frame = task.get_initial_positions_frame(play.rng)
    expect(isinstance(frame, Frame), f"it returns {type(frame).__name__}, not a Frame")
    _expect_form("frame", frame.rows, play.frame.rows.shape)
    return {"frame": frame.rows}


def _start_episode(task: Task, play: Play) -> Results:
    task.start_episode(play)
    return {}


def _commands(task: Task, play: Play) -> Results:
    commands = task.get_commands(play, play.actions)
    _expect_form("commands", commands, play.commands.shape)
    return {"commands": commands}


def _observations(task: Task, play: Play) -> Results:
    blocks = _mapping(task.frame_to_observations(play))
    missing = sorted(set(task.layout.blocks) ^ set(blocks))
    expect(not missing, f"it returns other blocks than at first: {missing}")
    for name, block in blocks.items():
        shape = (len(play.frame), len(play.observers), *task.layout.blocks[name].shape)
        _expect_form(name, block, shape)
    return dict(blocks)


def _rewards(task: Task, play: Play) -> Results:
    results: object = task.calculate_reward_and_done(play)
    is_pair = isinstance(results, tuple) and len(results) == 2
    expect(is_pair, f"it returns {type(results).__name__}, not reward terms and ends of episodes")
    terms, ended = cast(tuple[Any, Any], results)
    terms = _mapping(terms)
    n, observers = len(play.frame), len(play.observers)
    for name, term in terms.items():
        common = np.shape(term) == (n, 1)
        _expect_form(name, term, (n, 1 if common else observers))
    kind = type(ended).__name__
    expect(isinstance(ended, np.ndarray), f"the end of episodes is {kind}, not an array")
    expect(np.shape(ended) == (n,), f"the end of episodes is {np.shape(ended)}, not ({n},)")
    expect(ended.dtype == np.bool_, f"the end of episodes is {ended.dtype}, not bool")
    return {**terms, "end of episodes": ended}


def _metrics(task: Task, play: Play) -> Results:
    metrics = _mapping(task.metrics(play))
    taken = sorted(result_checks.RESERVED_METRICS & set(metrics))
    expect(not taken, f"it uses names that infos of episodes use otherwise: {taken}")
    for name, metric in metrics.items():
        _expect_form(name, metric, (len(play.frame),))
    known = task.success is None or task.success in metrics
    expect(known, f"it lacks the metric {task.success!r}, which the task names as its success")
    return dict(metrics)


def _markers(task: Task, play: Play) -> Results:
    """A checksum of the markers of each world."""
    digests = []
    for world in range(len(play.frame)):
        markers = task.markers(play, world)
        valid = all(isinstance(marker, get_args(Marker)) for marker in markers)
        expect(valid, f"it returns {markers!r}, not markers of rsoccer.markers")
        digests.append(zlib.crc32(repr(markers).encode()))
    return {"markers": np.array(digests)}


def _restarts(task: Task, play: Play) -> Results:
    """New states of the worlds in which the rules restart play; zeros elsewhere."""
    play.events.forget()
    results: Results = {}
    for restart in judge(task.rules, play):
        for name, numbers in (("balls", restart.balls), ("rows", restart.rows)):
            if numbers is not None and len(restart.worlds):
                shape = (len(play.frame), numbers.shape[1])
                dense = results.setdefault(name, np.zeros(shape, np.float32))
                dense[restart.worlds] = numbers
    return results


def _begin(task: Task, play: Play) -> Results:
    begin(task.rules, play, np.arange(len(play.frame)))
    return {}


def _mapping(arrays: object) -> Mapping[str, Array]:
    """Expect arrays by name."""
    expect(isinstance(arrays, Mapping), f"it returns {type(arrays).__name__}, not arrays by name")
    return cast(Mapping[str, Array], arrays)


def _expect_form(name: str, array: Array, shape: tuple[int, ...]) -> None:
    """Expect float32 numbers of a shape, all finite."""
    expect(isinstance(array, np.ndarray), f"{name!r} is {type(array).__name__}, not an array")
    expect(array.dtype == np.float32, f"{name!r} is {array.dtype}, not float32")
    expect(array.shape == shape, f"{name!r} is {array.shape}, not {shape}")
    expect(bool(np.isfinite(array).all()), f"{name!r} has NaN or infinite numbers")


NEW_MEMORY: Final = Method("new_memory", _new_memory)
INITIAL_POSITIONS: Final = Method("get_initial_positions_frame", _initial_positions, draws=True)
START_EPISODE: Final = Method("start_episode", _start_episode, ("memory",), draws=True)
RULES: Final = Method("rules", _restarts, ("game", "events"), draws=True, reads="truth")
RULES_BEGIN: Final = Method("rules: begin", _begin, ("game",), draws=True, reads="truth")
DURING_EPISODES: Final = (
    Method("get_commands", _commands, draws=True, reads="sensed"),
    RULES,
    Method("calculate_reward_and_done", _rewards, ("memory",), draws=True, reads="truth"),
    Method("metrics", _metrics, reads="truth"),
    Method("frame_to_observations", _observations, draws=True, reads="sensed"),
    Method("markers", _markers),
)
"""Methods that are called in every step, in this order."""


def fields_of(play: Play, field: str) -> Results:
    """Return the arrays of a field of a state, by their names in messages.

    Args:
        play: the state.
        field: "memory", "game" or "events".
    """
    arrays: Mapping[str, Array] = getattr(play, field)
    return {f"play.{field}[{name!r}]": array for name, array in arrays.items()}


def names_of(methods: Iterable[Method]) -> str:
    """Return the names of some methods as text.

    Args:
        methods: the methods.
    """
    return ", ".join(method.name for method in methods)


def differing(a: Mapping[str, Array], b: Mapping[str, Array]) -> list[str]:
    """Return the names of the arrays that are not equal to the last bit; NaN equals itself.

    Args:
        a: arrays by name.
        b: the others.
    """
    names = {**a, **b}
    return [name for name in names if name not in a or name not in b or not same(a[name], b[name])]


def same(a: Array, b: Array) -> bool:
    """Return whether two arrays are equal to the last bit; NaN equals itself.

    Args:
        a: an array.
        b: another one.
    """
    return a.shape == b.shape and a.dtype == b.dtype and a.tobytes() == b.tobytes()
