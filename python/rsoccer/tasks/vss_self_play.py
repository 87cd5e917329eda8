"""`VSSSelfPlay-v0`: both teams learn."""

from dataclasses import dataclass

from rsoccer.tasks.vss import Vss


@dataclass(frozen=True)
class VssSelfPlay(Vss):
    """All robots learn; seen from its own side, the game is the same for each of them."""
