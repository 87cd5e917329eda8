"""State of the referee as pictures show it, against the game that it comes from."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest

from rsoccer import Matches, make_task
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, Stage
from rsoccer.render.referee_state import (
    COLUMNS,
    RefereeState,
    referee_of,
    referee_row,
    referee_state,
    team_of,
)
from rsoccer.rules import Rule
from rsoccer.tasks.vss_match import VssMatch


def started(name: str, worlds: int = 1, **options: object) -> Matches:
    matches = Matches(make_task(name, **options), worlds, 1, controllers={"all": "ou"})
    matches.reset()
    return matches


def test_the_state_is_that_of_the_game_of_its_world() -> None:
    matches = started("SSLMatch-v0", 3, half_seconds=4.0)
    for _ in range(430):
        matches.step(np.zeros((3, 0, 6), np.float32))
    game = matches.play.game
    assert len(np.unique(game.referee, axis=0)) == 3
    assert game.command_steps.all()
    for world in range(3):
        state = referee_state(matches.task, matches.play, world)
        assert state is not None
        assert state.command == game.command[world]
        assert state.command_seconds == pytest.approx(game.command_steps[world] * 0.025)
        assert state.stage == game.stage[world]
        assert list(state.score) == game.score[world].tolist()
        assert list(state.yellow_cards) == game.yellow_cards[world].tolist()
        assert list(state.may_touch) == game.may_touch[world].tolist()
        assert state.designated_position == tuple(game.designated_position[world].tolist())
        assert state.ball_distance == 0.5


def test_statistics_are_columns_of_a_row() -> None:
    matches = started("VSSMatch-v0", half_seconds=5.0)
    for _ in range(300):
        matches.step(np.zeros((1, 0, 2), np.float32))
    row = referee_row(matches.task, matches.play)
    assert row is not None
    game = matches.play.game
    for name in ("distance", "possession_steps", "shots", "passes"):
        place = COLUMNS.index(f"{name}_blue")
        assert row[place : place + 2].tolist() == getattr(game, name)[0].tolist()
    assert row[COLUMNS.index("distance_blue")] > 0.0
    assert len(row) == len(COLUMNS) + matches.task.config.n_robots


def test_before_a_half_the_clock_has_all_of_it() -> None:
    matches = started("VSSMatch-v0", half_seconds=42.0)
    state = referee_state(matches.task, matches.play)
    assert state is not None
    assert state.stage is Stage.NORMAL_FIRST_HALF_PRE
    assert state.seconds_left == 42.0
    matches.play.game.referee[0, 3] = Stage.EXTRA_SECOND_HALF_PRE
    extra = referee_state(matches.task, matches.play)
    assert extra is not None
    assert extra.seconds_left == referee_of(matches.task).rules.extra_half_seconds  # type: ignore[union-attr]


def test_a_task_without_a_referee_has_no_state() -> None:
    matches = started("VSSSelfPlay-v0")
    assert referee_of(matches.task) is None
    assert referee_state(matches.task, matches.play) is None


@dataclass(frozen=True)
class WithoutPasses(VssMatch):
    """A match whose rules do not count passes."""

    name = "WithoutPasses-v0"

    @property
    def rules(self) -> Sequence[Rule]:
        return (self._referee,)


def test_a_referee_alone_counts_no_passes() -> None:
    matches = Matches(WithoutPasses())
    matches.reset()
    row = referee_row(matches.task, matches.play)
    assert row is not None
    assert row[COLUMNS.index("passes_blue")] == row[COLUMNS.index("passes_yellow")] == 0.0


def test_no_command_and_no_kick_are_none() -> None:
    row = np.zeros(len(COLUMNS) + 2)
    row[[COLUMNS.index("next_command"), COLUMNS.index("kick")]] = -1.0
    row[-1] = 1.0
    state = RefereeState.of_row(row, 0.025)
    assert (state.command, state.next_command, state.kick) == (Command.HALT, None, None)
    assert state.may_touch == (False, True)
    assert not state.is_over


@pytest.mark.parametrize(
    ("command", "team"),
    [
        (Command.DIRECT_FREE_BLUE, BLUE),
        (Command.BALL_PLACEMENT_YELLOW, YELLOW),
        (Command.FREE_BALL, NOBODY),
        (None, NOBODY),
    ],
)
def test_a_command_is_for_a_team_or_for_none(command: Command | None, team: int) -> None:
    assert team_of(command) == team
