"""The definition of a pass: released by a robot, free for a stated way, received by a teammate.

All tasks and statistics count passes by this rule. A ball that a robot carries to its teammate, or
hands over between robots that stand side by side, is no pass.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer.arrays import Array, Floats, Mask
from rsoccer.game import NOBODY, EventKind
from rsoccer.play import Play
from rsoccer.rules.base import Restart, Rule
from rsoccer.rules.touches import team_of

REACH: Final = np.float32(0.25)
"""Distance from a robot's center within which the ball is still with it, m."""
STOPPED_SPEED: Final = np.float32(0.1)
"""Speed of the ball below which it counts as stopped, m/s."""


class Passes(Rule):
    """Passes between teammates: events and counts; play goes on.

    A pass is released where the ball leaves the `REACH` of the robot that touched it last. It
    arrives when the ball then breaks the beam of a teammate, at least `min_length` away from there,
    and nobody has touched it on its way. A ball that stops begins anew. A ball that a restart has
    placed, or that is in two mouths at once, arrives from nobody.
    """

    def __init__(self, min_length: float) -> None:
        """Prepare the rule.

        Args:
            min_length: least distance between release and reception, m.
        """
        self.min_length = np.float32(min_length)

    def columns(self, n: int) -> dict[str, Array]:
        """Create the state of passes.

        Args:
            n: number of worlds.

        Returns:
            `touched_by` (n,), index of the robot that touched the ball last, or `NOBODY`;
            `released_at` (n, 2), where the ball was last with that robot, or stopped, m; `passes`
            (n, 2), passes of blue and of yellow that arrived in the episode.
        """
        return {
            "touched_by": np.full(n, NOBODY, np.int64),
            "released_at": np.zeros((n, 2), np.float32),
            "passes": np.zeros((n, 2), np.int64),
        }

    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        """Forget who touched the ball."""
        play.game.touched_by[worlds] = NOBODY
        play.game.released_at[worlds] = play.frame.ball.position[worlds]

    def judge(self, play: Play) -> Restart | None:
        """Count the passes that arrived, and follow the ball."""
        game, frame = play.game, play.frame
        begins = self._with_robot_or_stopped(play)
        worlds, receiver = self._caught(play)
        if len(worlds):
            # The beam breaks some millimeters before the ball touches: a pass has arrived, and
            # another one begins, while the passer is still the last that touched it.
            begins[worlds[self._count(play, worlds, receiver)]] = True
        game.released_at[begins] = frame.ball.position[begins]
        game.touched_by[:] = frame.ball.last_touch
        return None

    def _caught(self, play: Play) -> tuple[Array, Array]:
        """Worlds (k,) in which a robot alone caught a ball from another one, and that robot."""
        frame, game = play.frame, play.game
        in_mouth = frame.robots.infrared > 0.5
        worlds, receiver = np.nonzero(in_mouth)
        passer = game.touched_by[worlds]
        caught = (passer != receiver) & (passer != NOBODY)
        way = frame.ball.position[worlds] - game.released_at[worlds]
        caught &= _squared(way) >= self.min_length**2
        worlds, receiver = worlds[caught], receiver[caught]
        if len(worlds):
            alone = np.count_nonzero(in_mouth[worlds], axis=1) == 1
            worlds, receiver = worlds[alone], receiver[alone]
        return worlds, receiver

    def _count(self, play: Play, worlds: Array, receiver: Array) -> Mask:
        """Count what was caught; (k,) whether the next pass begins there."""
        n_blue = play.frame.n_blue
        arrived: Mask = (play.game.touched_by[worlds] < n_blue) == (receiver < n_blue)
        worlds, receiver = worlds[arrived], receiver[arrived]
        if len(worlds):
            team, position = team_of(play.frame, receiver), play.frame.ball.position[worlds]
            play.game.passes[worlds, team] += 1
            play.events.add(worlds, EventKind.PASS, team, receiver, position)
        return arrived

    def _with_robot_or_stopped(self, play: Play) -> Mask:
        """(n,) whether the ball is with the robot that touched it last, or stopped."""
        ball = play.frame.ball
        last = ball.last_touch.astype(np.int64)  # `NOBODY` reads the last robot: no robot passed
        robots = play.frame.robots.position[np.arange(len(last)), last]
        begins: Mask = last != play.game.touched_by
        begins |= _squared(ball.position - robots) < REACH * REACH
        begins |= _squared(ball.velocity) < STOPPED_SPEED * STOPPED_SPEED
        return begins


class PassesInPlay(Passes):
    """Passes of matches under a referee: none arrives while play is stopped.

    A ball that arrives in the step that stops play has been a pass.
    """

    def judge(self, play: Play) -> Restart | None:
        """Count the passes that arrived in play, and follow the ball."""
        game = play.game
        stopped = (game.in_play == 0.0) & (game.command_steps > 0.0)
        game.touched_by[stopped] = NOBODY
        return super().judge(play)


def _squared(vectors: Floats) -> Floats:
    """(n,) squared lengths of vectors (n, 2)."""
    x, y = vectors[:, 0], vectors[:, 1]
    squared: Floats = x * x + y * y
    return squared
