"""A rollout as an update learns from it, with its columns of the log."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Self

import torch

from rsoccer.train.ppo.batch import Batch
from rsoccer.train.prefixes import Arrays
from rsoccer.train.rollout.episode_stats import Row


@dataclass(frozen=True)
class Played:
    """A rollout to learn from. It is part of a checkpoint, as its matches have gone on."""

    batch: Batch
    """the samples, with reflected ones if the settings ask for them"""
    samples: int
    """decisions of the rollout; the batch has more of them with reflected ones"""
    episodes: Row
    """columns of the log about the episodes that ended in it"""
    rewards: Row
    """columns of the log with its mean rewards"""

    def arrays(self) -> Arrays:
        """Return the arrays of the samples by name, without copying."""
        return {name: part.numpy() for name, part in self.batch.parts().items()}

    def info(self) -> dict[str, Any]:
        """Return all else as JSON values by name."""
        return {"samples": self.samples, "episodes": self.episodes, "rewards": self.rewards}

    @classmethod
    def restored(cls, arrays: Arrays, info: Mapping[str, Any]) -> Self:
        """Return the rollout of a checkpoint.

        Args:
            arrays: arrays from `arrays`.
            info: values from `info`.
        """
        return cls(Batch(**{name: torch.tensor(part) for name, part in arrays.items()}), **info)
