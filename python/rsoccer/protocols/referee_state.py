"""From the state of a running match, or of a replay, to what the referee tells."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from rsoccer.game import BLUE, YELLOW, Command, Game, Stage
from rsoccer.protocols.game_events import ReportedEvent
from rsoccer.protocols.layout import TEAMS, WireLayout
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
    command, stage = Command(int(game.command[world])), Stage(int(game.stage[world]))
    following = int(game.next_command[world])
    x, y = game.designated_position[world].tolist()
    return RefereeStatus(
        command=command,
        stage=stage,
        teams=(
            _team_of_game(layout, game, world, rules, BLUE, names[BLUE], goalkeepers[BLUE]),
            _team_of_game(layout, game, world, rules, YELLOW, names[YELLOW], goalkeepers[YELLOW]),
        ),
        next_command=None if following < 0 else Command(following),
        seconds_left=None if stage in _UNTIMED else float(game.seconds_left[world]),
        action_seconds_left=_action_seconds_left(layout, game, world, rules, command),
        designated_position=(x, y) if command in _PLACEMENTS else None,
        events=tuple(events),
    )


def _team_of_game(
    layout: WireLayout,
    game: Game,
    world: int,
    rules: RefereeConfig,
    team: int,
    name: str,
    goalkeeper: int,
) -> TeamStatus:
    cards = game.yellow_steps_left[world].reshape(len(TEAMS), -1)[team]
    running = (cards[cards > 0] * layout.config.time_step).tolist()
    red = int(game.red_cards[world, team])
    failures = int(game.placement_failures[world, team])
    return TeamStatus(
        name=name,
        score=int(game.score[world, team]),
        goalkeeper=goalkeeper,
        fouls=int(game.fouls[world, team]),
        yellow_cards=int(game.yellow_cards[world, team]),
        yellow_card_seconds=tuple(running),
        red_cards=red,
        max_robots=max(0, len(layout.slots(team)) - len(running) - red),
        placement_failures=max(0, failures),
        may_place=failures < rules.placement_failures,
    )


def _action_seconds_left(
    layout: WireLayout, game: Game, world: int, rules: RefereeConfig, command: Command
) -> float | None:
    """Time that a kick or a ball placement has left; None where there is none to wait for."""
    step = layout.config.time_step
    elapsed = float(game.command_steps[world]) * step
    if command in _PLACEMENTS:
        return float(game.wait_steps[world]) * step - elapsed
    if game.in_play[world]:
        return None
    if command in _FREE_KICKS:
        return float(rules.free_kick_seconds) - elapsed
    if command is Command.NORMAL_START:
        kick = int(game.kick[world])
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
