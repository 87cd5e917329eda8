"""The referee as a rule, and its binding: arguments that it refuses, threads, drawn kick-offs."""

import pickle
from typing import Any

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer._core import (
    GAME_COLUMNS,
    GAME_FEATURES,
    STATISTICS_COLUMNS,
    Referee,
    SimConfig,
    Threads,
    referee_preset,
)
from rsoccer.arrays import Array, Floats
from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, EventKind
from rsoccer.rng import WorldRng
from rsoccer.tasks import SslMatch, VssMatch
from rsoccer.testing.pressure import Pressing
from tests.games import begin_play, set_game
from tests.helpers import same, zeros

CONFIG = SimConfig("ssl_b", 2, 1)
REFEREE = Referee(CONFIG, referee_preset("ssl_2026_b"))


def line_up(worlds: int) -> Floats:
    rows = Frame.empty(worlds, 2, 1).rows
    REFEREE.line_up(rows, [0] * worlds)
    return rows


def new_matches(worlds: int) -> list[Array]:
    """State, statistics, score, time left, and robots that may touch the ball."""
    return [
        np.stack([Referee.new_game(i % 2) for i in range(worlds)]),
        np.zeros((worlds, len(STATISTICS_COLUMNS)), np.float32),
        np.zeros((worlds, 2), np.int64),
        np.zeros(worlds, np.float32),
        np.zeros((worlds, 3), np.bool_),
    ]


def test_a_new_match_has_a_kickoff() -> None:
    for team, command in ((0, "PREPARE_KICKOFF_BLUE"), (1, "PREPARE_KICKOFF_YELLOW")):
        row = Referee.new_game(team)
        assert row.shape == (len(GAME_COLUMNS),)
        assert row[GAME_COLUMNS.index("command")] == Command[command]
        assert row[GAME_COLUMNS.index("first_kickoff")] == team
    with pytest.raises(ValueError, match="kickoff: expected 0 or 1, got 2"):
        Referee.new_game(2)


def test_a_lineup_leaves_absent_robots_alone() -> None:
    frame = Frame.empty(2, 2, 1)
    frame.robots.absent[1, 1] = 1.0
    before = frame.rows.copy()
    REFEREE.line_up(frame.rows, [0, 0])
    assert (frame.ball.position == 0.0).all()
    assert (frame.blue.position[0, :, 0] < 0.0).all() and (
        frame.yellow.position[..., 0] > 0.0
    ).all()
    assert same(frame.robots.data[1, 1], Frame(before, 2, 1).robots.data[1, 1])


def test_a_lineup_needs_a_seed_for_each_match() -> None:
    with pytest.raises(ValueError, match="seeds: expected 2 numbers, got 1"):
        REFEREE.line_up(Frame.empty(2, 2, 1).rows, [0])


@pytest.mark.parametrize("position", range(5))
def test_arrays_of_another_form_are_named(position: int) -> None:
    name = ("game", "statistics", "score", "seconds_left", "may_touch")[position]
    rows, restart = line_up(2), line_up(2)
    right = new_matches(2)[position]
    wrongs: list[tuple[Any, type]] = [
        (right[:1], ValueError),
        (right.astype(np.complex64), TypeError),
    ]
    for wrong, error in [*wrongs, (right.tolist(), TypeError)]:
        matches = new_matches(2)
        matches[position] = wrong
        with pytest.raises(error, match=name):
            REFEREE.begin(rows, tuple(matches))
        with pytest.raises(error, match=name):
            REFEREE.judge(rows, rows, tuple(matches), restart)


@pytest.mark.parametrize("name", ["before", "after", "restart", "rows"])
def test_rows_of_another_form_are_named(name: str) -> None:
    rows, matches = line_up(2), tuple(new_matches(2))
    wrongs: list[Any] = [rows[:, :-1].copy(), rows.astype(np.float64)]
    for wrong in wrongs:
        with pytest.raises((ValueError, TypeError), match=name):
            if name == "rows":
                REFEREE.begin(wrong, matches)
            else:
                given = {"before": rows, "after": rows, "restart": rows.copy(), name: wrong}
                REFEREE.judge(given["before"], given["after"], matches, given["restart"])


def test_a_state_that_no_match_has_is_refused_by_its_column() -> None:
    matches = new_matches(2)
    for name, value in (("command", 50.0), ("stage", 14.0), ("in_play", 2.0), ("command", np.nan)):
        wrong = [matches[0].copy(), *matches[1:]]
        wrong[0][1, GAME_COLUMNS.index(name)] = value
        with pytest.raises(ValueError, match=f"expected a value of .{name}"):
            REFEREE.begin(line_up(2), tuple(wrong))
        with pytest.raises(ValueError, match=f"expected a value of .{name}"):
            REFEREE.features(wrong[0], line_up(2), [0])


