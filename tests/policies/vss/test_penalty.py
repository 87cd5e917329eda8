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


def masks(matches: Matches) -> tuple[list[int], list[int]]:
    """Robots that have a penalty kick, and robots that await one."""
    play = matches.play
    match = MatchState(play.sensed.rows, play.game, np.arange(6), play.threads, TASK.config)
    view = play.view
    kicking = penalty.kicks(match, ROLES, TASK.n_blue)
    waiting = penalty.awaits(match, view, ROLES, TASK.n_blue)
    return np.flatnonzero(kicking[0]).tolist(), np.flatnonzero(waiting[0]).tolist()


def test_one_robot_kicks_and_one_keeper_waits_until_the_ball_has_moved() -> None:
    matches = Matches(TASK)  # all learn, so that all have a view
    matches.reset()
    begin_play(matches)
    assert masks(matches) == ([], [])
    set_game(matches, **BLUE_KICKS, kick_position_x=0.0)
    assert masks(matches) == ([1], [3])
    set_game(matches, kick=Command.PREPARE_PENALTY_YELLOW)
    assert masks(matches) == ([4], [0])
    set_game(matches, kick_position_x=0.2)
    assert masks(matches) == ([], []), "the ball is in play"
    set_game(matches, kick_position_x=0.0, kick=NOBODY)
    assert masks(matches) == ([], [])


@pytest.mark.parametrize("y", [0.1, -0.1])
def test_the_kick_goes_into_the_corner_away_from_the_keeper(y: float) -> None:
    matches = Matches(TASK)
    matches.reset()
    view = matches.play.view.take(np.array([0]))
    view.opponents.position[..., 1] = y
    stage = np.zeros((1, 6), np.int8)
    kicking = np.array([[False, True, False, False, False, False]])
    geometry = FieldGeometry(TASK.config)
    penalty.choose_corner(geometry, view, kicking, stage, WorldRng.seeded(0, 1))
    assert stage.tolist() == [[0, -np.sign(y), 0, 0, 0, 0]]
    stage[0, 1] *= penalty.RUNS
    view.opponents.position[..., 1] = -y
    penalty.choose_corner(geometry, view, kicking, stage, WorldRng.seeded(0, 1))
    assert stage[0, 1] == -np.sign(y) * penalty.RUNS, "too late for the other corner"
    penalty.choose_corner(geometry, view, ~kicking, stage, WorldRng.seeded(0, 1))
    assert stage[0, 1] == penalty.NONE


def test_chance_decides_before_a_keeper_in_the_middle_and_only_there() -> None:
    matches = Matches(TASK, 64)
    matches.reset()
    view = matches.play.view
    stage = np.zeros((64, 6), np.int8)
    kicking = np.zeros((64, 6), np.bool_)
    kicking[:32, 1] = True
    rng = WorldRng.seeded(0, 64)
    before = rng.state
    penalty.choose_corner(FieldGeometry(TASK.config), view, kicking, stage, rng)
    assert {-1, 1} == set(stage[:32, 1].tolist())
    assert 8 < (stage[:32, 1] == 1).sum() < 24
    assert (rng.state != before).tolist() == [True] * 32 + [False] * 32
