"""The state of a training run that its callback gets, and the callback."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

from rsoccer.policies.network import Network
from rsoccer.train.args import Args


@dataclass(frozen=True)
class Update:
    """State of a run after an update, for a `Callback`. It can be read at any time of the call."""

    args: Args
    """settings of the run"""
    row: Mapping[str, float]
    """columns of the log by name, such as `samples` and `episode_goal_score`; NaN where there is no
    value"""
    network: Callable[[], Network]
    """returns a copy of the current policy"""

    @property
    def samples(self) -> int:
        """Decisions that were learned from so far."""
        return int(self.row["samples"])

    @property
    def number(self) -> int:
        """Number of updates so far."""
        return int(self.row["update"])

    @property
    def out(self) -> Path:
        """Folder of the run."""
        return self.args.out


Callback = Callable[[Update], bool | None]
"""Function that is called after each update. False ends the run, which is saved as at its end."""
