"""Running mean and variance of what a run has seen, exact for any split into batches."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer.frame import Floats


class RunningMeanStd:
    """Mean and variance over everything seen, per column, in double precision."""

    def __init__(self, size: int, smallest_std: float = 1e-2) -> None:
        """Start at mean 0 and variance 1, which the first batch replaces."""
        self._smallest = smallest_std
        self.count = 0
        self.mean = np.zeros(size)
        self.variance = np.ones(size)

    def update(self, batch: NDArray[Any]) -> None:
        """Take in a batch (k, size), by the pairwise formula of Chan, Golub and LeVeque (1979)."""
        count = len(batch)
        if count == 0:
            return
        mean, variance = batch.mean(0, dtype=np.float64), batch.var(0, dtype=np.float64)
        total = self.count + count
        offset = mean - self.mean
        squares = self.variance * self.count + variance * count
        squares += offset**2 * (self.count * count / total)
        self.mean = self.mean + offset * (count / total)
        self.variance = squares / total
        self.count = total

    @property
    def std(self) -> NDArray[np.float64]:
        """Standard deviation (size,), never so small that a constant column explodes."""
        deviation: NDArray[np.float64] = np.maximum(np.sqrt(self.variance), self._smallest)
        return deviation

    def as_floats(self) -> tuple[Floats, Floats]:
        """Mean and standard deviation as float32 (size,), as a policy file keeps them."""
        return self.mean.astype(np.float32), self.std.astype(np.float32)

    def state_dict(self) -> dict[str, NDArray[Any]]:
        """Arrays that `load_state_dict` continues from."""
        return {
            "count": np.array([self.count]),
            "mean": self.mean.copy(),
            "variance": self.variance.copy(),
        }

    def load_state_dict(self, arrays: dict[str, NDArray[Any]]) -> None:
        """Continue from what `state_dict` gave."""
        self.count = int(arrays["count"][0])
        self.mean, self.variance = arrays["mean"].copy(), arrays["variance"].copy()
