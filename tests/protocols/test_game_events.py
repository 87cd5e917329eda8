"""Events as the game controller tells them."""

import pytest

from rsoccer.game import BLUE, NOBODY, YELLOW, Event, EventKind
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.game_events import ReportedEvent, read_game_event, to_game_event
from rsoccer.protocols.parsing import parse
from rsoccer.protocols.schemas import referee_pb2
from tests.protocols.matches import SIDES, layout

KINDS = [kind for kind in EventKind if kind not in (EventKind.NONE, EventKind.PASS)]
WITHOUT_TEAM = (EventKind.NO_PROGRESS_IN_GAME, EventKind.BOT_CRASH_DRAWN)
ROBOT_FIELDS = {"by_bot", "violator", "kicking_bot", "bot_blue"}
PLACE_FIELDS = {"location", "end"}


@pytest.mark.parametrize("positive", SIDES)
@pytest.mark.parametrize("kind", KINDS)
def test_every_event_survives_the_wire(kind: EventKind, positive: bool) -> None:
    made = layout(positive=positive)
    for team, robot in ((BLUE, 2), (YELLOW, 4)):
        reported = ReportedEvent(Event(kind, team, robot, (0.5, -0.25)), "an id", 1.5)
        message = to_game_event(made, reported)
        content = message.WhichOneof("event")
        assert content == kind.name.lower()
        assert referee_pb2.GameEvent.Type.Name(message.type) == kind.name
        found = read_game_event(made, parse(referee_pb2.GameEvent, message.SerializeToString()))
        fields = set(getattr(message, content).DESCRIPTOR.fields_by_name)
        expected = Event(
            kind,
            team if "by_team" in fields else NOBODY,
            robot if fields & ROBOT_FIELDS else NOBODY,
            (0.5, -0.25) if fields & PLACE_FIELDS else (0.0, 0.0),
        )
        assert found == ReportedEvent(expected, "an id", 1.5)


def test_the_kinds_cover_all_of_the_referee() -> None:
    assert len(KINDS) == 27


def test_own_goals_name_the_team_of_the_robot() -> None:
    reported = ReportedEvent(Event(EventKind.GOAL, BLUE, 4, (1.0, 0.0)), "a", 0.0)
    message = to_game_event(layout(), reported)
    assert message.goal.by_team == referee_pb2.BLUE
    assert (message.goal.kicking_team, message.goal.kicking_bot) == (referee_pb2.YELLOW, 3)
    assert read_game_event(layout(), message).event == reported.event


@pytest.mark.parametrize("kind", [EventKind.PASS, EventKind.NONE])
def test_events_of_this_package_are_not_reported(kind: EventKind) -> None:
    with pytest.raises(MessageError, match=r"^event: expected one of the SSL") as error:
        to_game_event(layout(), ReportedEvent(Event(kind, BLUE, 0, (0, 0)), "a", 0.0))
    assert error.value.code is Code.UNSUPPORTED_EVENT


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in WITHOUT_TEAM])
def test_events_need_their_team(kind: EventKind) -> None:
    with pytest.raises(MessageError, match=r"^event: expected a team") as error:
        to_game_event(layout(), ReportedEvent(Event(kind, NOBODY, NOBODY, (0, 0)), "a", 0.0))
    assert error.value.code is Code.UNKNOWN_TEAM


def test_events_without_a_type_are_known_by_their_content() -> None:
    message = referee_pb2.GameEvent()
    message.placement_failed.by_team = referee_pb2.YELLOW
    found = read_game_event(layout(), message)
    assert found.event == Event(EventKind.PLACEMENT_FAILED, YELLOW, NOBODY, (0.0, 0.0))
    assert found.identity


@pytest.mark.parametrize("name", ["bot_substitution", "prepared", "possible_goal"])
def test_events_that_rsoccer_does_not_have_are_refused(name: str) -> None:
    message = referee_pb2.GameEvent()
    getattr(message, name).SetInParent()
    with pytest.raises(MessageError, match=r"^event: expected a known one, got"):
        read_game_event(layout(), message)
    with pytest.raises(MessageError, match=r"got NONE"):
        read_game_event(layout(), referee_pb2.GameEvent())


def test_robots_that_do_not_play_are_refused() -> None:
    message = referee_pb2.GameEvent()
    message.goal.by_team, message.goal.kicking_bot = referee_pb2.BLUE, 99
    with pytest.raises(MessageError, match=r"^id: expected one of") as error:
        read_game_event(layout(), message)
    assert error.value.code is Code.UNKNOWN_ROBOT
