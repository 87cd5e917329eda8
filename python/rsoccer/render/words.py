"""Words for what a referee says and decides: commands, parts of a match, events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from rsoccer import game
from rsoccer._core import OFFENSES
from rsoccer.game import BLUE, NOBODY, YELLOW, Command, EventKind, Stage
from rsoccer.render.pitch import is_table
from rsoccer.render.referee_state import RefereeState, team_of
from rsoccer.view import SIDES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rsoccer._core import Field

START_SECONDS: Final = 2.0
"""Seconds for which the start of play without a kick is shown."""


class Words(NamedTuple):
    """A short text about a team."""

    text: str
    """The text; empty for none."""
    team: int
    """The team: `BLUE`, `YELLOW` or `NOBODY`."""


NOTHING: Final = Words("", NOBODY)
"""No text."""


# -- Commands ----------------------------------------------------------------------------------

_KICKS: Final = {
    Command.FORCE_START: "force start",
    Command.PREPARE_KICKOFF_BLUE: "kick-off",
    Command.PREPARE_KICKOFF_YELLOW: "kick-off",
    Command.PREPARE_PENALTY_BLUE: "penalty",
    Command.PREPARE_PENALTY_YELLOW: "penalty",
    Command.DIRECT_FREE_BLUE: "free kick",
    Command.DIRECT_FREE_YELLOW: "free kick",
    Command.FREE_BALL: "free ball",
    Command.GOAL_KICK_BLUE: "goal kick",
    Command.GOAL_KICK_YELLOW: "goal kick",
}
"""Way in which play begins, by the command that prepares or allows it."""
_PREPARED: Final = (
    *(Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW),
    *(Command.PREPARE_PENALTY_BLUE, Command.PREPARE_PENALTY_YELLOW),
    *(Command.FREE_BALL, Command.GOAL_KICK_BLUE, Command.GOAL_KICK_YELLOW),
)
_PLACEMENTS: Final = (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW)


def command_words(state: RefereeState) -> Words:
    """Return the command of the referee in words.

    Args:
        state: state of the referee.

    Returns:
        Words such as "Free kick Blue" and the team that they are about; no text while the ball is
        in play.
    """
    command = state.command
    if command in (Command.HALT, Command.STOP):
        return _stopped(state)
    if command in _PLACEMENTS:
        return Words(f"Ball placement {_team_text(team_of(command))}", team_of(command))
    if command in _PREPARED:
        return Words(f"Prepare {_kick_text(command)}", team_of(command))
    begins = command is Command.FORCE_START or state.kick is Command.FREE_BALL
    if state.in_play and not (begins and state.command_seconds < START_SECONDS):
        return NOTHING
    kick = state.kick if command is Command.NORMAL_START else command
    return Words(_capital(_kick_text(kick)), team_of(kick))


def _stopped(state: RefereeState) -> Words:
    """Words of a halt or a stop, with what follows."""
    if state.is_over:
        return _result(state)
    name = _capital(state.command.name.lower())
    if state.next_command is None:
        return Words(name, NOBODY)
    return Words(f"{name}: {_kick_text(state.next_command)} next", team_of(state.next_command))


def _result(state: RefereeState) -> Words:
    """Words of the end of a match, with the winner."""
    blue, yellow = state.score
    if blue == yellow:
        return Words("End of the match: a draw", NOBODY)
    winner = BLUE if blue > yellow else YELLOW
    return Words(f"End of the match: {_team_text(winner)} wins", winner)


def _kick_text(kick: Command | None) -> str:
    """Way in which play begins, and the team that has the kick."""
    text = "start" if kick is None else _KICKS.get(kick, "start")
    team = team_of(kick)
    return text if team == NOBODY else f"{text} {_team_text(team)}"


def _team_text(team: int) -> str:
    """Name of a team within a text."""
    return "Blue" if team == BLUE else "Yellow"


# -- Parts of a match --------------------------------------------------------------------------

_STAGES: Final = {
    Stage.NORMAL_FIRST_HALF_PRE: "1st half",
    Stage.NORMAL_FIRST_HALF: "1st half",
    Stage.NORMAL_HALF_TIME: "half time",
    Stage.NORMAL_SECOND_HALF_PRE: "2nd half",
    Stage.NORMAL_SECOND_HALF: "2nd half",
    Stage.EXTRA_TIME_BREAK: "extra time",
    Stage.EXTRA_FIRST_HALF_PRE: "extra time 1",
    Stage.EXTRA_FIRST_HALF: "extra time 1",
    Stage.EXTRA_HALF_TIME: "extra time",
    Stage.EXTRA_SECOND_HALF_PRE: "extra time 2",
    Stage.EXTRA_SECOND_HALF: "extra time 2",
    Stage.PENALTY_SHOOTOUT_BREAK: "shoot-out",
    Stage.PENALTY_SHOOTOUT: "shoot-out",
    Stage.POST_GAME: "full time",
}


def stage_text(state: RefereeState) -> str:
    """Return the part of the match in words.

    Args:
        state: state of the referee.
    """
    return _STAGES[state.stage]


def has_clock(state: RefereeState) -> bool:
    """Return whether the part of the match ends by the clock.

    Args:
        state: state of the referee.
    """
    return state.stage < Stage.PENALTY_SHOOTOUT_BREAK


# -- Events ------------------------------------------------------------------------------------

_NAMES: Final = {
    EventKind.BALL_LEFT_FIELD_TOUCH_LINE: "out",
    EventKind.BALL_LEFT_FIELD_GOAL_LINE: "out",
    EventKind.NO_PROGRESS_IN_GAME: "free_ball",
    EventKind.MULTIPLE_FOULS: "yellow_card",
    EventKind.MULTIPLE_CARDS: "red_card",
}
"""Names of kinds of events that are not those of the game controller."""

_EVENTS: Final = {
    "goal": "Goal",
    "out": "Ball out",
    "free_ball": "No progress",
    "pass": "Pass",
    "kick": "Kick",
    "touch": "Touch",
    "end": "End of the episode",
    "yellow_card": "Yellow card",
    "red_card": "Red card",
    "placement_failed": "Placement failed",
    "placement_succeeded": "Ball placed",
    "aimless_kick": "Aimless kick",
    "keeper_held_ball": "Ball held in area",
    "attacker_double_touched_ball": "Double touch",
    "attacker_touched_ball_in_defense_area": "Attacker in area",
    "bot_dribbled_ball_too_far": "Dribbled too far",
    "bot_kicked_ball_too_fast": "Kicked too fast",
    "attacker_too_close_to_defense_area": "Too close to area",
    "bot_interfered_placement": "Placement interference",
    "bot_crash_drawn": "Crash, both teams",
    "bot_crash_unique": "Crash",
    "bot_pushed_bot": "Pushing",
    "bot_too_fast_in_stop": "Too fast in stop",
    "defender_too_close_to_kick_point": "Too close to ball",
    "defender_in_defense_area": "Defender in area",
    "too_many_robots": "Too many robots",
    "boundary_crossing": "Ball over the walls",
    "invalid_goal": "Goal does not count",
    "penalty_kick_failed": "Penalty missed",
}
"""Texts of events by name."""
_VSSS_EVENTS: Final = {
    "free_ball": "Free ball",
    "keeper_held_ball": "Stuck in area",
    "attacker_touched_ball_in_defense_area": "Two attackers in area",
    "defender_in_defense_area": "Two defenders in area",
}
"""Texts that differ in VSSS."""


def event_name(kind: EventKind) -> str:
    """Return the name of a kind of events, in lower case.

    Args:
        kind: the kind.
    """
    return _NAMES.get(kind, kind.name.lower())


EVENT_NAMES: Final = tuple(_EVENTS)
"""Names of all kinds of events, those of the ball and of episodes too."""
PROMINENT: Final = ("goal", "yellow_card", "red_card")
"""Events that stand out."""
ANNOUNCED: Final = frozenset(_EVENTS) - {
    *("pass", "kick", "touch", "end", "placement_succeeded"),
}
"""Events that are announced."""
FOULS: Final = tuple(event_name(EventKind(kind)) for kind in OFFENSES)
"""Events that are fouls, in the order of statistics."""


def event_texts(field: Field) -> dict[str, str]:
    """Return the texts of events by name.

    Args:
        field: field of the match: the leagues have different rules for some kinds.
    """
    return _EVENTS | (_VSSS_EVENTS if is_table(field) else {})


def announced(events: Sequence[game.Event]) -> list[game.Event]:
    """Return the events of a step without the reasons of others.

    A team without time for a yellow card gets a red one, and has the events of both.

    Args:
        events: events of the step, as `Events.of_world` returns them.
    """
    red = {event.team for event in events if event.kind is EventKind.MULTIPLE_CARDS}
    return [
        event
        for event in events
        if not (event.kind is EventKind.MULTIPLE_FOULS and event.team in red)
    ]


def announcement(field: Field, name: str, robot: str, detail: str) -> Words:
    """Return the words with which an event is announced.

    Args:
        field: field of the match.
        name: name of the kind.
        robot: robot that the event is about; empty for none.
        detail: team that the event is about; of a ball that left the field the line, or empty.

    Returns:
        Words such as "Pushing Blue #3" and the team; no text for an event that is not announced.
    """
    if name not in ANNOUNCED:
        return NOTHING
    side, _, number = robot.partition("_")
    teams = [SIDES.index(team) for team in (detail, side) if team in SIDES]
    parts = [event_texts(field)[name], *(_team_text(team) for team in teams[:1])]
    if len(set(teams)) > 1:  # an own goal
        parts[-1] += ", off"
        parts.append(_team_text(teams[1]))
    if number:
        parts.append(f"#{number}")
    return Words(" ".join(parts), teams[0] if teams else NOBODY)


def side_of(team: int) -> str:
    """Return the name of a team in lower case; empty for nobody.

    Args:
        team: `BLUE`, `YELLOW` or `NOBODY`.
    """
    return "" if team == NOBODY else SIDES[team]


def _capital(text: str) -> str:
    """A text with a capital at its beginning."""
    return text[:1].upper() + text[1:]
