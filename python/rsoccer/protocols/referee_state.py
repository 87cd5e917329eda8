"""From the state of a running match, or of a replay, to what the referee tells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Final

import numpy as np

from rsoccer._core import GAME_COLUMNS
from rsoccer.game import BLUE, YELLOW, Command, Game, Stage
from rsoccer.protocols.game_events import ReportedEvent
from rsoccer.protocols.layout import TEAM_NAMES, TEAMS, WireLayout
from rsoccer.protocols.referee import NAMES, RefereeStatus, TeamStatus

if TYPE_CHECKING:
    from rsoccer.render.referee_state import RefereeState
    from rsoccer.rules.referee_config import RefereeConfig

_PLACEMENTS: Final = (Command.BALL_PLACEMENT_BLUE, Command.BALL_PLACEMENT_YELLOW)
_KICKOFFS: Final = (Command.PREPARE_KICKOFF_BLUE, Command.PREPARE_KICKOFF_YELLOW)
_PENALTIES: Final = (Command.PREPARE_PENALTY_BLUE, Command.PREPARE_PENALTY_YELLOW)
_FREE_KICKS: Final = (Command.DIRECT_FREE_BLUE, Command.DIRECT_FREE_YELLOW)
_UNTIMED: Final = (
    *(Stage.NORMAL_FIRST_HALF_PRE, Stage.NORMAL_SECOND_HALF_PRE),
    *(Stage.EXTRA_FIRST_HALF_PRE, Stage.EXTRA_SECOND_HALF_PRE),
    *(Stage.PENALTY_SHOOTOUT, Stage.POST_GAME),
)
"""Stages without a clock."""
_READ: Final = (
    *("command", "next_command", "stage", "kick", "in_play", "command_steps", "wait_steps"),
    *("designated_position_x", "designated_position_y"),
)
"""Columns of the match that packets tell."""
_PLACES: Final = np.array([GAME_COLUMNS.index(name) for name in _READ])
_COUNTS: Final = ("fouls", "yellow_cards", "red_cards", "placement_failures")
"""Columns of a team that packets tell, before those of its running yellow cards."""
_PLACES_OF_TEAMS: Final = tuple(
    np.array(
        [
            *(GAME_COLUMNS.index(f"{name}_{color}") for name in _COUNTS),
            *(i for i, n in enumerate(GAME_COLUMNS) if n.startswith(f"yellow_steps_left_{color}_")),
        ]
    )
    for color in TEAM_NAMES
)
_MAX_KEPT: Final = 64
"""Greatest number of states of teams that are kept."""


def status_of_game(
    layout: WireLayout,
    game: Game,
    world: int,
    rules: RefereeConfig,
    *,
    names: tuple[str, str] = NAMES,
    goalkeepers: tuple[int, int] = (0, 0),
    events: Sequence[ReportedEvent] = (),
) -> RefereeStatus:
    """Return what the referee of a running match tells.

    Args:
        layout: the match.
        game: state of matches with a referee, `play.game`.
        world: index of the world.
        rules: rules of the match.
        names: names of blue and of yellow.
        goalkeepers: uniform numbers of their goalkeepers.
        events: events since play stopped.
    """
    # All columns at once: one by one they take several times as long.
    row = game.referee[world]
    columns = dict(zip(_READ, row.take(_PLACES).tolist(), strict=True))
    command, stage = Command(int(columns["command"])), Stage(int(columns["stage"]))
    following = int(columns["next_command"])
    place = columns["designated_position_x"], columns["designated_position_y"]
    scores = game.score[world].tolist()
    blue, yellow = (
        _team_of_columns(
            tuple(row.take(_PLACES_OF_TEAMS[team]).tolist()),
            layout.config.time_step,
            len(layout.slots(team)),
            rules["placement_failures"],
            names[team],
            scores[team],
            goalkeepers[team],
        )
        for team in TEAMS
    )
    return RefereeStatus(
        command=command,
        stage=stage,
        teams=(blue, yellow),
        next_command=None if following < 0 else Command(following),
        seconds_left=None if stage in _UNTIMED else float(game.seconds_left[world]),
        action_seconds_left=_action_seconds_left(layout, columns, rules, command),
        designated_position=place if command in _PLACEMENTS else None,
        events=tuple(events),
    )


@lru_cache(maxsize=_MAX_KEPT)  # a team's state seldom changes
def _team_of_columns(
    columns: tuple[float, ...],
    step: float,
    robots: int,
    max_failures: float,
    name: str,
    score: int,
    goalkeeper: int,
) -> TeamStatus:
    """State of a team from its columns: `_COUNTS`, and steps that yellow cards have left."""
    fouls, yellow, red, failures = (int(number) for number in columns[: len(_COUNTS)])
    steps = [number for number in columns[len(_COUNTS) :] if number > 0]
    running = (np.array(steps, np.float32) * step).tolist()
    return TeamStatus(
        name=name,
        score=score,
        goalkeeper=goalkeeper,
        fouls=fouls,
        yellow_cards=yellow,
        yellow_card_seconds=tuple(running),
        red_cards=red,
        max_robots=max(0, robots - len(running) - red),
        placement_failures=max(0, failures),
        may_place=failures < max_failures,
    )


def _action_seconds_left(
    layout: WireLayout, columns: Mapping[str, float], rules: RefereeConfig, command: Command
) -> float | None:
    """Time that a kick or a ball placement has left; None where there is none to wait for."""
    step = layout.config.time_step
    elapsed = columns["command_steps"] * step
    if command in _PLACEMENTS:
        return columns["wait_steps"] * step - elapsed
    if columns["in_play"]:
        return None
    if command in _FREE_KICKS:
        return float(rules.free_kick_seconds) - elapsed
    if command is Command.NORMAL_START:
        kick = int(columns["kick"])
        if kick in _KICKOFFS:
            return float(rules.kickoff_seconds) - elapsed
        if kick in _PENALTIES:
            return float(rules.penalty_seconds) - elapsed
    return None


def status_of_recorded(
    state: RefereeState, *, names: tuple[str, str] = NAMES, events: Sequence[ReportedEvent] = ()
) -> RefereeStatus:
    """Return what the referee of a recorded match reported, as far as replays have it.

    Args:
        state: state of the referee in a frame of a replay.
        names: names of blue and of yellow.
        events: events since play stopped.
    """
    teams = tuple(
        TeamStatus(
            name=names[team],
            score=state.score[team],
            yellow_cards=state.yellow_cards[team],
            red_cards=state.red_cards[team],
        )
        for team in TEAMS
    )
    return RefereeStatus(
        command=state.command,
        stage=state.stage,
        teams=(teams[BLUE], teams[YELLOW]),
        next_command=state.next_command,
        seconds_left=None if state.stage in _UNTIMED else state.seconds_left,
        designated_position=state.designated_position if state.command in _PLACEMENTS else None,
        events=tuple(events),
    )
