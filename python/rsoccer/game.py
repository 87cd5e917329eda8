"""State of the game besides the bodies: score, state of the rules, and the events of a step.

Both are arrays (n, ...) by name. Copying worlds, saving and resuming work through the names, so a
rule that adds a column has nothing else to do.
"""

import re
from collections.abc import ItemsView, Iterator, Mapping, Sequence
from enum import IntEnum
from typing import Final, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import GAME_COLUMNS, MAX_EVENTS, STATISTICS_COLUMNS
from rsoccer.arrays import Array, Floats, Mask, read_only

_ENDS: Final = re.compile(r"(_(blue|yellow|x|y|\d+))+$")
"""Ends of the names of columns that belong together."""


def _places(columns: Sequence[str]) -> dict[str, int | slice]:
    """Place of each column in a row, and of the columns whose names differ in their ends only."""
    places: dict[str, int | slice] = {name: i for i, name in enumerate(columns)}
    for i, name in enumerate(columns):
        group = _ENDS.sub("", name)
        if group != name:
            before = places.get(group, slice(i, i))
            places[group] = slice(before.start, i + 1) if isinstance(before, slice) else before
    return places


_COLUMNS: Final = {
    "referee": _places(GAME_COLUMNS),
    "statistics": _places(STATISTICS_COLUMNS),
}
"""Places of columns by the name of the row that has them."""

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
    PLACEMENT_FAILED = 3
    """The team did not place the ball in time."""
    PLACEMENT_SUCCEEDED = 5
    """The team placed the ball."""
    BALL_LEFT_FIELD_TOUCH_LINE = 6
    """The ball left the field over a touch line; the robot touched it last."""
    BALL_LEFT_FIELD_GOAL_LINE = 7
    """The ball left the field over a goal line; the robot touched it last."""
    GOAL = 8
    """A goal that counts: its team scored, its robot touched the ball last."""
    AIMLESS_KICK = 11
    """SSL division B: the robot kicked the ball from its own half over the far goal line."""
    KEEPER_HELD_BALL = 13
    """The ball was in the team's goal area for too long; VSSS: it is stuck there."""
    ATTACKER_DOUBLE_TOUCHED_BALL = 14
    """The robot that took the kick touched the ball again."""
    ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA = 15
    """The robot touched the ball in the area that it attacks; VSSS: two attackers were there."""
    BOT_DRIBBLED_BALL_TOO_FAR = 17
    """The robot dribbled the ball too far."""
    BOT_KICKED_BALL_TOO_FAST = 18
    """The robot kicked the ball too fast."""
    ATTACKER_TOO_CLOSE_TO_DEFENSE_AREA = 19
    """The robot was too near to the area that it attacks, in a stop or before a free kick."""
    BOT_INTERFERED_PLACEMENT = 20
    """The robot was in the way of a ball placement."""
    BOT_CRASH_DRAWN = 21
    """Two robots crashed at about the same speed: a foul of both teams."""
    BOT_CRASH_UNIQUE = 22
    """The robot crashed into a slower one."""
    BOT_PUSHED_BOT = 24
    """The robot pushed an opponent."""
    BOT_TOO_FAST_IN_STOP = 28
    """The robot was too fast in a stop."""
    DEFENDER_TOO_CLOSE_TO_KICK_POINT = 29
    """The robot was too near to the ball before the opponents' kick."""
    DEFENDER_IN_DEFENSE_AREA = 31
    """The robot touched the ball in its own area; VSSS: two defenders were there."""
    MULTIPLE_CARDS = 32
    """The team got a red card."""
    MULTIPLE_FOULS = 34
    """The team got a card for its fouls."""
    UNSPORTING_BEHAVIOR_MINOR = 35
    """The robot did not keep to its position at a penalty kick."""
    TOO_MANY_ROBOTS = 38
    """The team did not take its robots out in time."""
    BOUNDARY_CROSSING = 41
    """The robot kicked the ball over the walls."""
    INVALID_GOAL = 42
    """A goal of the team that does not count."""
    PENALTY_KICK_FAILED = 43
    """The penalty kick of the team ended without a goal."""
    PASS = 1000
    """A pass arrived: of its team, at its robot."""


class Command(IntEnum):
    """Command of the referee. Numbers below 100 are those of the SSL game controller.

    Source: the enumeration `Referee.Command` of the game controller's messages.
    """

    HALT = 0
    """All robots stop at once."""
    STOP = 1
    """Robots keep away from the ball and drive slowly."""
    NORMAL_START = 2
    """The kick that was prepared may be taken."""
    FORCE_START = 3
    """The ball is free for both teams."""
    PREPARE_KICKOFF_YELLOW = 4
    """Yellow prepares its kick-off."""
    PREPARE_KICKOFF_BLUE = 5
    """Blue prepares its kick-off."""
    PREPARE_PENALTY_YELLOW = 6
    """Yellow prepares its penalty kick."""
    PREPARE_PENALTY_BLUE = 7
    """Blue prepares its penalty kick."""
    DIRECT_FREE_YELLOW = 8
    """Yellow may take a free kick."""
    DIRECT_FREE_BLUE = 9
    """Blue may take a free kick."""
    BALL_PLACEMENT_YELLOW = 16
    """Yellow places the ball."""
    BALL_PLACEMENT_BLUE = 17
    """Blue places the ball."""
    FREE_BALL = 100
    """VSSS: a free ball is prepared."""
    GOAL_KICK_YELLOW = 101
    """VSSS: yellow's goal kick is prepared."""
    GOAL_KICK_BLUE = 102
    """VSSS: blue's goal kick is prepared."""


