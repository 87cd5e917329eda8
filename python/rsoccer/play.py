"""State that a task may read, for n worlds: frames, views, actions and the task's own memory.

`Play` lists its fields once. Copying worlds, overwriting worlds and saving all follow from the
list, so a new field takes part in each of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.rng import WorldRng
from rsoccer.view import View, Viewpoint

# Roles of fields that are not plain per-world state, for copying and saving.
DERIVED: Final = {"role": "derived"}  # copied, but not saved: computed from saved fields
SHARED: Final = {"role": "shared"}  # the same for all worlds: neither copied nor saved
STREAM: Final = {"role": "stream"}  # copied, and saved beside the other random streams


@dataclass
class Play:
    """State of n worlds that a task may read; only `memory` and `rng` are the task's to change."""

    frame: Frame
    """(n, ...) current state."""
    last_frame: Frame
    """(n, ...) state one control step ago; equal to `frame` after a reset."""
    view: View = field(metadata=DERIVED)
    """(n, observers, ...) `frame` in the coordinates of each observer."""
    last_view: View = field(metadata=DERIVED)
    """(n, observers, ...) `last_frame` in the coordinates of each observer."""
    commands: Floats
    """(n, robots, command) last commands of the robots, SI units."""
    actions: Floats
    """(n, robots, action) last actions, in [-1, 1]; 0 after a reset."""
    rng: WorldRng = field(metadata=STREAM)
    """(n,) random streams of the task, one per world."""
    memory: dict[str, Array]
    """(n, ...) arrays of the task, fresh after a reset; see `Task.new_memory`."""
    observers: NDArray[np.intp] = field(metadata=SHARED)
    """(observers,) indices of the robots that have a view, in the order of a state row."""
    steps: NDArray[np.int64]
    """(n,) control steps since the episode began."""

    def advance(self) -> None:
        """Swap the buffers: the current frame and view become the last ones."""
        self.frame, self.last_frame = self.last_frame, self.frame
        self.view, self.last_view = self.last_view, self.view

    def start(self, rows: Floats, viewpoint: Viewpoint) -> None:
        """Begin episodes, with the last frame equal to the current one.

        Args:
            rows: (n, row) initial state rows.
            viewpoint: fills the views.
        """
        self.frame.rows[:] = rows
        self.last_frame.rows[:] = rows
        self.fill_views(viewpoint)

    def fill_views(self, viewpoint: Viewpoint) -> None:
        """Compute both views from the frames.

        Args:
            viewpoint: fills the views.
        """
        viewpoint.fill(self.frame, self.view)
        viewpoint.fill(self.last_frame, self.last_view)

    def take(self, worlds: NDArray[np.intp]) -> "Play":
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        values = {name: getattr(self, name) for name in _names("shared")}
        values |= {name: _take(getattr(self, name), worlds) for name in _PER_WORLD}
        return Play(**values)

    def put(self, worlds: NDArray[np.intp], part: "Play") -> None:
        """Overwrite some worlds.

        Args:
            worlds: (k,) indices of worlds.
            part: the state of k worlds, as `take` returns it.
        """
        for name in _PER_WORLD:
            _put(getattr(self, name), worlds, getattr(part, name))

    def arrays(self) -> dict[str, Array]:
        """Return the arrays to save, by name; not copied. Random streams are saved by others."""
        arrays: dict[str, Array] = {}
        for name in _names("saved"):
            value = getattr(self, name)
            if isinstance(value, Mapping):
                arrays |= {f"{name}.{key}": array for key, array in value.items()}
            else:
                arrays[name] = value.rows if isinstance(value, Frame) else value
        return arrays


def _names(*roles: str) -> tuple[str, ...]:
    """Names of the fields with these roles; a field without metadata has the role "saved"."""
    return tuple(f.name for f in fields(Play) if f.metadata.get("role", "saved") in roles)


_PER_WORLD: Final = _names("saved", "derived", "stream")


def _take(value: Any, worlds: NDArray[np.intp]) -> Any:  # noqa: ANN401  (a field's value)
    if isinstance(value, Mapping):
        return {key: array[worlds] for key, array in value.items()}
    return value.take(worlds) if isinstance(value, Frame | View) else value[worlds]


def _put(value: Any, worlds: NDArray[np.intp], part: Any) -> None:  # noqa: ANN401  (a field's value)
    if isinstance(value, Mapping):
        for key, array in part.items():
            value[key][worlds] = array
    elif isinstance(value, np.ndarray):
        value[worlds] = part
    else:
        value.put(worlds, part)
