"""State of the game besides the bodies: score, state of the rules, and the events of a step.

Both are arrays (n, ...) by name. Copying worlds, saving and resuming work through the names, so a
rule that adds a column has nothing else to do.
"""

from collections.abc import ItemsView, Iterator, Mapping
from enum import IntEnum
from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats, Mask

BLUE: Final = 0
"""Index of team blue in events and scores."""
YELLOW: Final = 1
"""Index of team yellow in events and scores."""
NOBODY: Final = -1
"""Index of the team or the robot where there is none."""


class EventKind(IntEnum):
    """Kind of an event. Numbers below 1000 are those of the SSL game controller.

    Source: the enumeration `GameEvent.Type` of the game controller's messages.
    """

    NONE = 0
    """An empty slot."""
    NO_PROGRESS_IN_GAME = 2
    """The ball is stuck; VSSS: a free ball."""
    BALL_LEFT_FIELD_TOUCH_LINE = 6
    """The ball left the field over a touch line; the robot touched it last."""
    BALL_LEFT_FIELD_GOAL_LINE = 7
    """The ball left the field over a goal line; the robot touched it last."""
    GOAL = 8
    """A goal that counts: its team scored, its robot touched the ball last."""
    PASS = 1000
    """A pass arrived: of its team, at its robot."""


class Event(NamedTuple):
    """One event of a step."""

    kind: EventKind
    """Kind of the event."""
    team: int
    """Team that it is about: `BLUE`, `YELLOW` or `NOBODY`."""
    robot: int
    """Index of the robot in the order of a state row, or `NOBODY`."""
    position: tuple[float, float]
    """Position of the event, x and y, m."""


class NamedArrays(Mapping[str, Array]):
    """Arrays (n, ...) by name, which are attributes too: `arrays.name` is `arrays["name"]`."""

    def __init__(self, arrays: Mapping[str, Array]) -> None:
        """Name arrays.

        Args:
            arrays: arrays (n, ...) by name; not copied.
        """
        self.__dict__.update(arrays)

    def __getitem__(self, name: str) -> Array:
        array: Array = self.__dict__[name]
        return array

    def __getattr__(self, name: str) -> Array:
        raise AttributeError(f"{type(self).__name__} has no {name!r}; it has {list(self)}")

    def __iter__(self) -> Iterator[str]:
        return iter(self.__dict__)

    def __len__(self) -> int:
        return len(self.__dict__)

    def items(self) -> ItemsView[str, Array]:
        """Return the names and arrays."""
        return self.__dict__.items()  # `Mapping`'s own looks each name up

    def take(self, worlds: NDArray[np.intp]) -> Self:
        """Return a copy of some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        return type(self)({name: array[worlds] for name, array in self.items()})

    def put(self, worlds: NDArray[np.intp], part: Mapping[str, Array]) -> None:
        """Overwrite some worlds.

        Args:
            worlds: (k,) indices of worlds.
            part: arrays (k, ...) of the same names.
        """
        for name, array in self.items():
            array[worlds] = part[name]


class Game(NamedArrays):
    """State of the game in n worlds: the score, and the columns of the task's rules."""

    score: NDArray[np.int64]
    """(n, 2) goals of blue and of yellow in the episode."""


class Events(NamedArrays):
    """Events of the last step in n worlds, in `SLOTS` slots each.

    They are cleared when the next step begins. A reset within the step that ends an episode leaves
    them, so that its last goal can be read.
    """

    SLOTS: Final = 8
    """Greatest number of events of one world in one step."""

    count: NDArray[np.int64]
    """(n,) number of events; they fill the first slots."""
    kind: NDArray[np.int16]
    """(n, slots) kinds, values of `EventKind`."""
    team: NDArray[np.int8]
    """(n, slots) teams: `BLUE`, `YELLOW` or `NOBODY`."""
    robot: NDArray[np.int16]
    """(n, slots) indices of robots in the order of a state row, or `NOBODY`."""
    position: Floats
    """(n, slots, 2) positions x, y, m."""

    @classmethod
    def empty(cls, n: int) -> "Events":
        """Return room for the events of n worlds, without any.

        Args:
            n: number of worlds.
        """
        return cls(
            {
                "count": np.zeros(n, np.int64),
                "kind": np.zeros((n, cls.SLOTS), np.int16),
                "team": np.full((n, cls.SLOTS), NOBODY, np.int8),
                "robot": np.full((n, cls.SLOTS), NOBODY, np.int16),
                "position": np.zeros((n, cls.SLOTS, 2), np.float32),
            }
        )

    def add(
        self,
        worlds: NDArray[np.intp],
        kind: EventKind | Array,
        team: int | Array = NOBODY,
        robot: int | Array = NOBODY,
        position: Floats | float = 0.0,
    ) -> None:
        """Add one event to each of some worlds.

        Args:
            worlds: (k,) indices of worlds, each at most once.
            kind: kind of all events, or (k,) kinds.
            team: team of all events, or (k,) teams.
            robot: index of the robot of all events, or (k,) indices.
            position: (k, 2) positions, m.

        Raises:
            RuntimeError: a world without a free slot.
        """
        slots = self.count[worlds]
        if len(slots) and slots.max() >= self.SLOTS:
            raise RuntimeError(f"events: expected at most {self.SLOTS} in a step of a world")
        values = {"kind": kind, "team": team, "robot": robot, "position": position}
        for name, value in values.items():
            self[name][worlds, slots] = value
        self.count[worlds] += 1

    def forget(self, worlds: NDArray[np.intp] | slice = slice(None)) -> None:
        """Remove the events of some worlds.

        Args:
            worlds: (k,) indices of worlds; all by default.
        """
        if np.count_nonzero(self.count):
            self.count[worlds] = 0
            self.kind[worlds] = EventKind.NONE

    def happened(self, kind: EventKind) -> Mask:
        """Return the worlds with an event of a kind.

        Args:
            kind: the kind.

        Returns:
            (n,).
        """
        if not np.count_nonzero(self.count):  # in most steps
            return np.zeros(len(self.count), np.bool_)
        found: Mask = (self.kind == kind).any(axis=1)
        return found

    def by_team(self, kind: EventKind) -> NDArray[np.int64]:
        """Count the events of a kind for each team.

        Args:
            kind: the kind.

        Returns:
            (n, 2) of blue and of yellow.
        """
        counts = np.zeros((len(self.count), 2), np.int64)
        if np.count_nonzero(self.count):
            matching = self.kind == kind
            for team in (BLUE, YELLOW):
                counts[:, team] = (matching & (self.team == team)).sum(axis=1)
        return counts

    def of_world(self, world: int) -> list[Event]:
        """Return the events of one world, in the order in which they were added.

        Args:
            world: index of the world.
        """
        return [
            Event(
                EventKind(self.kind[world, slot]),
                int(self.team[world, slot]),
                int(self.robot[world, slot]),
                (float(self.position[world, slot, 0]), float(self.position[world, slot, 1])),
            )
            for slot in range(int(self.count[world]))
        ]


def new_game(n: int, columns: Mapping[str, Array]) -> Game:
    """Return the state of the game at the start of n episodes.

    Args:
        n: number of worlds.
        columns: (n, ...) columns of the rules by name.
    """
    return Game({"score": np.zeros((n, 2), np.int64), **columns})
