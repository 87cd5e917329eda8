"""State of the referee as pictures show it: a row of numbers, and the same by name.

A recording keeps the rows of a match; a picture needs one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import GAME_COLUMNS, STATISTICS_COLUMNS
from rsoccer.game import NOBODY, Command, Stage
from rsoccer.render.shapes import Point
from rsoccer.rules.referee import RefereeRule
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from rsoccer.arrays import Doubles
    from rsoccer.play import Play
    from rsoccer.task import Task

Pair = tuple[int, int]
"""A number of blue and of yellow."""

_FROM_GAME: Final = (
    *("command", "next_command", "kick", "command_steps", "stage", "in_play"),
    *("designated_position_x", "designated_position_y"),
    *("score_blue", "score_yellow", "yellow_cards_blue", "yellow_cards_yellow"),
    *("red_cards_blue", "red_cards_yellow"),
)
_FROM_STATISTICS: Final = (
    *("in_play_steps", "possession_steps_blue", "possession_steps_yellow"),
    *("shots_blue", "shots_yellow", "distance_blue", "distance_yellow"),
)
COLUMNS: Final = (
    *_FROM_GAME,
    *_FROM_STATISTICS,
    *("passes_blue", "passes_yellow", "seconds_left", "ball_distance"),
)
"""Columns of a row; one for each robot follows, whether it may touch the ball.

Those that `play.game` has too mean the same, but `seconds_left` before a half is its duration.
`ball_distance` is the distance from the ball that robots keep in a stop and before a kick of the
opponents, m; 0 in VSSS."""
_PLACES: Final = {name: place for place, name in enumerate(COLUMNS)}
_GAME_PLACES: Final = [GAME_COLUMNS.index(name) for name in _FROM_GAME]
_STATISTICS_PLACES: Final = [STATISTICS_COLUMNS.index(name) for name in _FROM_STATISTICS]

_HALVES: Final = (Stage.NORMAL_FIRST_HALF_PRE, Stage.NORMAL_SECOND_HALF_PRE)
_EXTRA_HALVES: Final = (Stage.EXTRA_FIRST_HALF_PRE, Stage.EXTRA_SECOND_HALF_PRE)


def referee_of(task: Task) -> RefereeRule | None:
    """Return the referee of a task; None for a task without one.

    Args:
        task: the task.
    """
    return next((rule for rule in task.rules if isinstance(rule, RefereeRule)), None)


def referee_row(task: Task, play: Play, world: int = 0) -> Doubles | None:
    """Return the row of one world.

    Args:
        task: the task that is played.
        play: state of its matches.
        world: index of the world.

    Returns:
        (columns + robots,), or None for a task without a referee.
    """
    referee = referee_of(task)
    if referee is None:
        return None
    game = play.game
    passes = game["passes"][world] if "passes" in game else np.zeros(len(SIDES))
    parts = (
        game.referee[world, _GAME_PLACES],
        game.statistics[world, _STATISTICS_PLACES],
        passes,
        (_seconds_left(referee, play, world), referee.rules.ball_distance),
        game.may_touch[world],
    )
    return np.concatenate(parts, dtype=np.float64)


def _seconds_left(referee: RefereeRule, play: Play, world: int) -> float:
    """Playing time that the half has left, or all of it before it begins, s."""
    stage = play.game.stage[world]
    if stage in _HALVES:
        return float(referee.rules.half_seconds)
    if stage in _EXTRA_HALVES:
        return float(referee.rules.extra_half_seconds)
    return float(play.game.seconds_left[world])


@dataclass(frozen=True, slots=True)
class RefereeState:
    """State of the referee in one world; pairs are blue's, then yellow's.

    Attributes:
        command: command of the referee.
        next_command: command that follows; None if there is none.
        kick: command that prepared or allowed the kick to come, or was taken last; None for none.
        command_seconds: time since the command began, s.
        stage: part of the match.
        seconds_left: playing time that the half has left, s.
        in_play: whether the ball is in play.
        designated_position: place of the next kick, m.
        ball_distance: distance from the ball that robots keep, m; 0 for none.
        score: goals.
        yellow_cards: yellow cards.
        red_cards: red cards.
        may_touch: whether each robot may touch the ball.
    """

    command: Command
    next_command: Command | None
    kick: Command | None
    command_seconds: float
    stage: Stage
    seconds_left: float
    in_play: bool
    designated_position: Point
    ball_distance: float
    score: Pair
    yellow_cards: Pair
    red_cards: Pair
    may_touch: tuple[bool, ...]

    @classmethod
    def of_row(cls, row: Doubles, time_step: float) -> RefereeState:
        """Return the state in a row.

        Args:
            row: (columns + robots,) from `referee_row`.
            time_step: duration of a control step, s.
        """
        values: list[float] = row.tolist()

        def number(name: str) -> float:
            return values[_PLACES[name]]

        def pair(name: str) -> Pair:
            return round(number(f"{name}_blue")), round(number(f"{name}_yellow"))

        return cls(
            command=Command(round(number("command"))),
            next_command=_command(number("next_command")),
            kick=_command(number("kick")),
            command_seconds=number("command_steps") * time_step,
            stage=Stage(round(number("stage"))),
            seconds_left=number("seconds_left"),
            in_play=number("in_play") > 0,
            designated_position=(number("designated_position_x"), number("designated_position_y")),
            ball_distance=number("ball_distance"),
            score=pair("score"),
            yellow_cards=pair("yellow_cards"),
            red_cards=pair("red_cards"),
            may_touch=tuple(value > 0 for value in values[len(COLUMNS) :]),
        )

    @property
    def is_over(self) -> bool:
        """True after the end of the match."""
        return self.stage is Stage.POST_GAME


def referee_state(task: Task, play: Play, world: int = 0) -> RefereeState | None:
    """Return the state of the referee in one world.

    Args:
        task: the task that is played.
        play: state of its matches.
        world: index of the world.

    Returns:
        The state, or None for a task without a referee.
    """
    row = referee_row(task, play, world)
    return None if row is None else RefereeState.of_row(row, task.config.time_step)


def team_of(command: Command | None) -> int:
    """Return the team that a command is for: `BLUE`, `YELLOW` or `NOBODY`.

    Args:
        command: the command, or None.
    """
    side = "" if command is None else command.name.rpartition("_")[2].lower()
    return SIDES.index(side) if side in SIDES else NOBODY


def _command(code: float) -> Command | None:
    """A command by its number; None for -1."""
    return None if code < 0 else Command(round(code))
