from rsoccer import game, make_task
from rsoccer._core import Field
from rsoccer.game import BLUE, NOBODY, EventKind
from rsoccer.render.announcer import SECONDS, Announcer, named_events
from rsoccer.render.words import NOTHING

GOAL = ("goal", "blue_0", "blue")
CARD = ("yellow_card", "", "yellow")
PUSH = ("bot_pushed_bot", "blue_1", "blue")
STUCK = ("free_ball", "", "")


def announcer() -> Announcer:
    return Announcer(Field("ssl_b"))


def test_an_event_is_announced_for_some_seconds() -> None:
    announces = announcer()
    assert announces.update([], 0.0) == NOTHING
    assert announces.update([PUSH], 1.0).text == "Pushing Blue #1"
    assert announces.update([], 1.0 + 0.99 * SECONDS).text == "Pushing Blue #1"
    assert announces.update([], 1.0 + SECONDS) == NOTHING


def test_a_later_event_takes_the_place_of_one_that_does_not_stand_out() -> None:
    announces = announcer()
    announces.update([PUSH], 0.0)
    assert announces.update([STUCK], 1.0).text == "No progress"
    assert announces.update([], 0.5 + SECONDS).text == "No progress"


def test_a_goal_stays_and_gives_way_to_a_card_only() -> None:
    announces = announcer()
    announces.update([GOAL], 0.0)
    assert announces.update([PUSH], 1.0).text == "Goal Blue #0"
    assert announces.update([CARD, PUSH], 2.0).text == "Yellow card Yellow"
    assert announces.update([], 1.9 + SECONDS).text == "Yellow card Yellow"
    assert announces.update([PUSH], 2.0 + SECONDS).text == "Pushing Blue #1"


def test_events_that_are_not_announced_change_nothing() -> None:
    announces = announcer()
    announces.update([PUSH], 0.0)
    assert announces.update([("touch", "blue_0", "")], 1.0).text == "Pushing Blue #1"


def test_an_earlier_time_begins_anew() -> None:
    announces = announcer()
    announces.update([GOAL], 5.0)
    assert announces.update([], 0.0) == NOTHING
    announces.update([GOAL], 5.0)
    announces.clear()
    assert announces.update([], 5.1) == NOTHING


def test_events_of_the_game_have_the_names_of_robots_and_teams() -> None:
    task = make_task("SSLMatch-v0")
    events = [
        game.Event(EventKind.BOT_PUSHED_BOT, BLUE, 2, (0.0, 0.0)),
        game.Event(EventKind.MULTIPLE_FOULS, BLUE, NOBODY, (0.0, 0.0)),
        game.Event(EventKind.BOT_CRASH_DRAWN, NOBODY, NOBODY, (0.0, 0.0)),
        game.Event(EventKind.GOAL, BLUE, 7, (0.0, 0.0)),
    ]
    assert named_events(task, events) == [
        ("bot_pushed_bot", "blue_2", "blue"),
        ("yellow_card", "", "blue"),
        ("bot_crash_drawn", "", ""),
        ("goal", "yellow_1", "blue"),
    ]