def test_features_are_of_the_observers_that_are_asked_for() -> None:
    game, rows = new_matches(3)[0], line_up(3)
    all_robots = REFEREE.features(game, rows, [0, 1, 2])
    assert all_robots.shape == (3, 3, len(GAME_FEATURES))
    assert same(REFEREE.features(game, rows, [2, 0]), np.ascontiguousarray(all_robots[:, [2, 0]]))
    assert same(REFEREE.features(game, rows, [0, 1, 2], Threads(2)), all_robots)
    own, opponents = (GAME_FEATURES.index(f"{team}_kickoff") for team in ("own", "opponents"))
    assert all_robots[0, :, own].tolist() == [1, 1, 0] == all_robots[1, :, opponents].tolist()
    with pytest.raises(ValueError, match="observers: expected robots below 3, got 3"):
        REFEREE.features(game, rows, [3])


def test_a_referee_can_be_copied() -> None:
    twin = pickle.loads(pickle.dumps(REFEREE))
    rows, matches = line_up(2), new_matches(2)
    for referee in (twin, REFEREE):
        restart = np.zeros_like(rows)
        referee.judge(rows, rows, tuple(array.copy() for array in matches), restart)
    assert same(twin.features(matches[0], rows, [0]), REFEREE.features(matches[0], rows, [0]))


def test_rules_are_given_as_json() -> None:
    for text in ("", "{", "[]", '{"league": "ssl"}'):
        with pytest.raises(ValueError, match=r"^rules: "):
            Referee(CONFIG, text)


@pytest.mark.parametrize(
    "task", [VssMatch(referee={"no_progress_seconds": 0.2}), SslMatch()], ids=["vsss", "ssl"]
)
def test_threads_do_not_change_decisions(task: Any) -> None:  # noqa: ANN401
    """So many worlds that threads share the referee's work."""
    played = []
    for threads in (1, 3):
        matches = Matches(task, 200, 5, threads)
        pressing = Pressing(task)
        matches.reset()
        begin_play(matches)
        for _ in range(60):
            outcome = matches.step(pressing.actions(matches))
        assert matches.play.game.command.min() < Command.FORCE_START, "nothing was decided"
        played.append((outcome.observations, matches.state_dict()))
    assert same(played[0][0], played[1][0])
    assert all(same(played[0][1][key], played[1][1][key]) for key in played[0][1])


def test_the_first_kickoff_is_drawn_for_each_world() -> None:
    matches = Matches(VssMatch(), 64, seed=3)
    matches.reset()
    drawn = matches.play.game.first_kickoff.copy()
    assert 16 < drawn.sum() < 48
    for world in (0, 7, 63):
        alone = Matches(VssMatch(), 1, seed=3 + world)
        alone.reset()
        assert alone.play.game.first_kickoff[0] == drawn[world]
    some = np.arange(64) % 3 == 0
    matches.reset(mask=some)
    assert same(matches.play.game.first_kickoff[~some], drawn[~some])
    assert not same(matches.play.game.first_kickoff[some], drawn[some])


def test_a_restart_does_not_draw_another_kickoff() -> None:
    matches = Matches(VssMatch(), 8, seed=1)
    matches.reset()
    drawn = matches.play.game.first_kickoff.copy()
    for _ in range(170):  # the kick-off is arranged after 4 s, by a restart
        matches.step(zeros(matches))
    assert (matches.play.game.command == Command.NORMAL_START).all()
    assert same(matches.play.game.first_kickoff, drawn)


def test_several_decisions_of_a_step_are_events() -> None:
    task = SslMatch(n_blue=3, n_yellow=3)
    frame = task.get_initial_positions_frame(WorldRng.seeded(0, 2))
    frame.ball.position[:] = [0.0, 2.95]
    frame.ball.velocity[:] = [0.0, 5.0]
    frame.blue.position[:, 1], frame.yellow.position[:, 1] = [0.9, 1.0], [1.1, 1.0]
    frame.blue.velocity[:, 1], frame.yellow.velocity[:, 1] = [2.0, 0.0], [-2.0, 0.0]
    matches = Matches(task, 2, autoreset="disabled")
    matches.reset(rows=frame.rows)
    begin_play(matches)
    set_game(matches, last_touch=0, fouls_yellow=2)
    matches.step(zeros(matches))
    for world in range(2):
        events = matches.play.events.of_world(world)
        assert {(event.kind, event.team) for event in events} == {
            (EventKind.BALL_LEFT_FIELD_TOUCH_LINE, BLUE),
            (EventKind.BOT_CRASH_DRAWN, NOBODY),
            (EventKind.MULTIPLE_FOULS, YELLOW),
        }
    assert matches.play.game.yellow_cards.tolist() == [[0, 1]] * 2
    assert (matches.play.game.command == Command.STOP).all()
    assert (matches.play.game.next_command == Command.DIRECT_FREE_YELLOW).all()