class Stage(IntEnum):
    """Part of a match, by the number of the SSL game controller.

    Source: the enumeration `Referee.Stage` of the game controller's messages.
    """

    NORMAL_FIRST_HALF_PRE = 0
    """Before the first kick-off."""
    NORMAL_FIRST_HALF = 1
    """First half."""
    NORMAL_HALF_TIME = 2
    """Break between the halves."""
    NORMAL_SECOND_HALF_PRE = 3
    """Before the kick-off of the second half."""
    NORMAL_SECOND_HALF = 4
    """Second half."""
    EXTRA_TIME_BREAK = 5
    """Break before extra time."""
    EXTRA_FIRST_HALF_PRE = 6
    """Before the first kick-off of extra time."""
    EXTRA_FIRST_HALF = 7
    """First half of extra time."""
    EXTRA_HALF_TIME = 8
    """Break between the halves of extra time."""
    EXTRA_SECOND_HALF_PRE = 9
    """Before the second kick-off of extra time."""
    EXTRA_SECOND_HALF = 10
    """Second half of extra time."""
    PENALTY_SHOOTOUT_BREAK = 11
    """Break before the shoot-out."""
    PENALTY_SHOOTOUT = 12
    """Alternating penalty kicks."""
    POST_GAME = 13
    """The match is over."""


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

    __slots__ = ("__dict__", "__weakref__", "_read_only")

    def __init__(self, arrays: Mapping[str, Array]) -> None:
        """Name arrays.

        Args:
            arrays: arrays (n, ...) by name; not copied.
        """
        self.__dict__.update(arrays)
        self._read_only: Self | None = None  # in a slot: `__dict__` holds the arrays alone

    @property
    def read_only(self) -> Self:
        """The same arrays in the same memory, which cannot be written through it."""
        found = self._read_only
        if found is None:
            arrays = {name: read_only(array) for name, array in self.items()}
            found = self._read_only = type(self)(arrays)
        return found

    def __setattr__(self, name: str, value: object) -> None:
        super().__setattr__(name, value)
        if name != "_read_only":
            self._read_only = None

    def __reduce__(self) -> tuple[type[Self], tuple[dict[str, Array]]]:
        # The read-only arrays would become copies, which show nothing of later writes.
        return type(self), (dict(self.__dict__),)

    def __getitem__(self, name: str) -> Array:
        array: Array = self.__dict__[name]
        return array

    def __getattr__(self, name: str) -> Array:
        raise AttributeError(f"{type(self).__name__} has no {name!r}; it has {list(self)}")

    def __contains__(self, name: object) -> bool:
        return name in self.__dict__  # `Mapping`'s own raises and catches an error

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
    """State of the game in n worlds: the score, and the columns of the task's rules.

    With a referee, `referee` holds its state: a row of numbers for each match, whose columns are
    attributes by their names in `GAME_COLUMNS` too. `game.yellow_cards_blue` is (n,), and
    `game.yellow_cards` (n, 2). So are the statistics of a match, by `STATISTICS_COLUMNS`.
    """

    score: NDArray[np.int64]
    """(n, 2) goals of blue and of yellow in the episode."""
    seconds_left: Floats
    """(n,) playing time that the stage has left, s; needs a referee."""
    may_touch: Mask
    """(n, robots) whether the robot may touch the ball; needs a referee."""

    def __getattr__(self, name: str) -> Array:
        for row, columns in _COLUMNS.items():
            if name in columns and row in self.__dict__:
                return self[row][:, columns[name]]
        return super().__getattr__(name)

    @property
    def command(self) -> NDArray[np.int64]:
        """(n,) command of the referee, values of `Command`; needs a referee."""
        return self._codes("command")

    @property
    def next_command(self) -> NDArray[np.int64]:
        """(n,) command that follows, values of `Command`, -1 for none; needs a referee."""
        return self._codes("next_command")

    @property
    def stage(self) -> NDArray[np.int64]:
        """(n,) part of the match, values of `Stage`; needs a referee."""
        return self._codes("stage")

    def _codes(self, name: str) -> NDArray[np.int64]:
        column = _COLUMNS["referee"][name]
        codes: NDArray[np.int64] = self["referee"][:, column].astype(np.int64)
        return codes


class Events(NamedArrays):
    """Events of the last step in n worlds, in `SLOTS` slots each.

    They are cleared when the next step begins. A reset within the step that ends an episode leaves
    them, so that its last goal can be read.
    """

    SLOTS: Final = MAX_EVENTS
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

    def extend(self, rows: Floats) -> None:
        """Add events of some worlds.

        Args:
            rows: (k, 6) world, kind, team, robot, and position x, y (m), in the order of worlds.

        Raises:
            RuntimeError: a world without a free slot.
        """
        worlds, *values = rows[:, :4].T.astype(np.intp)
        first = np.searchsorted(worlds, worlds)  # of the same world
        slots = self.count[worlds] + np.arange(len(rows)) - first
        if slots.max() >= self.SLOTS:
            raise RuntimeError(f"events: expected at most {self.SLOTS} in a step of a world")
        for name, numbers in zip(("kind", "team", "robot"), values, strict=True):
            self[name][worlds, slots] = numbers
        self.position[worlds, slots] = rows[:, 4:]
        self.count += np.bincount(worlds, minlength=len(self.count))

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
        most = int(self.count.max())
        if most:
            matching = self.kind[:, :most] == kind
            for team in (BLUE, YELLOW):
                counts[:, team] = (matching & (self.team[:, :most] == team)).sum(axis=1)
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
