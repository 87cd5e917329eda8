"""Running mean and standard deviation, exact for any split of the data into batches."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Floats


class RunningMeanStd:
    """Mean and variance of each column over all batches so far, in double precision.

    Attributes:
        count: number of rows so far.
        mean: (size,) mean of each column.
        variance: (size,) variance of each column.
    """

    def __init__(self, size: int, min_std: float = 1e-2) -> None:
        """Start with mean 0 and variance 1, which the first batch replaces.

        Args:
            size: number of columns.
            min_std: smallest value of `std`, so that dividing a constant column by it is safe.
        """
        self._min_std = min_std
        self.count = 0
        self.mean = np.zeros(size)
        self.variance = np.ones(size)

    def update(self, batch: NDArray[Any]) -> None:
        """Add a batch, by the pairwise formula of Chan, Golub and LeVeque (1979).

        Args:
            batch: (k, size) rows; k may be 0.
        """
        count = len(batch)
        if count == 0:
            return
        mean, variance = batch.mean(0, dtype=np.float64), batch.var(0, dtype=np.float64)
        total = self.count + count
        delta = mean - self.mean
        squares = self.variance * self.count + variance * count
        squares += delta**2 * (self.count * count / total)
        self.mean = self.mean + delta * (count / total)
        self.variance = squares / total
        self.count = total

    @property
    def std(self) -> NDArray[np.float64]:
        """(size,) standard deviation, at least `min_std`."""
        std: NDArray[np.float64] = np.maximum(np.sqrt(self.variance), self._min_std)
        return std

    def as_float32(self) -> tuple[Floats, Floats]:
        """Return mean and standard deviation as float32 (size,), as a policy file stores them."""
        return self.mean.astype(np.float32), self.std.astype(np.float32)

    def state_dict(self) -> dict[str, NDArray[Any]]:
        """Return copies of count (1,), mean (size,) and variance (size,) by name."""
        return {
            "count": np.array([self.count]),
            "mean": self.mean.copy(),
            "variance": self.variance.copy(),
        }

    def load_state_dict(self, arrays: dict[str, NDArray[Any]]) -> None:
        """Restore the state.

        Args:
            arrays: arrays from `state_dict`.
        """
        self.count = int(arrays["count"][0])
        self.mean, self.variance = arrays["mean"].copy(), arrays["variance"].copy()
