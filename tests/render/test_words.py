import pytest

from rsoccer import SimConfig, game
from rsoccer._core import Field
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, EventKind, Stage
from rsoccer.render.words import (
    ANNOUNCED,
    EVENT_NAMES,
    FOULS,
    NOTHING,
    START_SECONDS,
    Words,
    announced,
    announcement,
    command_words,
    event_name,
    event_texts,
    has_clock,
    stage_text,
)
from tests.render.referee import state_of

VSSS, SSL = SimConfig().field, Field("ssl_b")
START = Command.NORMAL_START


@pytest.mark.parametrize(
    ("changes", "text", "team"),
    [
        ({"command": Command.HALT}, "Halt", NOBODY),
        ({"command": Command.STOP}, "Stop", NOBODY),
        (
            {"command": Command.STOP, "next_command": Command.PREPARE_KICKOFF_YELLOW},
            "Stop: kick-off Yellow next",
            YELLOW,
        ),
        (
            {"command": Command.STOP, "next_command": Command.FORCE_START},
            "Stop: force start next",
            NOBODY,
        ),
        ({"command": Command.DIRECT_FREE_BLUE}, "Free kick Blue", BLUE),
        ({"command": Command.BALL_PLACEMENT_BLUE}, "Ball placement Blue", BLUE),
        ({"command": Command.PREPARE_PENALTY_YELLOW}, "Prepare penalty Yellow", YELLOW),
        ({"command": Command.GOAL_KICK_BLUE}, "Prepare goal kick Blue", BLUE),
        ({"command": Command.FREE_BALL}, "Prepare free ball", NOBODY),
        ({"command": START, "kick": Command.PREPARE_KICKOFF_BLUE}, "Kick-off Blue", BLUE),
        ({"command": START, "kick": Command.PREPARE_PENALTY_BLUE}, "Penalty Blue", BLUE),
        ({"command": Command.DIRECT_FREE_BLUE, "in_play": True}, "", NOBODY),
    ],
)
def test_commands_in_words(changes: dict[str, object], text: str, team: int) -> None:
    assert command_words(state_of(**changes)) == Words(text, team)


def test_every_command_has_words() -> None:
    for command in Command:
        assert command_words(state_of(command=command)).text
        after = command_words(state_of(command=Command.STOP, next_command=command)).text
        assert after.endswith(" next")


@pytest.mark.parametrize(
    ("command", "kick", "text"),
    [
        (Command.FORCE_START, Command.FORCE_START, "Force start"),
        (START, Command.FREE_BALL, "Free ball"),
    ],
)
def test_play_that_begins_without_a_kick_is_shown_for_a_moment(
    command: Command, kick: Command, text: str
) -> None:
    def words(seconds: float) -> Words:
        return command_words(
            state_of(command=command, kick=kick, in_play=True, command_seconds=seconds)
        )

    assert words(0.5 * START_SECONDS).text == text
    assert words(1.5 * START_SECONDS) == NOTHING


@pytest.mark.parametrize(
    ("score", "text", "team"),
    [
        ((2, 1), "End of the match: Blue wins", BLUE),
        ((0, 1), "End of the match: Yellow wins", YELLOW),
        ((1, 1), "End of the match: a draw", NOBODY),
    ],
)
def test_the_end_of_a_match_names_the_winner(score: tuple[int, int], text: str, team: int) -> None:
    state = state_of(command=Command.HALT, stage=Stage.POST_GAME, score=score)
    assert command_words(state) == Words(text, team)


def test_every_part_of_a_match_has_words_and_those_before_a_shootout_a_clock() -> None:
    for stage in Stage:
        assert stage_text(state_of(stage=stage))
        assert has_clock(state_of(stage=stage)) == (stage < Stage.PENALTY_SHOOTOUT_BREAK)
    assert stage_text(state_of(stage=Stage.NORMAL_SECOND_HALF_PRE)) == "2nd half"


@pytest.mark.parametrize("field", [VSSS, SSL])
def test_every_event_has_a_text(field: Field) -> None:
    texts = event_texts(field)
    assert tuple(texts) == EVENT_NAMES
    names = {event_name(kind) for kind in set(EventKind) - {EventKind.NONE}}
    assert names < set(texts)
    assert set(FOULS) < ANNOUNCED < set(texts)


def test_the_leagues_have_texts_of_their_own() -> None:
    assert event_texts(VSSS)["free_ball"] == "Free ball"
    assert event_texts(SSL)["free_ball"] == "No progress"


@pytest.mark.parametrize(
    ("event", "words"),
    [
        (("goal", "blue_3", "blue"), Words("Goal Blue #3", BLUE)),
        (("goal", "yellow_10", "blue"), Words("Goal Blue, off Yellow #10", BLUE)),
        (("goal", "", "yellow"), Words("Goal Yellow", YELLOW)),
        (("bot_pushed_bot", "yellow_2", "yellow"), Words("Pushing Yellow #2", YELLOW)),
        (("red_card", "", "blue"), Words("Red card Blue", BLUE)),
        (("out", "blue_1", "touch_line_left"), Words("Ball out Blue #1", BLUE)),
        (("free_ball", "", ""), Words("No progress", NOBODY)),
        (("touch", "blue_1", ""), NOTHING),
        (("pass", "blue_1", "blue"), NOTHING),
        (("end", "", "terminated"), NOTHING),
    ],
)
def test_announcements_name_team_and_robot(event: tuple[str, str, str], words: Words) -> None:
    assert announcement(SSL, *event) == words


def test_a_red_card_is_announced_without_the_yellow_one_that_it_replaces() -> None:
    def card(kind: EventKind, team: int) -> game.Event:
        return game.Event(kind, team, NOBODY, (0.0, 0.0))

    blue, yellow = (card(EventKind.MULTIPLE_FOULS, team) for team in (BLUE, YELLOW))
    red = card(EventKind.MULTIPLE_CARDS, BLUE)
    assert announced([blue, red, yellow]) == [red, yellow]
    assert announced([blue, yellow]) == [blue, yellow]
