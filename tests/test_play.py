"""Every field of `Play` takes part in copying, overwriting and saving of worlds.

The tests find the fields by `dataclasses.fields`, not by the list that `Play` itself works through.
"""

import copy
from collections.abc import Callable, Mapping
from dataclasses import Field, fields
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches, SimConfig, Simulator, WorldRng
from rsoccer import play as play_module
from rsoccer._core import Threads
from rsoccer.arrays import Array, Doubles, Floats, Mask
from rsoccer.frame import Frame
from rsoccer.game import EventKind
from rsoccer.play import Play
from rsoccer.senses import ModelSenses
from rsoccer.view import Viewpoint
from tests.failing import FailingTask
from tests.helpers import pushing, same
from tests.sensors import LateAndNoisy

WORLDS = 7  # unlike the numbers of robots and observers, 6
SOME = np.array([4, 1, 5])

FIELDS: dict[str, Field[object]] = {each.name: each for each in fields(Play)}
ROLES = {name: each.metadata.get("role", "saved") for name, each in FIELDS.items()}
PER_WORLD = [name for name, role in ROLES.items() if role in ("saved", "stream")]
STEP = [name for name, role in ROLES.items() if role == "step"]
SAVED = [name for name, role in ROLES.items() if role in ("saved", "step")]


def arrays_in(value: object) -> list[Array]:
    """All arrays of a field, not copied."""
    if isinstance(value, np.ndarray):
        return [value]
    if isinstance(value, Frame):
        return [value.rows]
    if isinstance(value, Viewpoint):
        return [value.observers, value.teams]
    if isinstance(value, Threads):
        return []
    if isinstance(value, WorldRng):
        return [value._state]
    if isinstance(value, ModelSenses):
        return [value.frame.rows, *value.state.values(), value.rng._state]
    if isinstance(value, Mapping):
        return list(value.values())
    raise TypeError(f"a field of a new type: {type(value).__name__}")


def copies_of(play: Play) -> dict[str, list[Array]]:
    """Copies of all arrays by field."""
    return {name: [array.copy() for array in arrays_in(getattr(play, name))] for name in FIELDS}


class Stamping:
    """The package's simulator with time stamps."""

    def __init__(self, config: SimConfig) -> None:
        self._simulator, self._times = Simulator(config, WORLDS), np.zeros(WORLDS)

    def __getattr__(self, name: str) -> Any:  # noqa: ANN401
        return getattr(self.__dict__["_simulator"], name)

    def step(self, commands: Floats, out: Floats, active: Mask | None = None) -> Doubles:
        self._simulator.step(commands, out, active)
        self._times += np.arange(1.0, 1.0 + WORLDS)
        return self._times


def played(seed: int, steps: int) -> Matches:
    """Matches of a task with memory, random numbers and senses, after some steps."""
    task = FailingTask(max_steps=99)
    sensing = LateAndNoisy(task.config.row_size)
    simulator = Stamping(task.config)
    matches = Matches(
        task, WORLDS, seed, autoreset="disabled", sensing=sensing, simulator=simulator
    )
    matches.reset()
    rng = np.random.default_rng(seed)
    for _ in range(steps):
        matches.step(pushing(rng, matches))
    return matches


def two_plays() -> tuple[Play, Play]:
    """Two plays that differ in every array with values per world."""
    ours = played(seed=1, steps=5).play
    theirs = copy.deepcopy(ours)
    for name in (*PER_WORLD, *STEP):
        arrays = arrays_in(getattr(theirs, name))
        assert arrays, f"{name} has no array: nothing would be compared"
        for array, other in zip(arrays, arrays_in(getattr(ours, name)), strict=True):
            array += 1
            assert len(array) == WORLDS, name
            assert not any(same(array[i], other[i]) for i in range(WORLDS)), name
    return ours, theirs


def expect_take() -> None:
    play, _ = two_plays()
    before, part = copies_of(play), play.take(SOME)
    for name in (*PER_WORLD, *STEP):
        for array, kept in zip(arrays_in(getattr(part, name)), before[name], strict=True):
            assert same(array, kept[SOME]), f"take: {name}"
            array[...] = 0
    for name, kept_arrays in before.items():
        for array, kept in zip(arrays_in(getattr(play, name)), kept_arrays, strict=True):
            assert same(array, kept), f"take shares memory: {name}"


