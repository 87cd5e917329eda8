"""Courses of the dribbling task: robots in a line, and the gates between them as data."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.frame import Floats, Mask


@dataclass(frozen=True)
class Course:
    """Gates on one line of the field, to be crossed by the ball in order. Metres."""

    opponents: tuple[tuple[float, float], ...]  # where the robots stand that make the gates
    start: tuple[float, float, float]  # x, y and heading (rad) of the one that dribbles
    bounds: tuple[
        tuple[float, float], tuple[float, float]
    ]  # least and greatest x and y it may be at
    line: float  # where the gates are, on the axis that the ball crosses them along
    crosses: int  # that axis: 0 is x, 1 is y
    gates: tuple[tuple[float, float, float], ...]  # from, to along the line; way: +1 or -1

    @property
    def table(self) -> Floats:
        """(gates, 3) from, to, way."""
        return np.array(self.gates, np.float32)

    def crossed(self, gate: Floats, before: Floats, after: Floats) -> tuple[Mask, Mask]:
        """Whether balls (n, 2) went through gates (n, 3) the right way, and the wrong way; (n,)."""
        first, last, way = gate.T
        line = np.float32(self.line)
        from_line, to_line = before[:, self.crosses] - line, after[:, self.crosses] - line
        along = after[:, 1 - self.crosses]
        between = (first < along) & (along < last)
        right: Mask = between & (way * from_line <= 0.0) & (way * to_line > 0.0)
        wrong: Mask = between & (way * from_line > 0.0) & (way * to_line <= 0.0)
        return right, wrong

    def way_to_go(self, gate: Floats, ball: Floats) -> Floats:
        """Metres from balls (n, 2) to the middle of gates (n, 3); more on the far side; (n,)."""
        first, last, way = gate.T
        along = ball[:, 1 - self.crosses] - np.float32(0.5) * (first + last)
        beyond = way * (ball[:, self.crosses] - np.float32(self.line))
        distance: Floats = np.sqrt(along * along + beyond * beyond)
        distance += np.float32(2.0) * np.maximum(beyond, np.float32(0.0))
        return distance


_DOWN, _UP = -1.0, 1.0

# The paper's: four robots on the x axis, seven crossings, the last two gates by turns.
PAPER: Final = Course(
    opponents=((-0.5, 0.0), (-1.0, 0.0), (-1.5, 0.0), (-2.0, 0.0)),
    start=(0.0, 0.0, np.pi),
    bounds=((-3.0, -1.0), (1.0, 1.0)),
    line=0.0,
    crosses=1,
    gates=(
        (-1.0, -0.5, _DOWN),
        (-1.5, -1.0, _UP),
        (-2.0, -1.5, _DOWN),
        (-3.0, -2.0, _UP),
        (-2.0, -1.5, _DOWN),
        (-3.0, -2.0, _UP),
        (-2.0, -1.5, _DOWN),
    ),
)

# The official one: five robots on x = -1.5, gates from the nearest on, the last one three times.
OFFICIAL: Final = Course(
    opponents=((-1.5, 1.5), (-1.5, 0.9), (-1.5, 0.4), (-1.5, -0.2), (-1.5, -1.0)),
    start=(-1.5, -1.9, np.pi / 2),
    bounds=((-3.0, -2.0), (0.0, 2.0)),
    line=-1.5,
    crosses=0,
    gates=(
        (-1.0, -0.2, 1.0),
        (-0.2, 0.4, -1.0),
        (0.4, 0.9, 1.0),
        (0.9, 1.5, -1.0),
        (0.9, 1.5, 1.0),
        (0.9, 1.5, -1.0),
    ),
)

COURSES: Final = {"paper": PAPER, "official": OFFICIAL}
