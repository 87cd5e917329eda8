"""State as each observer sees it: ego, teammates, opponents and ball, always attacking +x.

For yellow observers the field is rotated by half a turn, so tasks and policies treat both teams
alike. The core fills the views of all observers of all worlds in one call.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer import _core
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.arrays import Floats, Mask, read_only
from rsoccer.frame import BallColumns, Frame, RobotColumns

SIDES = ("blue", "yellow")


class View:
    """State of n worlds at one time in the coordinates of each observer.

    Each observer has a row of robot slots: itself, its teammates, its opponents. In teams of
    different size some slots stay empty. The columns of an empty slot and of an absent robot are 0,
    but for `absent`, which is 1.

    Attributes:
        n_teammates: number of teammate slots.
        ball: ball columns, (n, observers, ...).
        robots: columns of all slots, (n, observers, 1 + teammates + opponents, ...).
        ego: columns of the observer itself, (n, observers, ...).
        teammates: columns of its teammates, (n, observers, teammates, ...).
        opponents: columns of its opponents, (n, observers, opponents, ...).
    """

    __slots__ = ("ball", "ego", "n_teammates", "opponents", "robots", "teammates")

    def __init__(self, ball: Floats, robots: Floats, n_teammates: int) -> None:
        """Name the parts of two arrays.

        Args:
            ball: (n, observers, ball column) float32; not copied.
            robots: (n, observers, 1 + teammates + opponents, robot column) float32; not copied.
            n_teammates: number of teammate slots.
        """
        self.n_teammates = n_teammates
        self.ball = BallColumns(ball)
        self.robots = RobotColumns(robots)
        self.ego = RobotColumns(robots[:, :, 0])
        self.teammates = RobotColumns(robots[:, :, 1 : 1 + n_teammates])
        self.opponents = RobotColumns(robots[:, :, 1 + n_teammates :])

    @property
    def present(self) -> Mask:
        """(n, observers, 1 + teammates + opponents) bool, whether a robot in the slot plays."""
        return np.less_equal(self.robots.absent, 0.0)

    def select(self, observers: slice | NDArray[np.intp]) -> "View":
        """Return the view of some observers.

        Args:
            observers: (k,) positions among the observers. A slice shares memory with this view,
                an array of indices copies.
        """
        robots = self.robots.data[:, observers]
        return View(self.ball.data[:, observers], robots, self.n_teammates)

    def take(self, worlds: NDArray[np.intp]) -> "View":
        """Return a copy of the view in some worlds.

        Args:
            worlds: (k,) indices of worlds.
        """
        return View(self.ball.data[worlds], self.robots.data[worlds], self.n_teammates)

    def __reduce__(self) -> tuple[type["View"], tuple[Floats, Floats, int]]:
        # Pickled attribute by attribute, the parts would become copies.
        return View, (self.ball.data, self.robots.data, self.n_teammates)


def slot_counts(n_blue: int, n_yellow: int, sides: Sequence[str] = SIDES) -> tuple[int, int]:
    """Return the numbers of teammate slots and of opponent slots in a view.

    Args:
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.
        sides: teams with observers; the slots fit the largest of them.
    """
    sizes = {"blue": (n_blue, n_yellow), "yellow": (n_yellow, n_blue)}
    return max(sizes[side][0] for side in sides) - 1, max(sizes[side][1] for side in sides)


class Viewpoint:
    """Conversion of frames into the views of a set of observers, in place.

    Attributes:
        observers: (observers,) indices of the observing robots in the order of a state row.
        teams: (observers,) team of each observer: 0 for blue, 1 for yellow.
        signs: (observers,) float32, 1 for observers of blue and -1 for those of yellow.
        core: the same viewpoint in the core, for its features.
    """

    def __init__(
        self, n_blue: int, n_yellow: int, observers: Sequence[int], sides: Sequence[str] = SIDES
    ) -> None:
        """Prepare the conversion for a set of observers.

        Args:
            n_blue: number of blue robots.
            n_yellow: number of yellow robots.
            observers: indices of the observing robots, 0 to n_blue + n_yellow - 1.
            sides: teams with observers; the slots fit the largest of them.

        Raises:
            ValueError: an observer whose team does not fit into the slots.
        """
        self._arguments = n_blue, n_yellow, tuple(observers), tuple(sides)
        self._n_teammates, self._n_opponents = slot_counts(n_blue, n_yellow, sides)
        self.observers = np.asarray(observers, np.intp)
        slots = [self._slots(observer, n_blue, n_yellow) for observer in observers]
        rotated = self.observers >= n_blue
        self.teams = rotated.astype(np.intp)
        self.signs = read_only(np.where(rotated, -1.0, 1.0).astype(np.float32))
        self.core = _core.Viewpoint(n_blue + n_yellow, slots, rotated.tolist())
        self._shape = (len(observers), 1 + self._n_teammates + self._n_opponents)

    def new_view(self, n: int) -> View:
        """Return a view of zeros as a buffer for `fill`.

        Args:
            n: number of worlds.
        """
        ball = np.zeros((n, len(self.observers), len(BALL_COLUMNS)), np.float32)
        robots = np.zeros((n, *self._shape, len(ROBOT_COLUMNS)), np.float32)
        return View(ball, robots, self._n_teammates)

    def fill(self, frame: Frame, view: View, yellow: Frame | None = None) -> None:
        """Write a frame into a view: each observer, its teammates, its opponents, attacking +x.

        Args:
            frame: state of n worlds.
            view: view of n worlds from `new_view`; overwritten.
            yellow: state as yellow observers know it; `frame` if None.
        """
        if len(self.observers):
            rotated = None if yellow is None or yellow is frame else yellow.rows
            self.core.fill(frame.rows, view.ball.data, view.robots.data, rotated)

    def __reduce__(self) -> tuple[type["Viewpoint"], tuple[object, ...]]:
        return Viewpoint, self._arguments

    def _slots(self, observer: int, n_blue: int, n_yellow: int) -> list[int | None]:
        """Robots in an observer's slots: itself, teammates in ring order, opponents."""
        blue, yellow = range(n_blue), range(n_blue, n_blue + n_yellow)
        team, opponents = (blue, yellow) if observer in blue else (yellow, blue)
        if len(team) - 1 > self._n_teammates or len(opponents) > self._n_opponents:
            raise ValueError(
                f"robot {observer} cannot observe: its team is not among the task's sides"
            )
        empty: list[int | None] = [None]
        return [
            *range(observer, team.stop),
            *range(team.start, observer),
            *empty * (1 + self._n_teammates - len(team)),
            *opponents,
            *empty * (self._n_opponents - len(opponents)),
        ]


