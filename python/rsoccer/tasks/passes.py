"""Passes in SSL matches: from a robot to the mouth of a teammate."""

from typing import Final

import numpy as np

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.play import Play
from rsoccer.tasks.ssl_pass import STOPPED_SPEED

MIN_LENGTH: Final = np.float32(0.5)
"""Least distance that the ball moves by itself, m: more than two robots side by side."""
REACH: Final = np.float32(0.25)
"""Distance from a robot's centre within which the ball is still with it, m."""
NOBODY: Final = -1
"""Index of the last robot at the ball before the first touch."""


def new_memory(n: int) -> dict[str, Array]:
    """Return memory at the start of episodes.

    Args:
        n: number of worlds.

    Returns:
        `touched_by` (n,), index of the robot that touched the ball last, or `NOBODY`; `left_at`
        (n, 2), where the ball was last with that robot, or stopped, m; `passes` (n, 2), passes of
        blue and of yellow.
    """
    return {
        "touched_by": np.full(n, NOBODY, np.int64),
        "left_at": np.zeros((n, 2), np.float32),
        "passes": np.zeros((n, 2), np.int64),
    }


def count(play: Play) -> Mask:
    """Count the passes that arrived in the last step.

    A pass arrives when the ball breaks the beam of a robot, a teammate touched it last before, and
    it has moved by at least `MIN_LENGTH` since it was with that teammate. A ball that stopped
    (slower than 0.1 m/s) begins anew. A ball that was placed, or in two mouths at once, arrives
    from nobody.

    Args:
        play: state of n worlds after the step; its memory is changed.

    Returns:
        (n, 2) whether a pass of blue, and of yellow, arrived.
    """
    passes = _arrived(play)
    memory = play.memory
    memory["passes"] += passes
    # The beam breaks some millimetres before the ball touches: a pass has arrived, and another one
    # begins, while the sender is still the last that touched it.
    begins = _begins(play) | passes.any(axis=1)
    memory["left_at"][begins] = play.frame.ball.position[begins]
    memory["touched_by"][:] = play.frame.ball.last_touch
    return passes


def _arrived(play: Play) -> Mask:
    """(n, 2) whether a pass of blue, and of yellow, arrived."""
    frame, memory = play.frame, play.memory
    in_mouth = frame.robots.infrared > 0.5
    if not np.count_nonzero(in_mouth):  # in most steps, as long as there are few worlds
        return np.zeros((len(frame), 2), np.bool_)
    receiver, sender = np.argmax(in_mouth, axis=1), memory["touched_by"]
    by_blue = receiver < frame.n_blue
    teammates = ((sender < frame.n_blue) == by_blue) & (sender != receiver) & (sender != NOBODY)
    flown = _squared(frame.ball.position - memory["left_at"]) >= MIN_LENGTH * MIN_LENGTH
    arrived = (in_mouth.sum(axis=1) == 1) & teammates & flown
    passes: Mask = np.stack([arrived & by_blue, arrived & ~by_blue], axis=1)
    return passes


def _begins(play: Play) -> Mask:
    """(n,) whether the ball is with the robot that touched it last, or stopped."""
    ball = play.frame.ball
    last = ball.last_touch.astype(np.int64)  # -1 reads the last robot, and changes nothing
    robots = play.frame.robots.position[np.arange(len(last)), last]
    begins: Mask = last != play.memory["touched_by"]
    begins |= _squared(ball.position - robots) < REACH * REACH
    begins |= _squared(ball.velocity) < STOPPED_SPEED * STOPPED_SPEED
    return begins


def _squared(vectors: Floats) -> Floats:
    """(n,) squared lengths of vectors (n, 2)."""
    squared: Floats = (vectors * vectors).sum(axis=1)
    return squared
