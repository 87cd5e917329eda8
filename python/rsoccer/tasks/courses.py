"""Courses of the dribbling task as data: robots in a line and the gates between them."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from rsoccer.arrays import Floats, Mask


@dataclass(frozen=True)
class Course:
    """Gates on one line of the field that the ball must cross in order."""

    opponents: tuple[tuple[float, float], ...]
    """Positions x, y of the robots that are the posts of the gates, m."""
    start: tuple[float, float, float]
    """Initial x and y, m, and heading, rad, of the dribbling robot."""
    bounds: tuple[tuple[float, float], tuple[float, float]]
    """Lower and upper corner x, y of the area that the dribbling robot must not leave, m."""
    line: float
    """Position of the gates on the axis `crosses`, m."""
    crosses: int
    """Axis along which the ball crosses the gates: 0 is x, 1 is y."""
    gates: tuple[tuple[float, float, float], ...]
    """Crossings in order: ends of the gate on the other axis, m, and direction, +1 or -1."""

    @property
    def table(self) -> Floats:
        """(gates, 3) lower end, upper end, direction."""
        return np.array(self.gates, np.float32)

    def crossed(self, gate: Floats, before: Floats, after: Floats) -> tuple[Mask, Mask]:
        """Test whether balls crossed gates in the last step.

        Args:
            gate: (n, 3) rows of `table`.
            before: (n, 2) positions of the balls before the step, m.
            after: (n, 2) positions after it, m.

        Returns:
            Masks (n,) of the crossings in the gate's direction and in the opposite one.
        """
        low, high, direction = gate.T
        line = np.float32(self.line)
        from_line, to_line = before[:, self.crosses] - line, after[:, self.crosses] - line
        along = after[:, 1 - self.crosses]
        between = (low < along) & (along < high)
        forward: Mask = between & (direction * from_line <= 0.0) & (direction * to_line > 0.0)
        backward: Mask = between & (direction * from_line > 0.0) & (direction * to_line <= 0.0)
        return forward, backward

    def gate_distance(self, gate: Floats, ball: Floats) -> Floats:
        """Compute the distance from balls to the middle of gates, with a penalty beyond the line.

        The penalty is twice the distance beyond the line, as the ball has to go back around.

        Args:
            gate: (n, 3) rows of `table`.
            ball: (n, 2) positions of the balls, m.

        Returns:
            (n,) meters.
        """
        low, high, direction = gate.T
        along = ball[:, 1 - self.crosses] - np.float32(0.5) * (low + high)
        beyond = direction * (ball[:, self.crosses] - np.float32(self.line))
        distance: Floats = np.sqrt(along * along + beyond * beyond)
        distance += np.float32(2.0) * np.maximum(beyond, np.float32(0.0))
        return distance


_DOWN, _UP = -1.0, 1.0

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
"""Course of the rSoccer paper: four robots on the x axis, seven crossings."""

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
"""Course of hardware challenge 3: five robots on x = -1.5 m, six crossings.

They begin at the nearest gate and cross the last gate three times.
"""

COURSES: Final = {"paper": PAPER, "official": OFFICIAL}
"""Courses by the value of the option `scenario`."""
