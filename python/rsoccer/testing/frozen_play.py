"""States whose arrays cannot be written, so that a write of a task raises where it happens."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import fields

import numpy as np

from rsoccer.arrays import Array
from rsoccer.frame import Frame
from rsoccer.game import NamedArrays
from rsoccer.play import Play
from rsoccer.view import View

VIEWS = ("view", "last_view", "sensed_view")
"""Names of the views of a `Play`, which are no fields."""


def freezable(play: Play) -> list[str]:
    """Return the names of the parts of a state that can be made read-only.

    Args:
        play: the state.
    """
    kinds = (Frame, np.ndarray, Mapping)
    views = [name for name in VIEWS if name != "sensed_view" or play.senses is not None]
    return [f.name for f in fields(play) if isinstance(getattr(play, f.name), kinds)] + views


def frozen(play: Play, parts: Collection[str]) -> Play:
    """Return a copy of a state in which the arrays of some parts are read-only, and no others.

    Args:
        play: state of n worlds.
        parts: names of the parts, of those that `freezable` returns.
    """
    copy = play.take(np.arange(len(play.frame)))
    for name in parts:
        if name not in VIEWS:
            setattr(copy, name, _read_only(getattr(copy, name)))
    for name in VIEWS:
        if name != "sensed_view" or play.senses is not None:  # else it is `view`
            view: View = getattr(copy, name)
            # Read-only in every state. In place: it keeps the object and computes it once.
            ball, robots = view.ball.data.copy(), view.robots.data.copy()
            if name in parts:
                ball, robots = _array(ball), _array(robots)
            View.__init__(view, ball, robots, view.n_teammates)
    return copy


def _read_only(value: object) -> object:
    if isinstance(value, Frame):
        return Frame(_array(value.rows), value.n_blue, value.n_yellow)
    if isinstance(value, NamedArrays):
        return type(value)({name: _array(array) for name, array in value.items()})
    if isinstance(value, Mapping):
        return {name: _array(array) for name, array in value.items()}
    return _array(value) if isinstance(value, np.ndarray) else value


def _array(array: Array) -> Array:
    """A read-only view of an array that is read-only itself, so that neither can be written."""
    array.flags.writeable = False
    return array.view()
