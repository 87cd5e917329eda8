"""Rules that a task has: judges of the state after each step, and the restarts of play.

    >>> from rsoccer.rules import Crossings, Passes
    >>> rules = (Crossings(), Passes(min_length=0.5))

A task returns its rules from `Task.rules`. `Matches` calls them after the physics and before the
rewards. They write the score, their own columns of `play.game`, and `play.events`; a `Restart`
takes effect after the rewards.
"""

from rsoccer.rules.ball_out import BallOut
from rsoccer.rules.base import Restart, Rule
from rsoccer.rules.crossings import Crossings
from rsoccer.rules.free_ball import FreeBalls
from rsoccer.rules.passes import Passes, PassesInPlay
from rsoccer.rules.possession import Possession

__all__ = ["BallOut", "Crossings", "FreeBalls", "Passes", "PassesInPlay", "Possession"]
__all__ += ["Restart", "Rule"]
