"""The step loop: many matches of one task at once, as arrays."""

from rsoccer.matches.loop import AUTORESETS, Matches
from rsoccer.matches.outcome import Episodes, Outcome

__all__ = ["AUTORESETS", "Episodes", "Matches", "Outcome"]
