"""Score and events as arrays by name."""

import copy
import pickle

import numpy as np
import pytest

from rsoccer._core import (
    COMMANDS,
    EVENT_KINDS,
    GAME_COLUMNS,
    MAX_EVENTS,
    OFFENSES,
    STAGES,
    STATISTICS_COLUMNS,
    Referee,
)
from rsoccer.game import (
    BLUE,
    NOBODY,
    YELLOW,
    Command,
    Event,
    EventKind,
    Events,
    Game,
    Stage,
    new_game,
)
from tests.helpers import same


def some_events() -> Events:
    events = Events.empty(4)
    events.add(np.array([1, 3]), EventKind.GOAL, np.array([BLUE, YELLOW]), 2)
    position = np.array([[0.5, -0.25]], np.float32)
    events.add(np.array([3]), EventKind.PASS, YELLOW, 5, position)
    return events


def test_events_are_read_by_world_kind_and_team() -> None:
    events = some_events()
    assert events.count.tolist() == [0, 1, 0, 2]
    assert events.of_world(0) == []
    assert events.of_world(3) == [
        Event(EventKind.GOAL, YELLOW, 2, (0.0, 0.0)),
        Event(EventKind.PASS, YELLOW, 5, (0.5, -0.25)),
    ]
    assert events.happened(EventKind.GOAL).tolist() == [False, True, False, True]
    assert events.happened(EventKind.PASS).tolist() == [False, False, False, True]
    assert not events.happened(EventKind.NO_PROGRESS_IN_GAME).any()
    assert events.by_team(EventKind.GOAL).tolist() == [[0, 0], [1, 0], [0, 0], [0, 1]]


def test_events_of_some_worlds_can_be_forgotten() -> None:
    events = some_events()
    events.forget(np.array([1]))
    assert events.count.tolist() == [0, 0, 0, 2]
    assert events.happened(EventKind.GOAL).tolist() == [False, False, False, True]
    events.forget()
    assert not events.count.any()
    assert not events.happened(EventKind.GOAL).any()
    assert not events.by_team(EventKind.GOAL).any()
    events.add(np.array([3]), EventKind.PASS, BLUE, 0)
    assert [event.kind for event in events.of_world(3)] == [EventKind.PASS]


def test_empty_slots_are_of_no_kind_and_of_nobody() -> None:
    events = Events.empty(2)
    assert (events.kind == EventKind.NONE).all() and not events.position.any()
    assert (events.team == NOBODY).all() and (events.robot == NOBODY).all()
    types = {name: array.dtype.name for name, array in events.items()}
    assert types == {
        "count": "int64",
        "kind": "int16",
        "team": "int8",
        "robot": "int16",
        "position": "float32",
    }


def test_more_events_than_slots_are_refused() -> None:
    events = Events.empty(2)
    for _ in range(Events.SLOTS):
        events.add(np.array([1]), EventKind.PASS)
    before = {name: array.copy() for name, array in events.items()}
    with pytest.raises(RuntimeError, match=f"at most {Events.SLOTS} in a step"):
        events.add(np.array([0, 1]), EventKind.PASS)
    assert all(same(array, before[name]) for name, array in events.items())


def test_columns_are_attributes() -> None:
    game = new_game(3, {"turns": np.arange(3)})
    assert game.score.tolist() == [[0, 0]] * 3
    game.turns[1] = 7
    assert game["turns"].tolist() == [0, 7, 2]
    assert list(game) == ["score", "turns"]
    with pytest.raises(AttributeError, match=r"Game has no 'cards'; it has \['score', 'turns'\]"):
        game.cards  # noqa: B018


def test_worlds_are_taken_and_put() -> None:
    game = new_game(3, {"turns": np.arange(3)})
    part = game.take(np.array([2, 0]))
    assert type(part) is type(game)
    part.turns[:] = [5, 6]
    assert game.turns.tolist() == [0, 1, 2], "a copy"
    game.put(np.array([2, 0]), part)
    assert game.turns.tolist() == [6, 1, 5]


@pytest.mark.parametrize("copied", [copy.deepcopy, lambda game: pickle.loads(pickle.dumps(game))])
def test_copies_share_no_memory(copied: object) -> None:
    assert callable(copied)
    game = new_game(2, {"turns": np.zeros(2)})
    other = copied(game)
    other.turns[:] = 1
    assert game.turns.tolist() == [0, 0]


def test_read_only_arrays_show_later_writes_and_take_none() -> None:
    game = Game({"score": np.zeros((2, 2), np.int64)})
    shown = game.read_only
    assert game.read_only is shown
    assert list(shown) == list(game)
    game.score[0, 1] = 3
    assert shown.score[0, 1] == 3
    with pytest.raises(ValueError, match="read-only"):
        shown.score[:] = 1
    copied = copy.deepcopy(game)
    copied.score[:] = 7
    assert (copied.read_only.score == 7).all()
    game.score = np.ones((2, 2), np.int64)
    assert (game.read_only.score == 1).all()


