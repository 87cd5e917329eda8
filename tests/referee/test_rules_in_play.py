"""Rules of both leagues in situations that the physics plays."""

from typing import Any

import pytest

from rsoccer.game import Command, EventKind, Stage
from rsoccer.referee import RefereeConfig, Scene, play_scene

KEEPERS = {"blue_0": (-4.5, 0.0), "yellow_0": (4.5, 0.0)}
PENALTY: dict[str, Any] = {
    "ball": (-1.5, 0.0),
    "command": "NORMAL_START",
    "kick": "PREPARE_PENALTY_BLUE",
}
"""Blue's penalty kick, from the permission on."""


def kinds(scene: Scene) -> list[EventKind]:
    return [event.kind for event in scene.events]


def omni(
    v_x: float = 0.0, kick: float = 0.0, chip: float = 0.0, dribbler: float = 0.0
) -> list[float]:
    """A command of an SSL robot: m/s forward, m/s of a kick ahead and up, dribbler."""
    return [v_x, 0.0, 0.0, kick, chip, dribbler]


def penalty(**robots: tuple[float, ...]) -> Scene:
    """The first moments of a penalty kick in which nobody moves."""
    kicker = {"blue_1": (-1.7, 0.0)}
    return play_scene("ssl", PENALTY | {"robots": KEEPERS | kicker | robots}, seconds=0.5)


def test_a_keeper_off_its_line_before_a_penalty_kick_gives_a_goal() -> None:
    assert kinds(penalty()) == []
    assert kinds(penalty(yellow_0=(4.45, 0.4))) == [], "it touches the line"
    scene = penalty(yellow_0=(4.3, 0.0))
    assert kinds(scene) == [EventKind.GOAL, EventKind.UNSPORTING_BEHAVIOR_MINOR]
    assert scene.events[1].robot == "yellow_0"
    assert scene.score == (1, 0) and scene.next_command == Command.PREPARE_KICKOFF_YELLOW


def test_a_keeper_may_come_out_once_the_ball_is_in_play() -> None:
    robots = KEEPERS | {"blue_1": (-1.7, 0.0), "yellow_0": (4.5, 0.0, 3.14)}
    commands = {"blue_1": omni(1.0), "yellow_0": omni(2.0)}
    early = play_scene("ssl", PENALTY | {"robots": robots}, commands, seconds=0.4)
    assert EventKind.UNSPORTING_BEHAVIOR_MINOR in kinds(early)
    shot = PENALTY | {"ball": (-1.5, 0.0, 4.0, 0.0), "robots": robots, "last_touch": "blue_1"}
    assert kinds(play_scene("ssl", shot, commands, seconds=0.4)) == []


def test_other_robots_keep_behind_the_ball_of_a_penalty_kick() -> None:
    assert kinds(penalty(blue_2=(-2.7, 1.0), yellow_1=(-2.7, -1.0))) == []
    attacker = penalty(blue_2=(-2.3, 1.0))
    assert kinds(attacker) == [EventKind.PENALTY_KICK_FAILED, EventKind.UNSPORTING_BEHAVIOR_MINOR]
    assert attacker.next_command == Command.DIRECT_FREE_YELLOW
    assert penalty(yellow_1=(-2.3, 1.0)).score == (1, 0)


def test_after_the_match_a_crash_is_no_foul() -> None:
    crash = {
        "ball": (0.0, 2.0),
        "robots": {"blue_0": (-0.3, 0.0, 0.0, 2.5, 0.0), "yellow_0": (0.0, 0.0)},
        "fouls": (2, 2),
    }
    drive = {"blue_0": omni(2.5)}
    during = play_scene("ssl", crash, drive, seconds=0.3)
    assert kinds(during) == [EventKind.BOT_CRASH_UNIQUE, EventKind.MULTIPLE_FOULS]
    after = play_scene("ssl", crash | {"stage": "POST_GAME", "command": "HALT"}, drive, seconds=0.3)
    assert kinds(after) == []
    assert after.game.fouls[0].tolist() == [2, 2]


def test_a_shoot_out_in_which_nobody_scores_ends() -> None:
    start = PENALTY | {
        "robots": KEEPERS | {"blue_1": (-1.7, 0.0), "yellow_1": (-3.0, 2.0)},
        "stage": "PENALTY_SHOOTOUT",
        "shootout_kicks": (9, 9),
    }
    scene = play_scene("ssl", start, seconds=40.0)
    assert kinds(scene) == [EventKind.PENALTY_KICK_FAILED] * 2
    assert scene.game.stage[0] == Stage.POST_GAME and scene.score == (0, 0)
    longer = RefereeConfig("ssl_2026_b", max_shootout_kicks=12)
    assert play_scene(longer, start, seconds=40.0).game.stage[0] == Stage.PENALTY_SHOOTOUT


