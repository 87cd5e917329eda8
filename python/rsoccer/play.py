"""State that a task may read, for n worlds: frames, views, actions, game, events, own memory.

`Play` lists its fields once. Copying worlds, overwriting worlds and saving all follow from the
list, so a new field takes part in each of them. Views follow from the frames: they are computed
when they are first read.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import Threads
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.frame import Frame
from rsoccer.game import Events, Game, NamedArrays
from rsoccer.rng import WorldRng
from rsoccer.senses import Senses
from rsoccer.view import CachedView, View, Viewpoint

# Roles of fields that are not plain per-world state, for copying and saving.
SHARED: Final = {"role": "shared"}  # the same for all worlds: neither copied nor saved
STREAM: Final = {"role": "stream"}  # copied, and saved beside the other random streams
STEP: Final = {"role": "step"}  # results of the last step: saved, and left by a new episode


@dataclass
class Play:
    """State of n worlds that a task may read; only `memory` and `rng` are the task's to change.

    Rewards, ends, metrics and rules read the true state, `frame` and `view`. What robots know is
    `sensed` and `sensed_view`: observations, policies and commands read these. Without a sensor
    model both are the same arrays.
    """

    frame: Frame
    """(n, ...) current state."""
    last_frame: Frame
    """(n, ...) state one control step ago; equal to `frame` after a reset."""
    commands: Floats
    """(n, robots, command) last commands of the robots, SI units."""
    actions: Floats
    """(n, robots, action) last actions, in [-1, 1]; 0 after a reset. Of robots with a
    `CommandPolicy`, what its `act` returned: 0 by default."""
    rng: WorldRng = field(metadata=STREAM)
    """(n,) random streams of the task, one per world."""
    memory: dict[str, Array]
    """(n, ...) arrays of the task, fresh after a reset; see `Task.new_memory`."""
    game: Game
    """(n, ...) score and state of the task's rules, fresh after a reset; see `Task.rules`."""
    events: Events = field(metadata=STEP)
    """(n, ...) events of the last step: goals, passes, decisions of the rules."""
    viewpoint: Viewpoint = field(metadata=SHARED)
    """Observers, and the conversion of frames into their views."""
    steps: NDArray[np.int64]
    """(n,) control steps since the episode began."""
    threads: Threads = field(default_factory=Threads, metadata=SHARED)
    """Threads that share the work on many worlds; results do not depend on their number."""
    senses: Senses | None = None
    """Senses of the robots; None if they know the true state."""
    times: Doubles | None = None
    """(n,) time stamps of `frame` on the clock of the simulator, s; None from a simulator without
    stamps, such as `rsoccer.Simulator`, whose control steps last exactly `config.time_step`."""

    def __post_init__(self) -> None:
        """Begin without views."""
        self._view, self._last_view, self._sensed_view = CachedView(), CachedView(), CachedView()

    @property
    def observers(self) -> NDArray[np.intp]:
        """(observers,) indices of the robots that have a view, in the order of a state row."""
        return self.viewpoint.observers

    @property
    def sensed(self) -> Frame:
        """(n, ...) current state as the robots know it.

        Teams with forecasts or cameras of their own know different things (`known_to`): then each
        robot is as its own team knows it, and the ball as blue does. A team without observers does
        not forecast unless it is asked to (`Matches.forecasting`).
        """
        return self.frame if self.senses is None else self.senses.frame.read_only

    def known_to(self, team: int) -> Frame:
        """Return (n, ...) the current state as a team knows it.

        Args:
            team: 0 for blue, 1 for yellow.
        """
        return self.frame if self.senses is None else self.senses.known_to(team).read_only

    def known_to_robots(self, robots: NDArray[np.intp]) -> Frame:
        """Return (n, ...) the current state as some robots know it, which cannot be written.

        Args:
            robots: (k,) indices of robots in the order of a state row; of one team where teams know
                different states (`teams_differ`).

        Raises:
            ValueError: robots of both teams, which know different states.
        """
        if not self.teams_differ or not len(robots):
            return self.sensed.read_only
        are_yellow = robots >= self.frame.n_blue
        if are_yellow.any() != are_yellow.all():
            raise ValueError(
                "robots: expected robots of one team, because teams know different states, "
                f"got {robots.tolist()}"
            )
        return self.known_to(int(are_yellow[0]))

    @property
    def teams_differ(self) -> bool:
        """True if teams know different states, by forecasts or cameras of their own."""
        return self.senses is not None and self.senses.teams is not None

    @property
    def sensed_view(self) -> View:
        """(n, observers, ...) what each observer's team knows, in the observer's coordinates."""
        if self.senses is None:
            return self.view
        known = self.senses.known_to(0), self.senses.known_to(1)
        return self._sensed_view.of(known[0], self.viewpoint, known[1])

    @property
    def view(self) -> View:
        """(n, observers, ...) `frame` in the coordinates of each observer."""
        return self._view.of(self.frame, self.viewpoint)

    @property
    def last_view(self) -> View:
        """(n, observers, ...) `last_frame` in the coordinates of each observer."""
        return self._last_view.of(self.last_frame, self.viewpoint)

    def advance(self) -> None:
        """Swap the frames, once the next state is in `last_frame`: the current one becomes it."""
        self.frame, self.last_frame = self.last_frame, self.frame
        self._view, self._last_view = self._last_view, self._view
        self._view.expire()
        self._sensed_view.expire()

    def start(self, rows: Floats) -> None:
        """Begin episodes, with the last frame equal to the current one.

        Args:
            rows: (n, row) initial state rows.
        """
        self.frame.rows[:] = rows
        self.last_frame.rows[:] = rows
        self.expire_views()

    def expire_views(self) -> None:
        """Have all views computed again; to be called after a change of the frames."""
        for view in (self._view, self._last_view, self._sensed_view):
            view.expire()

    def take(self, worlds: NDArray[np.intp]) -> "Play":
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        values = {name: getattr(self, name) for name in _names("shared")}
        values |= {name: _take(getattr(self, name), worlds) for name in (*_PER_WORLD, *_STEP)}
        return Play(**values)

    def put(self, worlds: NDArray[np.intp], part: "Play") -> None:
        """Overwrite some worlds, all but the events of the last step.

        Args:
            worlds: (k,) indices of worlds.
            part: the state of k worlds, as `take` returns it.
        """
        for name in _PER_WORLD:
            _put(getattr(self, name), worlds, getattr(part, name))
        self.expire_views()

    def arrays(self) -> dict[str, Array]:
        """Return the arrays to save, by name; not copied. Random streams are saved by others."""
        arrays: dict[str, Array] = {}
        for name in _names("saved", "step"):
            value = getattr(self, name)
            if isinstance(value, Senses):
                value = value.arrays()
            if isinstance(value, Mapping):
                arrays |= {f"{name}.{key}": array for key, array in value.items()}
            elif value is not None:
                arrays[name] = value.rows if isinstance(value, Frame) else value
        return arrays


def _names(*roles: str) -> tuple[str, ...]:
    """Names of the fields with these roles; a field without metadata has the role "saved"."""
    return tuple(f.name for f in fields(Play) if f.metadata.get("role", "saved") in roles)


_PER_WORLD: Final = _names("saved", "stream")
_STEP: Final = _names("step")


def _take(value: Any, worlds: NDArray[np.intp]) -> Any:  # noqa: ANN401  (a field's value)
    if value is None:
        return None
    if isinstance(value, dict):
        return {key: array[worlds] for key, array in value.items()}
    if isinstance(value, Frame | NamedArrays | Senses):
        return value.take(worlds)
    return value[worlds]


def _put(value: Any, worlds: NDArray[np.intp], part: Any) -> None:  # noqa: ANN401  (a field's value)
    if isinstance(value, dict):
        for key, array in part.items():
            value[key][worlds] = array
    elif isinstance(value, np.ndarray):
        value[worlds] = part
    elif value is not None:
        value.put(worlds, part)
