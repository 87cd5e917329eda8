"""Initial states of matches that were not won, from which further matches begin.

A rare kind of start, such as the ball between an opponent and the own goal, is over within a second
and so is a tiny share of the samples. A share of the matches therefore begins from starts that went
wrong lately, as in prioritised level replay (Jiang et al., 2021) with the result as the priority.
"""

from __future__ import annotations

from typing import Final

import numpy as np
import torch

from rsoccer.arrays import Array, Floats, Mask

SIZE: Final = 2048
"""Initial states kept; the newest replace the oldest."""


class HardStarts:
    """Memory of initial states, and the choice of those to play again.

    Attributes:
        repeated: (n,) worlds whose match began from a kept state.
    """

    def __init__(self, worlds: int, row_size: int, share: float) -> None:
        """Begin with an empty memory.

        Args:
            worlds: number n of worlds.
            row_size: columns of a state row.
            share: share of the matches that begin from a kept state, 0 to 1.
        """
        self._share = share
        self.repeated = np.zeros(worlds, np.bool_)
        self._current = np.zeros((worlds, row_size), np.float32)
        self._kept = np.zeros((SIZE, row_size), np.float32)
        self._count = 0  # states kept so far, those that were replaced included

    def enter(self, rows: Floats) -> None:
        """Begin anew with other matches; the memory stays.

        Args:
            rows: (n, row) their initial states.
        """
        self.repeated = np.zeros(len(rows), np.bool_)
        self._current = rows.copy()

    def keep(self, worlds: Mask) -> None:
        """Keep the initial states of matches that have just not been won.

        Args:
            worlds: (n,) worlds with such matches.
        """
        rows = self._current[worlds]
        self._kept[(self._count + np.arange(len(rows))) % SIZE] = rows
        self._count += len(rows)

    def draw(self, ended: Mask, generator: torch.Generator) -> Floats:
        """Choose the worlds that begin from kept states, and set `repeated`.

        Args:
            ended: (n,) worlds in which a match begins.
            generator: draws worlds and states.

        Returns:
            (k, row) initial states of the k worlds that are among `ended` and `repeated`.
        """
        n, kept = len(ended), min(self._count, SIZE)
        chosen = (torch.rand(n, generator=generator) < self._share).numpy()
        index = torch.randint(max(kept, 1), (n,), generator=generator).numpy()
        self.repeated[ended] = chosen[ended] & (kept > 0)
        rows: Floats = self._kept[index[ended & self.repeated]]
        return rows

    def begin(self, ended: Mask, rows: Floats) -> None:
        """Remember the initial states of matches that begin.

        Args:
            ended: (n,) worlds in which they begin.
            rows: (n, row) present states of all worlds.
        """
        self._current[ended] = rows[ended]

    def state_dict(self) -> dict[str, Array]:
        """Return copies of all arrays."""
        return {
            "repeated": self.repeated.copy(),
            "current": self._current.copy(),
            "kept": self._kept[: min(self._count, SIZE)].copy(),
            "count": np.array(self._count),
        }

    def load_state_dict(self, state: dict[str, Array]) -> None:
        """Restore arrays from `state_dict`."""
        self.repeated = state["repeated"].astype(np.bool_)
        self._current = state["current"].copy()
        self._kept[: len(state["kept"])] = state["kept"]
        self._count = int(state["count"])
