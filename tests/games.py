"""Matches under a referee, put into a state of play, for tests of several areas."""

import numpy as np

from rsoccer._core import GAME_COLUMNS, Referee
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, Stage
from rsoccer.matches import Matches


def set_game(matches: Matches, **values: float) -> None:
    """Give columns of the referee's state a value in all worlds."""
    for name, value in values.items():
        matches.play.game.referee[:, GAME_COLUMNS.index(name)] = value


def begin_play(matches: Matches) -> None:
    """Let both teams play the ball, in the first half, where there is a referee."""
    if "referee" in matches.play.game:
        set_game(
            matches,
            command=Command.FORCE_START,
            next_command=NOBODY,
            stage=Stage.NORMAL_FIRST_HALF,
            stage_steps_left=10_000,
            in_play=True,
        )


def exchange_kickoffs(matches: Matches) -> None:
    """Give the first kick-off to the other team, in matches that have just begun."""
    new = np.stack([Referee.new_game(team) for team in (BLUE, YELLOW)])
    game = matches.play.game
    others = 1 - game.first_kickoff.astype(np.intp)
    of_team = new[BLUE] != new[YELLOW]
    game.referee[:, of_team] = new[others][:, of_team]
