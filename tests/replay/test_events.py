from collections import Counter

import numpy as np
import pytest

from rsoccer import SimConfig, game
from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, YELLOW, EventKind
from rsoccer.replay.events import KICK_GAIN, KINDS, Event, ball_events, game_events
from tests.replay.conftest import ssl, vss

CONFIG = SimConfig("ssl_b", 2, 1)
ROBOTS = ("blue_0", "blue_1", "yellow_0")
LEFT_TOUCH = EventKind.BALL_LEFT_FIELD_TOUCH_LINE
LEFT_GOAL = EventKind.BALL_LEFT_FIELD_GOAL_LINE
STUCK = EventKind.NO_PROGRESS_IN_GAME


def events(
    before: Frame, after: Frame, commands: np.ndarray[tuple[int, int], np.dtype[np.float32]]
) -> list[Event]:
    rows = np.concatenate([before.rows, after.rows])
    return ball_events(CONFIG, ROBOTS, 7, rows, commands)


def states() -> tuple[Frame, Frame, np.ndarray[tuple[int, int], np.dtype[np.float32]]]:
    commands = np.zeros((3, len(CONFIG.command_columns)), np.float32)
    return Frame.empty(1, 2, 1), Frame.empty(1, 2, 1), commands


@pytest.mark.parametrize(
    ("event", "kind", "robot", "detail"),
    [
        (game.Event(EventKind.GOAL, BLUE, 2, (3.0, 0.1)), "goal", "yellow_0", "blue"),
        (game.Event(EventKind.GOAL, YELLOW, NOBODY, (-3.0, 0.1)), "goal", "", "yellow"),
        (game.Event(LEFT_TOUCH, BLUE, 1, (1.0, 2.0)), "out", "blue_1", "touch_line_left"),
        (game.Event(LEFT_TOUCH, BLUE, 1, (1.0, -2.0)), "out", "blue_1", "touch_line_right"),
        (game.Event(LEFT_GOAL, NOBODY, NOBODY, (3.0, 1.0)), "out", "", "goal_line_right"),
        (game.Event(LEFT_GOAL, NOBODY, NOBODY, (-3.0, 1.0)), "out", "", "goal_line_left"),
        (game.Event(STUCK, NOBODY, NOBODY, (0.0, 0.0)), "free_ball", "", ""),
        (game.Event(EventKind.PASS, YELLOW, 2, (0.0, 0.0)), "pass", "yellow_0", "yellow"),
    ],
)
def test_events_of_the_game_are_recorded_by_name(
    event: game.Event, kind: str, robot: str, detail: str
) -> None:
    assert game_events(ROBOTS, 7, [event]) == [Event(7, kind, robot, detail)]


def test_every_event_of_the_game_has_a_name() -> None:
    for kind in set(EventKind) - {EventKind.NONE}:
        [event] = game_events(ROBOTS, 0, [game.Event(kind, BLUE, 0, (0.0, 0.0))])
        assert event.kind in KINDS


def test_a_touch_counts_when_it_begins() -> None:
    before, after, commands = states()
    after.robots.touched_ball[:, 1] = 1
    assert events(before, after, commands) == [Event(7, "touch", "blue_1", "")]
    before.robots.touched_ball[:, 1] = 1
    assert events(before, after, commands) == []


def test_a_kick_is_commanded_and_makes_the_ball_faster() -> None:
    before, after, commands = states()
    kick = CONFIG.command_columns.index("kick_v_x")
    for frame in (before, after):
        frame.robots.touched_ball[:, 0] = 1
    after.ball.velocity[:] = (1.1 * KICK_GAIN, 0.0)
    assert events(before, after, commands) == []
    commands[0, kick] = 5.0
    assert events(before, after, commands) == [Event(7, "kick", "blue_0", "")]
    after.ball.velocity[:] = (0.9 * KICK_GAIN, 0.0)
    assert events(before, after, commands) == []
    after.ball.vertical_velocity[:] = 2.0  # a chip
    assert events(before, after, commands) == [Event(7, "kick", "blue_0", "")]


def test_matches_have_events_of_each_kind() -> None:
    of_vss, of_ssl = (Counter(event.kind for event in replay.events) for replay in (vss(), ssl()))
    assert of_vss["goal"] == vss().score[-1].sum() > 0
    assert of_vss["end"] >= of_vss["goal"]
    assert of_vss["touch"] > 0
    assert "kick" not in of_vss
    assert of_ssl["kick"] > 1


def test_events_are_in_the_order_of_their_frames() -> None:
    for replay in (vss(), ssl()):
        frames = [event.frame for event in replay.events]
        assert frames == sorted(frames)
        assert not replay.starts[frames].any()
