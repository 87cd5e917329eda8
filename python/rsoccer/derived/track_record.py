"""The poses of some frames before the last one, and the mean velocities since."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats
from rsoccer.derived.motion import differentiate
from rsoccer.frame import Frame

FRAMES: Final = 2
"""Number of frames that are kept before the last one. With steps of 25 ms, velocities over 50 ms
have a third of the noise of those over a camera's 15 ms, and lag 25 ms behind."""


class TrackRecord:
    """Poses of n worlds, two frames back.

    A tracker that takes a robot to be pushed tells velocities of one or two detections, with as
    much noise. Mean velocities over several frames have little.
    """

    def __init__(self, frame: Frame) -> None:
        """Begin without a past.

        Args:
            frame: a frame of n worlds; copied.
        """
        self._past = [frame.copy() for _ in range(FRAMES)]
        self._ages = np.zeros((FRAMES, len(frame)), np.float32)

    def begin(self, worlds: NDArray[np.intp], frame: Frame) -> None:
        """Forget the past of some worlds.

        Args:
            worlds: (k,) indices of worlds.
            frame: (k, row) their present frame.
        """
        for past in self._past:
            past.put(worlds, frame)
        self._ages[:, worlds] = 0.0

    def add(self, worlds: NDArray[np.intp], last: Frame, seconds: Floats) -> None:
        """Let the last frame of some worlds become one of the past.

        Args:
            worlds: (k,) indices of worlds.
            last: (k, row) their last frame.
            seconds: (k,) time until the present one, s; nothing is added where it is 0.
        """
        new = seconds > 0.0
        worlds, last, seconds = worlds[new], last.take(np.flatnonzero(new)), seconds[new]
        for nth in reversed(range(1, FRAMES)):
            self._past[nth].put(worlds, self._past[nth - 1].take(worlds))
            self._ages[nth, worlds] = self._ages[nth - 1, worlds] + seconds
        self._past[0].put(worlds, last)
        self._ages[0, worlds] = seconds

    def mean_motion(self, worlds: NDArray[np.intp], last: Frame) -> Frame:
        """Return the last frame of some worlds with mean velocities of the recent past.

        Args:
            worlds: (k,) indices of worlds.
            last: (k, row) their last frame.

        Returns:
            A copy, with the velocities of `last` where there is no past.
        """
        age, frame = self._ages[-1, worlds], last.copy()
        known = age > 0.0
        differentiate(self._past[-1].take(worlds), frame, np.where(known, age, np.float32(1.0)))
        frame.rows[~known] = last.rows[~known]
        return frame
