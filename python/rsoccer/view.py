"""State as each robot that looks sees it: me, mates, foes and ball, always attacking +x.

For yellow the game is turned half round, so no task and no policy asks "am I yellow?". A view
is filled by one gather and one multiplication for all seers of all worlds.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
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
        self._n_mates, self._n_foes = slots(n_blue, n_yellow, sides)
        self.seers = np.asarray(seers, np.intp)  # (seers,)
        shape = (len(seers), 1 + self._n_mates + self._n_foes)
        order = np.zeros(shape, np.intp)
        self._present = np.zeros(shape, np.bool_)
        for seat, seer in enumerate(seers):
            self._seat(order[seat], self._present[seat], seer, n_blue, n_yellow)
        self._order = order.ravel()
        yellow = self.seers >= n_blue
        self._yellow = np.flatnonzero(yellow)
        ball_signs = np.where(yellow[:, None], _turned(BALL_COLUMNS), np.float32(1.0))
        robot_signs = np.where(yellow[:, None], _turned(ROBOT_COLUMNS), np.float32(1.0))
        self._ball_signs = ball_signs  # (seers, ball column)
        self._robot_signs = (robot_signs[:, None] * self._present[:, :, None]).ravel()

    def new_view(self, n: int) -> View:
        """Buffers for n worlds."""
        ball = np.zeros((n, len(self.seers), len(BALL_COLUMNS)), np.float32)
        robots = np.zeros((n, *self._present.shape, len(ROBOT_COLUMNS)), np.float32)
        return View(ball, robots, self._n_mates, self._present)

    def fill(self, frame: Frame, view: View) -> None:
        """Show each seer itself, its mates, then its foes, attacking +x."""
        if not len(self.seers):
            return
        n = len(frame)
        robots = view.robots.data.reshape(n, len(self._order), len(ROBOT_COLUMNS))
        # mode="clip" because the default mode buffers `out`.
        np.take(frame.robots.data, self._order, axis=1, out=robots, mode="clip")
        flat = robots.reshape(n, -1)  # one long axis: short inner loops cost more than the work
        np.multiply(flat, self._robot_signs, out=flat)
        np.multiply(frame.ball.data[:, None], self._ball_signs, out=view.ball.data)
        if len(self._yellow):
            crossed = _OTHER_SIDE[frame.ball.crossed.astype(np.intp)]
            view.ball.crossed[:, self._yellow] = crossed[:, None]

    def _seat(
        self, order: NDArray[np.intp], present: Mask, seer: int, n_blue: int, n_yellow: int
    ) -> None:
        """Write which robots one seer has in its slots: itself, mates in ring order, foes."""
        blue = seer < n_blue
        first, size = (0, n_blue) if blue else (n_blue, n_yellow)
        first_foe, n_foes = (n_blue, n_yellow) if blue else (0, n_blue)
        if size - 1 > self._n_mates or n_foes > self._n_foes:
            raise ValueError(f"robot {seer} cannot look: its side is not among the task's sides")
        order[:size] = first + (seer - first + np.arange(size)) % size
        order[1 + self._n_mates : 1 + self._n_mates + n_foes] = first_foe + np.arange(n_foes)
        present[:size] = True
        present[1 + self._n_mates : 1 + self._n_mates + n_foes] = True


def _turned(columns: tuple[str, ...]) -> Floats:
    """-1 where a half turn flips the sign: components along the field's x and y axes."""
    flips = [name in ("x", "y", "cos", "sin") or name.endswith(("_x", "_y")) for name in columns]
    return np.where(flips, np.float32(-1.0), np.float32(1.0))


def _other_side(crossing: str) -> str:
    swap = {"right": "left", "left": "right"}
    return "_".join(swap.get(word, word) for word in crossing.split("_"))


# (crossings,) the code that yellow reads for each code of the frame
_OTHER_SIDE = np.array([CROSSINGS.index(_other_side(name)) for name in CROSSINGS], np.float32)
