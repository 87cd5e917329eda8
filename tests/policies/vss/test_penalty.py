import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.game import NOBODY, Command, EventKind, Stage
from rsoccer.lineup import lineup
from rsoccer.policies.base import MatchState
from rsoccer.policies.vss import penalty
from rsoccer.policies.vss.field_geometry import FieldGeometry
from rsoccer.policies.vss.roles import ATTACKER, KEEPER, SUPPORT
from rsoccer.rng import WorldRng
from rsoccer.tasks import VssMatch
from tests.games import begin_play, set_game

TASK = VssMatch()
ROLES = np.array([[KEEPER, ATTACKER, SUPPORT, KEEPER, ATTACKER, SUPPORT]])
BLUE_KICKS = {"command": Command.NORMAL_START, "kick": Command.PREPARE_PENALTY_BLUE}


def kicked(blue: str, yellow: str, worlds: int, stage: Stage, field: str = "vss_3v3") -> Matches:
    """Matches before a penalty kick of blue."""
    task = VssMatch(field=field, knockout=True)
    matches = Matches(task, worlds, controllers=lineup(task, blue, yellow), autoreset="disabled")
    matches.reset()
    begin_play(matches)
    set_game(
        matches,
        stage=stage,
        command=Command.STOP,
        next_command=Command.PREPARE_PENALTY_BLUE,
        designated_position_x=task.config.field.half_length - mark(task),
        in_play=False,
        wait_steps=0,
    )
    return matches


def mark(task: VssMatch) -> float:
    """Distance of the penalty mark from the goal line, m."""
    return float(task.config.field.penalty_mark_distance)


def share_scored(matches: Matches, seconds: float) -> float:
    """Share of the kicks of blue that are goals within a time after the kick is allowed."""
    nobody = np.zeros((matches.worlds, 0, 2), np.float32)
    decided = np.zeros(matches.worlds, np.bool_)
    scored, left = decided.copy(), np.full(matches.worlds, seconds / TASK.config.time_step)
    for _ in range(600):
        matches.step(nobody)
        events, game = matches.play.events, matches.play.game
        for kind in (EventKind.GOAL, EventKind.PENALTY_KICK_FAILED):
            for world in range(matches.worlds):
                ends = any(event.kind == kind for event in events.of_world(world))
                scored[world] |= ends and not decided[world] and kind == EventKind.GOAL
                decided[world] |= ends
        left -= game.kick == Command.PREPARE_PENALTY_BLUE
        decided |= left <= 0
        if decided.all():
            return float(scored.mean())
    raise AssertionError("kicks without an end")


@pytest.mark.parametrize("field", ["vss_3v3", "vss_5v5"])
def test_kicks_of_the_shootout_are_scored_and_saved(field: str) -> None:
    """Some of both: neither kicker nor keeper is helpless."""
    sides = ("scripted", "scripted")
    share = share_scored(kicked(*sides, 24, Stage.PENALTY_SHOOTOUT, field), 12.0)
    assert 0.3 <= share <= 0.9, share
