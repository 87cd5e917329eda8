"""Reference implementation of views in NumPy, to check the core against."""

import numpy as np

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.view import SIDES, slot_counts

ABSENT = ROBOT_COLUMNS.index("absent")


def reference_view(
    frame: Frame, observer: int, sides: tuple[str, ...] = SIDES
) -> tuple[Floats, Floats]:
    """Ball (n, ball column) and robots (n, slots, robot column) in one observer's coordinates."""
    n_teammates, n_opponents = slot_counts(frame.n_blue, frame.n_yellow, sides)
    teams = np.arange(frame.n_blue), frame.n_blue + np.arange(frame.n_yellow)
    rotated = observer >= frame.n_blue
    teammates, opponents = teams[::-1] if rotated else teams
    teammates = np.roll(teammates, -int(np.flatnonzero(teammates == observer)[0]))
    robots = np.zeros((len(frame), 1 + n_teammates + n_opponents, len(ROBOT_COLUMNS)), np.float32)
    robots[..., ABSENT] = 1.0
    robots[:, : len(teammates)] = frame.robots.data[:, teammates]
    robots[:, 1 + n_teammates : 1 + n_teammates + len(opponents)] = frame.robots.data[:, opponents]
    robots *= np.where(np.arange(len(ROBOT_COLUMNS)) == ABSENT, 1.0, 1.0 - robots[..., [ABSENT]])
    ball = frame.ball.data.copy()
    if rotated:
        robots *= _signs(ROBOT_COLUMNS)
        ball *= _signs(BALL_COLUMNS)
        column = BALL_COLUMNS.index("crossed")
        ball[:, column] = _OTHER_SIDE[ball[:, column].astype(np.intp)]
    return ball, robots


def _signs(columns: tuple[str, ...]) -> Floats:
    """-1 where a half turn flips the sign: components along the field's x and y axes."""
    flips = [name in ("x", "y", "cos", "sin") or name.endswith(("_x", "_y")) for name in columns]
    return np.where(flips, np.float32(-1.0), np.float32(1.0))


# (crossings,) code of a crossing for yellow, by its code in the frame
_SWAP = {"right": "left", "left": "right"}
_OTHER_SIDE = np.array(
    [
        CROSSINGS.index("_".join(_SWAP.get(word, word) for word in name.split("_")))
        for name in CROSSINGS
    ],
    np.float32,
)
