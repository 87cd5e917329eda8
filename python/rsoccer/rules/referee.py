"""The referee of whole matches as a rule of a task."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from rsoccer import _core
from rsoccer._core import SimConfig
from rsoccer.arrays import Array
from rsoccer.game import BLUE, YELLOW, Game
from rsoccer.play import Play
from rsoccer.rules.base import Restart, Rule
from rsoccer.rules.referee_config import RefereeConfig

PLACEMENT_SEEDS: Final = 1 << 24
"""Number of seeds from which the errors of places are drawn, in the line-up and in restarts."""
_PLACEMENTS: Final = _core.GAME_COLUMNS.index("placements")
_STATISTICS: Final = len(_core.STATISTICS_COLUMNS)
_NEW_GAMES: Final = np.stack([_core.Referee.new_game(team) for team in (BLUE, YELLOW)])
"""(2, game) matches whose first kick-off blue or yellow has."""


class RefereeRule(Rule):
    """The referee of whole matches: commands, stages, clock, score, cards, restarts.

    The rules themselves are in the core. The state of a match is the row `play.game.referee`, whose
    columns are attributes of `play.game` too.
    """

    def __init__(self, config: SimConfig, rules: RefereeConfig) -> None:
        """Prepare the referee.

        Args:
            config: field, ball and robots.
            rules: numbers and switches of the rules.

        Raises:
            ValueError: a choice or a number that the rules do not have.
        """
        self.rules = rules
        self.core = _core.Referee(config, rules.to_json())
        self._robots = config.n_blue + config.n_yellow

    def columns(self, n: int) -> dict[str, Array]:
        """Create the state of matches.

        Args:
            n: number of worlds.

        Returns:
            `referee` (n, game), state of each match; `statistics` (n, statistics); `seconds_left`
            (n,), playing time that the stage has left, s; `may_touch` (n, robots), whether the
            robot may touch the ball.
        """
        return {
            "referee": np.repeat(_NEW_GAMES[:1], n, axis=0),
            "statistics": np.zeros((n, _STATISTICS), np.float32),
            "seconds_left": np.zeros(n, np.float32),
            "may_touch": np.zeros((n, self._robots), np.bool_),
        }

    def begin(self, play: Play, worlds: NDArray[np.intp]) -> None:
        """Draw what chance decides in new matches, and fit others to a restart."""
        game = play.game
        new = worlds[play.steps[worlds] == 0]
        if len(new):
            kickoffs = (play.rng.uniform(0.0, 2.0) >= 1.0).astype(np.intp)
            game.referee[new] = _NEW_GAMES[kickoffs[new]]
            seeds = play.rng.integers(PLACEMENT_SEEDS)
            game.referee[new, _PLACEMENTS] = seeds[new]
        some = game.take(worlds)
        self.core.begin(play.frame.rows[worlds], _arrays(some))
        game.put(worlds, some)

    def judge(self, play: Play) -> Restart | None:
        """Judge the step of each match."""
        game, rows = play.game, play.frame.rows
        restart = np.empty_like(rows)
        restarts, events = self.core.judge(
            play.last_frame.rows, rows, _arrays(game), restart, play.threads
        )
        if events is not None:
            play.events.extend(events)
        if restarts is None:
            return None
        worlds = np.flatnonzero(restarts)
        return Restart(worlds, rows=restart[worlds])


def _arrays(game: Game) -> tuple[Array, ...]:
    """The arrays that the core changes."""
    return game.referee, game.statistics, game.score, game.seconds_left, game.may_touch