def expect_put() -> None:
    ours, theirs = two_plays()
    expected, source = copies_of(ours), copies_of(theirs)
    ours.put(SOME, theirs.take(SOME))
    for name in PER_WORLD:
        for array, kept, new in zip(
            arrays_in(getattr(ours, name)), expected[name], source[name], strict=True
        ):
            kept[SOME] = new[SOME]
            assert same(array, kept), f"put: {name}"
    for name in STEP:
        for array, kept in zip(arrays_in(getattr(ours, name)), expected[name], strict=True):
            assert same(array, kept), f"a new episode leaves {name}"


def expect_arrays() -> None:
    play, _ = two_plays()
    listed = play.arrays()
    for name in SAVED:
        keys = [key for key in listed if key.split(".")[0] == name]
        for array in arrays_in(getattr(play, name)):
            if name == "senses" and play.senses is not None and array is play.senses.rng._state:
                continue  # saved beside the other random streams
            assert any(listed[key] is array for key in keys), f"arrays: {name}"


def expect_saving() -> None:
    ours, theirs = played(seed=1, steps=5), played(seed=2, steps=3)
    ours.play.game.score[:] = 3
    ours.play.events.add(SOME, EventKind.GOAL)
    theirs.load_state_dict(ours.state_dict())
    for name in FIELDS:
        values = arrays_in(getattr(ours.play, name)), arrays_in(getattr(theirs.play, name))
        for array, restored in zip(*values, strict=True):
            assert same(array, restored), f"saving: {name}"


CHECKS = [expect_take, expect_put, expect_arrays, expect_saving]


def test_every_role_is_known_and_used() -> None:
    assert set(ROLES.values()) == {"saved", "shared", "stream", "step"}
    assert len(FIELDS) == len(PER_WORLD) + len(STEP) + list(ROLES.values()).count("shared")


def test_shared_fields_have_no_value_per_world() -> None:
    play, _ = two_plays()
    for name in FIELDS.keys() - {*PER_WORLD, *STEP}:
        assert all(len(array) != WORLDS for array in arrays_in(getattr(play, name))), name


@pytest.mark.parametrize("check", CHECKS)
def test_every_field_takes_part(check: Callable[[], None]) -> None:
    check()


@pytest.mark.parametrize("name", PER_WORLD)
def test_a_field_left_out_of_copying_would_be_found(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def without(value: object, worlds: Array, part: object) -> None:
        if value is not getattr(ours, name):
            put(value, worlds, part)

    put, (ours, theirs) = play_module._put, two_plays()
    monkeypatch.setattr(play_module, "_put", without)
    monkeypatch.setitem(globals(), "two_plays", lambda: (ours, theirs))
    with pytest.raises(AssertionError, match=f"put: {name}"):
        expect_put()
    monkeypatch.setattr(
        play_module, "_PER_WORLD", tuple(each for each in PER_WORLD if each != name)
    )
    # A field without a default is missed by the constructor, one with a default has no array.
    with pytest.raises(TypeError, match=f"{name}|NoneType"):
        expect_take()


@pytest.mark.parametrize("name", SAVED)
def test_a_field_left_out_of_saving_would_be_found(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = play_module._names
    monkeypatch.setattr(
        play_module, "_names", lambda *roles: tuple(each for each in names(*roles) if each != name)
    )
    with pytest.raises(AssertionError, match=f"arrays: {name}"):
        expect_arrays()
    # An array that only some simulators have is then None.
    with pytest.raises((AssertionError, TypeError), match=r"saving: |NoneType"):
        expect_saving()


def test_views_follow_the_frames() -> None:
    ours, theirs = two_plays()
    old = ours.view.ball.data.copy()
    ours.put(SOME, theirs.take(SOME))
    for frame, view in ((ours.frame, ours.view), (ours.last_frame, ours.last_view)):
        fresh = ours.viewpoint.new_view(WORLDS)
        ours.viewpoint.fill(frame, fresh)
        assert same(view.ball.data, fresh.ball.data)
        assert same(view.robots.data, fresh.robots.data)
    assert not same(ours.view.ball.data, old)
    current = ours.view
    ours.advance()
    assert ours.last_view is current
    assert not same(ours.view.robots.data, ours.last_view.robots.data)
