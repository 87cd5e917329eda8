"""Possession of the ball: passes, balls that the other team intercepts, time with the ball."""

import numpy as np

from rsoccer.arrays import Array, Mask
from rsoccer.game import NOBODY
from rsoccer.play import Play
from rsoccer.rules.base import Restart
from rsoccer.rules.passes import Passes
from rsoccer.rules.touches import team_of


class Possession(Passes):
    """Passes as `Passes` defines them, interceptions, and the time with the ball of each team.

    An interception is what would be a pass if the robot that catches the ball were a teammate of
    the one that released it. A shot that a robot catches is one, too; a ball that is taken out of
    another robot's mouth is none. A team has the ball from its touch to the other team's next one.
    """

    def columns(self, n: int) -> dict[str, Array]:
        """Create the state of possession.

        Args:
            n: number of worlds.

        Returns:
            Those of `Passes`; `interceptions` (n, 2), balls of the other team that blue and yellow
            caught; `possession_steps` (n, 2), control steps with the ball of blue and of yellow.
        """
        return {
            **super().columns(n),
            "interceptions": np.zeros((n, 2), np.int64),
            "possession_steps": np.zeros((n, 2), np.int64),
        }

    def judge(self, play: Play) -> Restart | None:
        """Count passes, interceptions and steps with the ball, and follow the ball."""
        super().judge(play)
        worlds = np.flatnonzero(play.game.touched_by != NOBODY)
        play.game.possession_steps[worlds, team_of(play.frame, play.game.touched_by[worlds])] += 1
        return None

    def _count(self, play: Play, worlds: Array, receiver: Array) -> Mask:
        arrived = super()._count(play, worlds, receiver)
        intercepted = ~arrived
        team = team_of(play.frame, receiver[intercepted])
        play.game.interceptions[worlds[intercepted], team] += 1
        return np.ones(len(worlds), np.bool_)
