"""What robots see of a frame, in NumPy: what the core writes is checked against it."""

import numpy as np

from rsoccer._core import BALL_COLUMNS, CROSSINGS, ROBOT_COLUMNS
from rsoccer.frame import Floats, Frame
from rsoccer.view import SIDES, slots


def seen(frame: Frame, seer: int, sides: tuple[str, ...] = SIDES) -> tuple[Floats, Floats]:
    """Ball (n, ball column) and robots (n, slots, robot column) as one robot sees them."""
    n_mates, n_foes = slots(frame.n_blue, frame.n_yellow, sides)
    teams = np.arange(frame.n_blue), frame.n_blue + np.arange(frame.n_yellow)
    turned = seer >= frame.n_blue
    mates, foes = teams[::-1] if turned else teams
    mates = np.roll(mates, -int(np.flatnonzero(mates == seer)[0]))
    robots = np.zeros((len(frame), 1 + n_mates + n_foes, len(ROBOT_COLUMNS)), np.float32)
    robots[:, : len(mates)] = frame.robots.data[:, mates]
    robots[:, 1 + n_mates : 1 + n_mates + len(foes)] = frame.robots.data[:, foes]
    ball = frame.ball.data.copy()
    if turned:
        robots *= _signs(ROBOT_COLUMNS)
        ball *= _signs(BALL_COLUMNS)
        column = BALL_COLUMNS.index("crossed")
        ball[:, column] = _OTHER_SIDE[ball[:, column].astype(np.intp)]
    return ball, robots


def _signs(columns: tuple[str, ...]) -> Floats:
    """-1 where a half turn flips the sign: components along the field's x and y axes."""
    flips = [name in ("x", "y", "cos", "sin") or name.endswith(("_x", "_y")) for name in columns]
    return np.where(flips, np.float32(-1.0), np.float32(1.0))


# (crossings,) the code that yellow reads for each code of the frame
_SWAP = {"right": "left", "left": "right"}
_OTHER_SIDE = np.array(
    [
        CROSSINGS.index("_".join(_SWAP.get(word, word) for word in name.split("_")))
        for name in CROSSINGS
    ],
    np.float32,
)