@pytest.mark.parametrize("league", ["ssl", "vsss"])
def test_a_goal_in_the_last_step_of_a_match_counts(league: str) -> None:
    x = 4.42 if league == "ssl" else 0.6  # over the line in the second step
    ball = {"ball": (x, 0.0, 4.0, 0.0), "last_touch": "blue_0", "stage": "NORMAL_SECOND_HALF"}
    scene = play_scene(league, ball | {"seconds_left": 0.05}, seconds=0.2)
    assert kinds(scene) == [EventKind.GOAL] and scene.score == (1, 0)
    assert scene.game.stage[0] == Stage.POST_GAME and scene.command == Command.HALT


@pytest.mark.parametrize(("speed", "found"), [(6.4, False), (6.6, True)])
def test_the_speed_of_a_kick_is_that_of_its_first_moment(speed: float, found: bool) -> None:
    start = {"ball": (-2.0, 0.0), "robots": {"blue_0": (-2.1, 0.0)}}
    scene = play_scene("ssl", start, {"blue_0": omni(0.5, kick=speed, dribbler=1.0)}, seconds=0.3)
    assert (EventKind.BOT_KICKED_BALL_TOO_FAST in kinds(scene)) == found
    assert scene.frame.ball.speed_after_touch[0] == pytest.approx(speed, abs=0.1)


def test_a_ball_that_was_chipped_too_high_scores_no_goal() -> None:
    start = {"ball": (1.5, 0.0), "robots": {"blue_0": (1.4, 0.0)}}
    for chip, score in ((3.0, (0, 0)), (1.2, (1, 0))):
        commands = {"blue_0": omni(0.3, kick=4.5, chip=chip, dribbler=1.0)}
        scene = play_scene("ssl", start, commands, seconds=2.0)
        assert scene.score == score
        assert (EventKind.INVALID_GOAL in kinds(scene)) == (score == (0, 0))


def test_a_kicker_that_keeps_the_ball_touches_it_twice() -> None:
    start = {
        "ball": (-2.0, 0.0),
        "command": "DIRECT_FREE_BLUE",
        "robots": {"blue_0": (-2.12, 0.0), "yellow_0": (2.0, 0.0)},
    }
    scene = play_scene("ssl", start, {"blue_0": omni(0.8, dribbler=1.0)}, seconds=1.0)
    assert kinds(scene)[0] == EventKind.ATTACKER_DOUBLE_TOUCHED_BALL
    assert scene.next_command == Command.DIRECT_FREE_YELLOW


@pytest.mark.parametrize(("seconds", "found"), [(0.8, False), (2.2, True)])
def test_a_robot_must_not_dribble_farther_than_a_meter(seconds: float, found: bool) -> None:
    start = {"ball": (-2.0, 0.0), "robots": {"blue_0": (-2.12, 0.0)}}
    scene = play_scene("ssl", start, {"blue_0": omni(0.8, dribbler=1.0)}, seconds=seconds)
    assert (EventKind.BOT_DRIBBLED_BALL_TOO_FAR in kinds(scene)) == found


def test_a_second_defender_in_its_area_costs_a_penalty_kick() -> None:
    for robot, event in (("yellow_1", EventKind.DEFENDER_IN_DEFENSE_AREA), ("yellow_0", None)):
        start = {"ball": (3.95, 0.3, 1.0, 0.0), "robots": {robot: (4.2, 0.3)}}
        scene = play_scene("ssl", start, seconds=0.5)
        assert kinds(scene) == ([] if event is None else [event])


def test_vsss_two_attackers_with_the_ball_in_the_area_are_a_goal_kick() -> None:
    for second, found in (((0.62, -0.2), True), ((0.5, -0.2), False)):
        start = {
            "ball": (0.65, 0.0),
            "robots": {"blue_1": (0.68, 0.2), "blue_2": second, "yellow_1": (-0.3, 0.0)},
        }
        scene = play_scene("vsss", start, seconds=3.1)
        assert (EventKind.ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA in kinds(scene)) == found
        if found:
            assert scene.next_command == Command.GOAL_KICK_YELLOW


def test_vsss_a_ball_that_is_stuck_is_a_free_ball_and_in_an_area_a_penalty_kick() -> None:
    for x, following in ((0.2, Command.FREE_BALL), (0.68, Command.PREPARE_PENALTY_BLUE)):
        scene = play_scene("vsss", {"ball": (x, 0.0)}, seconds=5.1)
        assert scene.next_command == following
    assert kinds(play_scene("vsss", {"ball": (0.2, 0.0)}, seconds=4.8)) == []
