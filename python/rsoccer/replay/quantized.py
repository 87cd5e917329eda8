"""Arrays of a replay as whole multiples of a step, stored as differences over time.

A section holds k columns of f frames. Each number is divided by the step of its column and rounded,
so a number that is read differs by at most half a step. The differences to the frame before follow
(the first number to 0), modulo 2**32, as zigzag numbers: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
They are written column by column as 32-bit little-endian numbers, but split into four planes:
the lowest bytes of all numbers first. Small differences then compress well.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rsoccer._core import BALL_COLUMNS, ROBOT_COLUMNS
from rsoccer.arrays import Array, Doubles, Floats
from rsoccer.frame import row_size
from rsoccer.replay.container import ReplayError

Integers = NDArray[np.int32]

TURN = 2.0 * np.pi
HEADING = "heading"
"""Stored column for a robot's `cos` and `sin`: the angle, which may exceed a turn."""
STEPS = {
    **dict.fromkeys(("x", "y", "z", "crossed_x", "crossed_y", "crossed_z"), 1e-4),
    **dict.fromkeys(("v_x", "v_y", "v_z", "speed_after_touch"), 2e-3),
    **{"seconds_since_touch": 1e-3, "height_since_touch": 1e-4},
    **dict.fromkeys(("spin_x", "spin_y", "spin_z"), 0.1),
    **dict.fromkeys(("last_touch", "crossed"), 1.0),
    **dict.fromkeys(("infrared", "touched_ball", "touched_opponent", "absent"), 1.0),
    **{"v_theta": 0.02, "collision_speed": 0.01, HEADING: TURN / 2**16},
    **dict.fromkeys(("left", "right", *(f"wheel_{i}" for i in range(4))), 0.05),
    **dict.fromkeys(("kick_v_x", "kick_v_z", "dribbler"), 0.01),
}
"""Steps of columns of rows and commands, in the column's unit; flags and indices are exact."""
TERM_STEPS = 2**15
"""Steps between 0 and the largest magnitude of a reward term."""

MAX_STEP = 1e28
"""Largest step: any number of such steps is finite in float32."""

_MAX = 2**31 - 1
BALL_STORED = BALL_COLUMNS
ROBOT_STORED = tuple(HEADING if name == "cos" else name for name in ROBOT_COLUMNS if name != "sin")
_COS = ROBOT_COLUMNS.index("cos")


def row_steps(n_robots: int) -> list[float]:
    """Return the steps of the stored columns of a row.

    Args:
        n_robots: number of robots.

    Returns:
        Steps of the ball's columns, then of each robot's.
    """
    return [STEPS[name] for name in (*BALL_STORED, *ROBOT_STORED * n_robots)]


def stored_rows(rows: Floats) -> Doubles:
    """Replace cosine and sine of each robot by an angle without jumps.

    Args:
        rows: (f, row) state rows.

    Returns:
        (f, stored) numbers to quantize.
    """
    robots = rows[:, len(BALL_COLUMNS) :].reshape(len(rows), -1, len(ROBOT_COLUMNS))
    angles = np.arctan2(robots[..., _COS + 1], robots[..., _COS], dtype=np.float64)
    parts = [robots[..., :_COS], np.unwrap(angles, axis=0)[..., None], robots[..., _COS + 2 :]]
    stored = np.concatenate(parts, axis=-1, dtype=np.float64)
    ball = rows[:, : len(BALL_COLUMNS)]
    return np.concatenate([ball, stored.reshape(len(rows), -1)], axis=1, dtype=np.float64)


def rows_of(stored: Doubles, n_blue: int, n_yellow: int) -> Floats:
    """Return state rows from stored columns.

    Args:
        stored: (f, stored) numbers.
        n_blue: number of blue robots.
        n_yellow: number of yellow robots.

    Returns:
        (f, row) float32.
    """
    f, n = len(stored), n_blue + n_yellow
    rows = np.empty((f, row_size(n_blue, n_yellow)), np.float32)
    rows[:, : len(BALL_COLUMNS)] = stored[:, : len(BALL_STORED)]
    source = stored[:, len(BALL_STORED) :].reshape(f, n, len(ROBOT_STORED))
    robots = rows[:, len(BALL_COLUMNS) :].reshape(f, n, len(ROBOT_COLUMNS))
    robots[..., :_COS] = source[..., :_COS]
    robots[..., _COS], robots[..., _COS + 1] = np.cos(source[..., _COS]), np.sin(source[..., _COS])
    robots[..., _COS + 2 :] = source[..., _COS + 1 :]
    return rows


def term_step(name: str, term: Floats) -> float:
    """Return the step of a reward term.

    Args:
        name: name of the term, for errors.
        term: (f, observers) weighted values.

    Returns:
        The largest magnitude by `TERM_STEPS`; 1 for a term that is 0 throughout.

    Raises:
        ReplayError: a number that is not finite, or too large.
    """
    largest = float(np.abs(term).max(initial=0.0))
    if not largest <= MAX_STEP * TERM_STEPS:  # True for NaN
        raise ReplayError(f"term {name!r}: expected finite numbers of some size, got {largest}")
    # A magnitude at the end of float32's range would leave a step of 0.
    return max(largest / TERM_STEPS, 1e-30) if largest else 1.0


def encode(name: str, values: Array, steps: float | list[float]) -> bytes:
    """Return the bytes of columns.

    Args:
        name: name of the section, for errors.
        values: (f, k) numbers.
        steps: step of each column, or one for all.

    Returns:
        4 f k bytes, not yet compressed.

    Raises:
        ReplayError: a number that is not finite, or has more than 2**31 steps.
    """
    whole = np.rint(np.asarray(values, np.float64) / steps).T
    if not (np.abs(whole) <= _MAX).all():  # False for NaN too
        raise ReplayError(f"{name}: expected finite numbers below 2**31 steps, got larger ones")
    differences = np.diff(whole.astype(np.int64), axis=1, prepend=0).astype(np.int32)
    zigzag = (differences << 1) ^ (differences >> 31)
    return np.ascontiguousarray(zigzag.astype("<i4")).view(np.uint8).reshape(-1, 4).T.tobytes()


def decode(name: str, content: bytes, frames: int, steps: list[float]) -> Doubles:
    """Return the columns of a section.

    Args:
        name: name of the section, for errors.
        content: bytes from `encode`.
        frames: number of frames, f.
        steps: step of each of the k columns.

    Returns:
        (f, k) numbers.

    Raises:
        ReplayError: bytes of another length.
    """
    if len(content) != 4 * frames * len(steps):
        raise ReplayError(f"{name}: expected {4 * frames * len(steps)} bytes, got {len(content)}")
    planes = np.frombuffer(content, np.uint8).reshape(4, -1)
    zigzag = np.ascontiguousarray(planes.T).view("<u4")[:, 0].reshape(len(steps), frames)
    differences = (zigzag >> np.uint32(1)).astype(np.int32) ^ -(zigzag & np.uint32(1)).astype(
        np.int32
    )
    whole = np.cumsum(differences, axis=1, dtype=np.int32)
    return (whole * np.array(steps, np.float64)[:, None]).T
