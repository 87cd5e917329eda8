"""Events of the referee as the game controller tells them, and back."""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from rsoccer import game
from rsoccer.game import BLUE, NOBODY, YELLOW, EventKind
from rsoccer.protocols.errors import Code, MessageError
from rsoccer.protocols.layout import MICROSECONDS, WireLayout
from rsoccer.protocols.schemas import referee_pb2

_WIRE_TEAMS: Final = {BLUE: referee_pb2.BLUE, YELLOW: referee_pb2.YELLOW}
_TEAMS: Final = {wire: team for team, wire in _WIRE_TEAMS.items()}
_ROBOTS: Final = ("by_bot", "violator", "kicking_bot")
"""Fields of the robot that an event is about."""
_PLACES: Final = ("location", "end")
"""Fields of the place of an event: that of dribbling is where it ended."""
_REASON: Final = "position at a penalty kick"
"""Reason of unsporting behavior that rSoccer's referee knows."""


class ReportedEvent(NamedTuple):
    """An event that packets tell again and again, so it has an identity."""

    event: game.Event
    """The event."""
    identity: str
    """Text unlike that of any other event of the match."""
    seconds: float
    """Time of the event, Unix time, s; 0 if unknown."""


def to_game_event(layout: WireLayout, reported: ReportedEvent) -> referee_pb2.GameEvent:
    """Return the message of an event.

    Args:
        layout: the match.
        reported: the event.

    Raises:
        MessageError: an event that the game controller does not have, such as a pass, or one
            without the team that it needs.
    """
    event, name = reported.event, reported.event.kind.name
    if name not in referee_pb2.GameEvent.Type.keys() or event.kind is EventKind.NONE:  # noqa: SIM118
        raise MessageError(Code.UNSUPPORTED_EVENT, f"event: expected one of the SSL, got {name}")
    message = referee_pb2.GameEvent(
        id=reported.identity,
        type=name,
        created_timestamp=max(0, round(reported.seconds * MICROSECONDS)),
    )
    content = getattr(message, name.lower())
    content.SetInParent()
    fields = content.DESCRIPTOR.fields_by_name
    if "by_team" in fields:
        if event.team == NOBODY:
            raise MessageError(Code.UNKNOWN_TEAM, f"event: expected a team for {name}, got none")
        content.by_team = _WIRE_TEAMS[event.team]
    if event.robot != NOBODY:
        _put_robot(layout, event, content)
    for place in _PLACES:
        if place in fields:
            x, y = event.position
            point = getattr(content, place)
            point.x, point.y = x * layout.sign, y * layout.sign
    if "reason" in fields and event.kind is EventKind.UNSPORTING_BEHAVIOR_MINOR:
        content.reason = _REASON
    return message


def _put_robot(layout: WireLayout, event: game.Event, content: Any) -> None:  # noqa: ANN401  (any event)
    """Set the fields of the robot."""
    team, number = layout.identity(event.robot)
    fields = content.DESCRIPTOR.fields_by_name
    for name in _ROBOTS:
        if name in fields:
            setattr(content, name, number)
    if "kicking_team" in fields:
        content.kicking_team = _WIRE_TEAMS[team]
    if "bot_blue" in fields:
        setattr(content, "bot_blue" if team == BLUE else "bot_yellow", number)


def read_game_event(layout: WireLayout, message: referee_pb2.GameEvent) -> ReportedEvent:
    """Return the event of a message.

    Args:
        layout: the match.
        message: the event, of a packet from `rsoccer.protocols.parsing.parse`.

    Returns:
        The event: `NOBODY` for a team or a robot that the message lacks, and the center for a
        place that it lacks. Without an identity in the message, it is the message itself.

    Raises:
        MessageError: an event that rSoccer does not have, or a robot that does not play.
    """
    field = message.WhichOneof("event")
    if message.HasField("type"):
        name = referee_pb2.GameEvent.Type.Name(message.type)
    else:
        name = (field or "none").upper()
    if name not in EventKind.__members__ or name == "NONE":
        raise MessageError(Code.UNSUPPORTED_EVENT, f"event: expected a known one, got {name}")
    content = getattr(message, field) if field else None
    team, robot, position = NOBODY, NOBODY, (0.0, 0.0)
    for part, value in content.ListFields() if content is not None else ():
        if part.name == "by_team":
            team = _TEAMS.get(value, NOBODY)
        elif part.name in _PLACES:
            position = (value.x * layout.sign, value.y * layout.sign)
    if content is not None:
        robot = _robot(layout, content, team)
    return ReportedEvent(
        game.Event(EventKind[name], team, robot, position),
        message.id or message.SerializeToString(deterministic=True).hex(),
        message.created_timestamp / MICROSECONDS,
    )


def _robot(layout: WireLayout, content: Any, team: int) -> int:  # noqa: ANN401  (any event)
    """Index of the robot of an event in a state row."""
    given = {part.name: value for part, value in content.ListFields()}
    team = _TEAMS.get(given.get("kicking_team", referee_pb2.UNKNOWN), team)
    for name in _ROBOTS:
        if name in given and team != NOBODY:
            return layout.slot(team, given[name])
    if "bot_blue" in given:
        return layout.slot(BLUE, given["bot_blue"])
    if "bot_yellow" in given:
        return layout.slot(YELLOW, given["bot_yellow"])
    return NOBODY