def test_teams_and_nobody_differ() -> None:
    assert len({BLUE, YELLOW, NOBODY}) == 3
    assert (BLUE, YELLOW) == (0, 1), "they are indices of scores"


def test_several_events_of_a_world_are_added_in_order() -> None:
    events = Events.empty(3)
    events.add(np.array([2]), EventKind.PASS, BLUE, 1)
    rows = [
        [0, EventKind.BOT_CRASH_UNIQUE, BLUE, 2, 0.5, -1.0],
        [0, EventKind.MULTIPLE_FOULS, BLUE, NOBODY, 0.0, 0.0],
        [2, EventKind.GOAL, YELLOW, 4, -4.5, 0.25],
        [2, EventKind.BOT_CRASH_DRAWN, NOBODY, 0, 0.0, 0.0],
        [2, EventKind.GOAL, BLUE, 1, 4.5, 0.0],
    ]
    events.extend(np.array(rows, np.float32))
    assert events.count.tolist() == [2, 0, 4]
    assert events.of_world(0) == [
        Event(EventKind.BOT_CRASH_UNIQUE, BLUE, 2, (0.5, -1.0)),
        Event(EventKind.MULTIPLE_FOULS, BLUE, NOBODY, (0.0, 0.0)),
    ]
    assert [event.kind for event in events.of_world(2)] == [
        EventKind.PASS,
        EventKind.GOAL,
        EventKind.BOT_CRASH_DRAWN,
        EventKind.GOAL,
    ]
    assert events.by_team(EventKind.GOAL).tolist() == [[0, 0], [0, 0], [1, 1]]


def test_more_rows_of_events_than_slots_are_refused() -> None:
    events = Events.empty(2)
    row = [1, EventKind.BOT_CRASH_DRAWN, NOBODY, NOBODY, 0.0, 0.0]
    events.extend(np.array([row] * Events.SLOTS, np.float32))
    assert events.count.tolist() == [0, Events.SLOTS]
    with pytest.raises(RuntimeError, match=f"events: expected at most {Events.SLOTS} in a step"):
        events.extend(np.array([row], np.float32))


def test_columns_of_the_referee_are_attributes() -> None:
    game = new_game(
        3,
        {
            "referee": np.stack([Referee.new_game(team) for team in (0, 1, 1)]),
            "statistics": np.zeros((3, len(STATISTICS_COLUMNS)), np.float32),
        },
    )
    game.referee[2, GAME_COLUMNS.index("yellow_cards_yellow")] = 2.0
    game.referee[1, GAME_COLUMNS.index("designated_position_y")] = -0.5
    assert game.yellow_cards.tolist() == [[0, 0], [0, 0], [0, 2]]
    assert game.yellow_cards_yellow.tolist() == [0, 0, 2]
    assert game.designated_position.tolist() == [[0, 0], [0, -0.5], [0, 0]]
    assert game.yellow_steps_left.shape == (3, 4)
    assert game.push_start.shape == (3, 4)
    assert game.shots.shape == game.possession_steps.shape == (3, 2)
    assert game.offenses.shape == (3, 2 * len(OFFENSES))
    assert game.first_kickoff.tolist() == [0, 1, 1]
    assert (
        game.command.tolist()
        == [Command.PREPARE_KICKOFF_BLUE] + [Command.PREPARE_KICKOFF_YELLOW] * 2
    )
    assert game.command.dtype == np.int64
    assert (game.next_command == Command.NORMAL_START).all()
    assert (game.stage == Stage.NORMAL_FIRST_HALF_PRE).all()
    game.yellow_cards[0, 0] = 1.0  # a view
    assert game.yellow_cards_blue.tolist() == [1, 0, 0]


def test_without_a_referee_its_columns_do_not_exist() -> None:
    game = new_game(2, {})
    for name in ("yellow_cards", "shots", "cards"):
        with pytest.raises(AttributeError, match=f"Game has no '{name}'"):
            getattr(game, name)


def test_numbers_are_those_of_the_core() -> None:
    assert {command.name: command.value for command in Command} == COMMANDS
    assert {stage.name: stage.value for stage in Stage} == STAGES
    own = {EventKind.NONE, EventKind.PASS}  # not decided by the referee
    kinds = {kind.name: kind.value for kind in EventKind if kind not in own}
    assert kinds == EVENT_KINDS
    assert set(OFFENSES) < set(kinds.values())
    assert len(set(OFFENSES)) == len(OFFENSES)
    assert Events.SLOTS == MAX_EVENTS
