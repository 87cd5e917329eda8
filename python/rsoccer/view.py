"""State as each robot that looks sees it: me, mates, foes and ball, always attacking +x.

For yellow the game is turned half round, so no task and no policy asks "am I yellow?". The core
fills a view, for all seers of all worlds in one call.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer import _core
from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.frame import BallColumns, Floats, Frame, Mask, RobotColumns

SIDES = ("blue", "yellow")


class View:
    """One moment as each seer has it; `robots` are me, then mates, then foes.

    Where teams differ in size some slots stay empty: zeros, and False in `present`.
    """

    __slots__ = ("ball", "foes", "mates", "me", "n_mates", "present", "robots")

    def __init__(self, ball: Floats, robots: Floats, n_mates: int, present: Mask) -> None:
        """View `ball` (n, seers, ...) and `robots` (n, seers, 1 + mates + foes, ...) by name."""
        self.n_mates = n_mates
        self.present = present  # (seers, 1 + mates + foes) whether a robot is in the slot
        self.ball = BallColumns(ball)  # (n, seers, ...)
        self.robots = RobotColumns(robots)  # (n, seers, 1 + mates + foes, ...)
        self.me = RobotColumns(robots[:, :, 0])  # (n, seers, ...)
        self.mates = RobotColumns(robots[:, :, 1 : 1 + n_mates])  # (n, seers, mates, ...)
        self.foes = RobotColumns(robots[:, :, 1 + n_mates :])  # (n, seers, foes, ...)

    def select(self, seats: slice | NDArray[np.intp]) -> "View":
        """The view of some of the seers, by their place among them."""
        robots = self.robots.data[:, seats]
        return View(self.ball.data[:, seats], robots, self.n_mates, self.present[seats])

    def take(self, worlds: NDArray[np.intp]) -> "View":
        """A copy of the view in some worlds."""
        return View(self.ball.data[worlds], self.robots.data[worlds], self.n_mates, self.present)

    def put(self, worlds: NDArray[np.intp], part: "View") -> None:
        """Overwrite the view in some worlds."""
        self.ball.data[worlds] = part.ball.data
        self.robots.data[worlds] = part.robots.data

    def __reduce__(self) -> tuple[type["View"], tuple[Floats, Floats, int, Mask]]:
        # Pickled piece by piece, the names would become copies.
        return View, (self.ball.data, self.robots.data, self.n_mates, self.present)


def slots(n_blue: int, n_yellow: int, sides: Sequence[str] = SIDES) -> tuple[int, int]:
    """Mates and foes that a view has room for: those of the largest team among `sides`."""
    sizes = {"blue": (n_blue, n_yellow), "yellow": (n_yellow, n_blue)}
    return max(sizes[side][0] for side in sides) - 1, max(sizes[side][1] for side in sides)


class Viewpoint:
    """Who looks, and from where: turns frames into views, in place."""

    def __init__(
        self, n_blue: int, n_yellow: int, seers: Sequence[int], sides: Sequence[str] = SIDES
    ) -> None:
        """Look through robots `seers`; slots fit the largest team among `sides`."""
        self._made_of = n_blue, n_yellow, tuple(seers), tuple(sides)
        self._n_mates, self._n_foes = slots(n_blue, n_yellow, sides)
        self.seers = np.asarray(seers, np.intp)  # (seers,)
        seats = [self._slots(seer, n_blue, n_yellow) for seer in seers]
        turned = [bool(seer >= n_blue) for seer in seers]
        self._viewpoint = _core.Viewpoint(n_blue + n_yellow, seats, turned)
        shape = (len(seers), 1 + self._n_mates + self._n_foes)
        present = [robot is not None for seat in seats for robot in seat]
        self._present = np.array(present, np.bool_).reshape(shape)

    def new_view(self, n: int) -> View:
        """Buffers for n worlds."""
        ball = np.zeros((n, len(self.seers), len(BALL_COLUMNS)), np.float32)
        robots = np.zeros((n, *self._present.shape, len(ROBOT_COLUMNS)), np.float32)
        return View(ball, robots, self._n_mates, self._present)

    def fill(self, frame: Frame, view: View) -> None:
        """Show each seer itself, its mates, then its foes, attacking +x."""
        if len(self.seers):
            self._viewpoint.fill(frame.rows, view.ball.data, view.robots.data)

    def __reduce__(self) -> tuple[type["Viewpoint"], tuple[object, ...]]:
        return Viewpoint, self._made_of

    def _slots(self, seer: int, n_blue: int, n_yellow: int) -> list[int | None]:
        """Which robots one seer has in its slots: itself, mates in ring order, foes."""
        blue, yellow = range(n_blue), range(n_blue, n_blue + n_yellow)
        mates, foes = (blue, yellow) if seer in blue else (yellow, blue)
        if len(mates) - 1 > self._n_mates or len(foes) > self._n_foes:
            raise ValueError(f"robot {seer} cannot look: its side is not among the task's sides")
        nobody: list[int | None] = [None]
        mates_too = [*range(seer, mates.stop), *range(mates.start, seer)]
        no_mates = nobody * (1 + self._n_mates - len(mates))
        return [*mates_too, *no_mates, *foes, *nobody * (self._n_foes - len(foes))]
