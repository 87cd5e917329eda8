"""Score and events as arrays by name."""

import copy
import pickle

import numpy as np
import pytest

from rsoccer.game import BLUE, NOBODY, YELLOW, Event, EventKind, Events, new_game
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


def test_teams_and_nobody_differ() -> None:
    assert len({BLUE, YELLOW, NOBODY}) == 3
    assert (BLUE, YELLOW) == (0, 1), "they are indices of scores"
