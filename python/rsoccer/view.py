"""State as each robot that looks sees it: ego, teammates, opponents and ball, always attacking +x.

For yellow the game is turned half round, so no task and no policy asks "am I yellow?". The core
fills a view, for all observers of all worlds in one call.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer import _core
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.frame import BallColumns, Floats, Frame, Mask, RobotColumns

SIDES = ("blue", "yellow")


class View:
    """One moment as each observer has it; `robots` are ego, then teammates, then opponents.

    Where teams differ in size some slots stay empty: zeros, and False in `present`.
    """

    __slots__ = ("ball", "ego", "n_teammates", "opponents", "present", "robots", "teammates")

    def __init__(self, ball: Floats, robots: Floats, n_teammates: int, present: Mask) -> None:
        """View `ball` (n, observers, ...) and `robots` (n, observers, 1 + teammates + opponents, ...) by name."""
        self.n_teammates = n_teammates
        self.present = (
            present  # (observers, 1 + teammates + opponents) whether a robot is in the slot
        )
        self.ball = BallColumns(ball)  # (n, observers, ...)
        self.robots = RobotColumns(robots)  # (n, observers, 1 + teammates + opponents, ...)
        self.ego = RobotColumns(robots[:, :, 0])  # (n, observers, ...)
        self.teammates = RobotColumns(
            robots[:, :, 1 : 1 + n_teammates]
        )  # (n, observers, teammates, ...)
        self.opponents = RobotColumns(
            robots[:, :, 1 + n_teammates :]
        )  # (n, observers, opponents, ...)

    def select(self, seats: slice | NDArray[np.intp]) -> "View":
        """The view of some of the observers, by their place among them."""
        robots = self.robots.data[:, seats]
        return View(self.ball.data[:, seats], robots, self.n_teammates, self.present[seats])

    def take(self, worlds: NDArray[np.intp]) -> "View":
        """A copy of the view in some worlds."""
        return View(
            self.ball.data[worlds], self.robots.data[worlds], self.n_teammates, self.present
        )

    def put(self, worlds: NDArray[np.intp], part: "View") -> None:
        """Overwrite the view in some worlds."""
        self.ball.data[worlds] = part.ball.data
        self.robots.data[worlds] = part.robots.data

    def __reduce__(self) -> tuple[type["View"], tuple[Floats, Floats, int, Mask]]:
        # Pickled piece by piece, the names would become copies.
        return View, (self.ball.data, self.robots.data, self.n_teammates, self.present)


def slots(n_blue: int, n_yellow: int, sides: Sequence[str] = SIDES) -> tuple[int, int]:
    """Teammates and opponents that a view has room for: those of the largest team among `sides`."""
    sizes = {"blue": (n_blue, n_yellow), "yellow": (n_yellow, n_blue)}
    return max(sizes[side][0] for side in sides) - 1, max(sizes[side][1] for side in sides)


class Viewpoint:
    """Who looks, and from where: turns frames into views, in place."""

    def __init__(
        self, n_blue: int, n_yellow: int, observers: Sequence[int], sides: Sequence[str] = SIDES
    ) -> None:
        """Look through robots `observers`; slots fit the largest team among `sides`."""
        self._made_of = n_blue, n_yellow, tuple(observers), tuple(sides)
        self._n_teammates, self._n_opponents = slots(n_blue, n_yellow, sides)
        self.observers = np.asarray(observers, np.intp)  # (observers,)
        seats = [self._slots(observer, n_blue, n_yellow) for observer in observers]
        turned = [bool(observer >= n_blue) for observer in observers]
        self._viewpoint = _core.Viewpoint(n_blue + n_yellow, seats, turned)
        shape = (len(observers), 1 + self._n_teammates + self._n_opponents)
        present = [robot is not None for seat in seats for robot in seat]
        self._present = np.array(present, np.bool_).reshape(shape)

    def new_view(self, n: int) -> View:
        """Buffers for n worlds."""
        ball = np.zeros((n, len(self.observers), len(BALL_COLUMNS)), np.float32)
        robots = np.zeros((n, *self._present.shape, len(ROBOT_COLUMNS)), np.float32)
        return View(ball, robots, self._n_teammates, self._present)

    def fill(self, frame: Frame, view: View) -> None:
        """Show each observer itself, its teammates, then its opponents, attacking +x."""
        if len(self.observers):
            self._viewpoint.fill(frame.rows, view.ball.data, view.robots.data)

    def __reduce__(self) -> tuple[type["Viewpoint"], tuple[object, ...]]:
        return Viewpoint, self._made_of

    def _slots(self, observer: int, n_blue: int, n_yellow: int) -> list[int | None]:
        """Which robots one observer has in its slots: itself, teammates in ring order, opponents."""
        blue, yellow = range(n_blue), range(n_blue, n_blue + n_yellow)
        teammates, opponents = (blue, yellow) if observer in blue else (yellow, blue)
        if len(teammates) - 1 > self._n_teammates or len(opponents) > self._n_opponents:
            raise ValueError(
                f"robot {observer} cannot look: its side is not among the task's sides"
            )
        nobody: list[int | None] = [None]
        teammates_too = [*range(observer, teammates.stop), *range(teammates.start, observer)]
        no_teammates = nobody * (1 + self._n_teammates - len(teammates))
        return [
            *teammates_too,
            *no_teammates,
            *opponents,
            *nobody * (self._n_opponents - len(opponents)),
        ]
