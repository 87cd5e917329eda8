"""Last touches of the ball, as indices of robots and teams."""

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, YELLOW


def last_touch(frame: Frame, worlds: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the robots that touched the ball last.

    Args:
        frame: state of n worlds.
        worlds: (k,) indices of worlds.

    Returns:
        (k,) indices of robots in the order of a state row, or `NOBODY`.
    """
    return frame.ball.last_touch[worlds].astype(np.intp)


def team_of(frame: Frame, robots: NDArray[np.intp]) -> NDArray[np.intp]:
    """Return the teams of robots.

    Args:
        frame: state of n worlds, for the number of blue robots.
        robots: (k,) indices of robots, or `NOBODY`.

    Returns:
        (k,) `BLUE` or `YELLOW`; `NOBODY` for nobody.
    """
    team = np.where(robots < frame.n_blue, BLUE, YELLOW)
    return np.where(robots == NOBODY, NOBODY, team).astype(np.intp)