class CachedView:
    """View of a frame, computed when it is first read after a change of the frame."""

    __slots__ = ("_buffer", "_current", "_view")

    def __init__(self) -> None:
        """Begin without a view."""
        self._view: View | None = None
        self._buffer: View | None = None
        self._current = False

    def of(self, frame: Frame, viewpoint: Viewpoint, yellow: Frame | None = None) -> View:
        """Return the view of a frame.

        Args:
            frame: state of n worlds, the same object or an equal one until `expire`.
            viewpoint: computes the view, always the same.
            yellow: state as yellow observers know it, as `frame`; `frame` if None.

        Returns:
            The view, always the same object, which cannot be written: those who read it after
            others see the same. Overwritten by the first call after `expire`.
        """
        view, buffer = self._view, self._buffer
        if view is None or buffer is None:
            buffer = self._buffer = viewpoint.new_view(len(frame))
            ball, robots = read_only(buffer.ball.data), read_only(buffer.robots.data)
            view = self._view = View(ball, robots, buffer.n_teammates)
        if not self._current:
            viewpoint.fill(frame, buffer, yellow)
            self._current = True
        return view

    def expire(self) -> None:
        """Have the view computed again, because the frame has changed."""
        self._current = False

    def __reduce__(self) -> tuple[type["CachedView"], tuple[()]]:
        # A copy of the view would show nothing of what is written to the copy of the buffer.
        return CachedView, ()
