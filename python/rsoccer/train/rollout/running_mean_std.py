"""Running mean and standard deviation, exact for any split of the data into batches."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Doubles, Floats
from rsoccer.reflection import Reflection


class RunningMeanStd:
    """Mean and variance of each column over all batches so far, in double precision.

    With a reflection the statistics are those of the rows and of the reflected rows, so that
    normalized rows can be reflected.

    Attributes:
        count: number of rows so far.
        mean: (size,) mean of each column, without reflected rows.
        variance: (size,) variance of each column, without reflected rows.
    """

    def __init__(
        self, size: int, min_std: float = 1e-2, reflection: Reflection | None = None
    ) -> None:
        """Start with mean 0 and variance 1, which the first batch replaces.

        Args:
            size: number of columns.
            min_std: smallest value of `std`, so that dividing a constant column by it is safe.
            reflection: reflection of a row; None for none.
        """
        self._min_std, self._reflection = min_std, reflection
        self.count = 0
        self.mean = np.zeros(size)
        self.variance = np.ones(size)

    def update(self, batch: NDArray[Any]) -> None:
        """Add a batch, by the pairwise formula of Chan, Golub and LeVeque (1979).

        Args:
            batch: (k, size) rows; k may be 0.
        """
        if len(batch):
            self.add(len(batch), *moments(batch))

    def add(self, count: int, mean: Doubles, variance: Doubles) -> None:
        """Add a batch of which the moments are known.

        Args:
            count: number of its rows, at least 1.
            mean: (size,) mean of its rows.
            variance: (size,) variance of its rows.
        """
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
        variance = self.variance
        if self._reflection is not None:
            # Half of the rows deviate by `offset` from the mean of all, the others by -`offset`.
            offset = 0.5 * (self.mean - self._reflected(self.mean))
            variance = 0.5 * (variance + variance[self._reflection.order]) + offset**2
        std: NDArray[np.float64] = np.maximum(np.sqrt(variance), self._min_std)
        return std

    def _reflected(self, row: NDArray[np.float64]) -> NDArray[np.float64]:
        """Reflected row (size,); the row itself without a reflection."""
        if self._reflection is None:
            return row
        reflected: NDArray[np.float64] = row[self._reflection.order] * self._reflection.signs
        return reflected

    def as_float32(self) -> tuple[Floats, Floats]:
        """Return mean and standard deviation as float32 (size,), as a policy file stores them."""
        mean = 0.5 * (self.mean + self._reflected(self.mean))
        return mean.astype(np.float32), self.std.astype(np.float32)

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


def moments(batch: NDArray[Any]) -> tuple[Doubles, Doubles]:
    """Return mean and variance of the columns of a batch, (size,) each, in double precision.

    Args:
        batch: (k, size) rows, at least one.
    """
    return batch.mean(0, dtype=np.float64), batch.var(0, dtype=np.float64)
