"""Lines and goals that the ball crossed between two frames."""

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import CROSSINGS, Field
from rsoccer.arrays import Floats
from rsoccer.frame import Frame


class Crossing(NamedTuple):
    """The lines that balls crossed outward."""

    line: NDArray[np.intp]
    """(n,) indices into `CROSSINGS`; 0 for none."""
    at: Floats
    """(n, 3) points of the crossings, m; 0 without one."""


def _line(name: str) -> tuple[int, int]:
    """Index of a line, and of the goal in it."""
    end = name.removeprefix("goal_line_")
    outside = CROSSINGS.index(name)
    return outside, outside if end == name else CROSSINGS.index(f"goal_{end}")


# For each axis, the lines at its positive and its negative end, with the goals in them.
_LINES: Final = (
    (_line("goal_line_right"), _line("goal_line_left")),
    (_line("touch_line_left"), _line("touch_line_right")),
)


def crossing(last: Frame, frame: Frame, field: Field) -> Crossing:
    """Find the lines that the balls' centers crossed outward, on straight paths.

    Args:
        last: earlier positions of the balls.
        frame: present positions of the balls.
        field: lines and goals.

    Returns:
        The first line of each world, and the point.
    """
    n = len(frame)
    before = np.column_stack([last.ball.position, last.ball.height])
    path = np.column_stack([frame.ball.position, frame.ball.height]) - before
    half = np.array([field.half_length, field.half_width], np.float32)
    first = np.full(n, np.inf, np.float32)
    found = Crossing(np.zeros(n, np.intp), np.zeros((n, 3), np.float32))
    for axis, names in enumerate(_LINES):
        for sign, (outside, goal) in zip((1, -1), names, strict=True):
            start, way = sign * before[:, axis], sign * path[:, axis]
            leaves = (start <= half[axis]) & (start + way > half[axis])
            fraction = np.zeros(n, np.float32)
            np.divide(half[axis] - start, way, out=fraction, where=leaves)
            at = before + path * fraction[:, None]
            leaves &= (np.abs(at[:, 1 - axis]) <= half[1 - axis]) & (fraction < first)
            in_goal = (np.abs(at[:, 1]) < field.goal_width / 2) & (at[:, 2] < field.goal_height)
            line = np.where(in_goal, goal, outside)
            found.line[leaves], found.at[leaves] = line[leaves], at[leaves]
            first[leaves] = fraction[leaves]
    return found
