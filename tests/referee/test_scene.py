"""Scenes under the referee: starts by name, commands, what is returned."""

import math
from typing import Any

import numpy as np
import pytest

from rsoccer import Field, SimConfig, Simulator
from rsoccer._core import (
    GAME_COLUMNS,
    STATISTICS_COLUMNS,
    Referee,
    ScriptedTeam,
    referee_preset,
)
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.game import Command, EventKind
from rsoccer.referee import RefereeConfig, Scene, play_scene, rules


def kinds(scene: Scene) -> list[EventKind]:
    return [event.kind for event in scene.events]


def test_a_ball_over_a_touch_line_is_a_throw_in() -> None:
    for robot, following in (("blue_3", "DIRECT_FREE_YELLOW"), ("yellow_0", "DIRECT_FREE_BLUE")):
        scene = play_scene("ssl", {"ball": (1.0, 2.9, 0.0, 2.0), "last_touch": robot})
        (event,) = scene.events
        assert (event.kind, event.robot) == (EventKind.BALL_LEFT_FIELD_TOUCH_LINE, robot)
        assert event.team == robot.split("_")[0]
        assert event.seconds == pytest.approx(0.075)
        assert scene.command == Command.STOP and scene.next_command == Command[following]
        assert scene.commands == ((0.0, Command.FORCE_START), (event.seconds, Command.STOP))
        assert scene.restart is not None
        assert scene.restart.ball.position[0].tolist() == pytest.approx([1.0, 2.8])


def test_goals_count_from_the_score_of_the_start() -> None:
    start = {"ball": (4.2, 0.0, 4.0, 0.0), "last_touch": "blue_0", "score": (1, 2)}
    scene = play_scene("ssl_2026_b", start)
    assert kinds(scene) == [EventKind.GOAL] and scene.score == (2, 2)
    assert scene.next_command == Command.PREPARE_KICKOFF_YELLOW


def test_a_goal_that_was_too_high_does_not_count() -> None:
    start = {"ball": (4.2, 0.0, 4.0, 0.0), "last_touch": "blue_0", "height_since_touch": (0.2, 0)}
    scene = play_scene("ssl", start)
    assert EventKind.INVALID_GOAL in kinds(scene) and scene.score == (0, 0)
    lenient = RefereeConfig("ssl_2026_b", goal_height=0.3)
    assert play_scene(lenient, start).score == (1, 0)


def test_robots_drive_by_name_by_array_and_by_function() -> None:
    start = {"ball": (3.0, 2.0), "robots": {"blue_0": (0.0, 0.0), "yellow_1": (1.0, 1.0, math.pi)}}
    ahead = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]  # m/s
    by_name = play_scene("ssl", start, {"blue_0": ahead})

    def function(frame: Frame, seconds: float) -> Floats:
        assert len(frame) == 1 and 0.0 <= seconds < 1.0
        return array

    array = np.zeros((3, 6), np.float32)
    array[0] = ahead
    for commands in (array, function):
        scene = play_scene("ssl", start, commands)
        assert np.array_equal(scene.frame.rows, by_name.frame.rows)
    robots = by_name.frame.robots
    assert robots.position[0, 0, 0] > 0.5
    assert robots.absent[0].tolist() == [0.0, 1.0, 0.0], "yellow_0 is not named"
    assert np.allclose(robots.position[0, 2], [1.0, 1.0], atol=1e-3)


def test_vsss_is_played_with_its_times() -> None:
    start = {"ball": (0.6, 0.0, 2.0, 0.0), "robots": {"blue_0": (0, 0), "yellow_0": (0.5, 0.3)}}
    scene = play_scene("vsss", start, seconds=13.0)
    assert [command for _, command in scene.commands] == [
        Command.FORCE_START,
        Command.STOP,
        Command.PREPARE_KICKOFF_YELLOW,
        Command.NORMAL_START,
    ]
    times = [seconds for seconds, _ in scene.commands]
    assert np.diff(times[1:]).tolist() == pytest.approx([8.0, 4.0], abs=0.03)


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"bal": (0, 0)}, "got 'bal'"),
        ({"command": "GO"}, "start\\['command'\\]: expected one of .*'HALT'.* got 'GO'"),
        ({"ball": (0,)}, "ball: expected 2 to 6"),
        ({"ball": {"q": 1}}, "ball: expected names"),
        ({"robots": {"red_0": (0, 0)}}, "expected names like 'blue_0', got 'red_0'"),
        ({"last_touch": "blue"}, "start\\['last_touch'\\]: expected one of"),
        ({"score": (1, 2, 3)}, "start\\['score'\\]: expected numbers of shape"),
        ({"robots": {"blue_0": (0, 0), "blue_1": (0.05, 0)}}, "overlap"),
        ({"robots": {"blue_01": (0, 0)}}, "expected names like 'blue_0', got 'blue_01'"),
        ({"yellow_cards": (2.5, 0)}, "start\\['yellow_cards'\\]: expected whole numbers from 0"),
        ({"fouls_blue": -1}, "start\\['fouls_blue'\\]: expected whole numbers from 0 to 16777215"),
        ({"in_play": 2}, "start\\['in_play'\\]: expected whole numbers from 0 to 1, got 2"),
        ({"command_steps": 1e8}, "start\\['command_steps'\\]: expected whole numbers"),
        ({"designated_position": (math.nan, 0)}, "expected finite numbers, got \\(nan, 0\\)"),
        ({"penalty_way": 1e39}, "start\\['penalty_way'\\]: expected finite numbers"),
        ({"seconds_left": math.inf}, "start\\['seconds_left'\\]: expected -419430 to 419430"),
        ({"ball": (math.nan, 0)}, "start: ball: x: expected .*, got nan"),
        ({"stage": None}, "start\\['stage'\\]: expected one of .*, got None"),
        ({"command": None}, "start\\['command'\\]: expected one of .*, got None"),
        ({"stage": True}, "start\\['stage'\\]: expected one of .*, got True"),
        ({"referee": 1}, "start: expected names of .*, got 'referee'"),
        ({"take": 1}, "start: expected names of .*, got 'take'"),
        ({3: 1}, "start: expected names of .*, got 3"),
    ],
)
def test_wrong_starts_are_named(start: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        play_scene("ssl", start)


def test_the_core_takes_what_a_start_takes() -> None:
    # The core reads whole numbers alone in some columns; which ones is known here by their names.
    for name in GAME_COLUMNS:
        if name in ("command", "next_command", "kick", "stage"):
            continue
        config = SimConfig("ssl_b", 1, 1)
        row = np.zeros((1, config.row_size), np.float32)
        Simulator(config).read(row)
        for number in (0.5, -1.0, 2.0, 2.0**24):
            game = Referee.new_game(0)[None].copy()
            game[0, GAME_COLUMNS.index(name)] = number
            arrays = (
                game,
                np.zeros((1, len(STATISTICS_COLUMNS)), np.float32),
                np.zeros((1, 2), np.int64),
                np.zeros(1, np.float32),
                np.zeros((1, 2), np.bool_),
            )
            try:
                Referee(config, referee_preset("ssl_2026_b")).begin(row, arrays)
            except ValueError:
                with pytest.raises(ValueError, match=f"start\\['{name}'\\]"):
                    play_scene("ssl", {name: number}, seconds=0.0)


def test_other_wrong_arguments_are_named() -> None:
    with pytest.raises(ValueError, match="seconds: expected at least 0, got inf"):
        play_scene("ssl", {}, seconds=math.inf)
    with pytest.raises(TypeError, match="seconds: expected a number, got '1'"):
        play_scene("ssl", {}, seconds="1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="start\\['seconds_left'\\]: expected a number, got 'x'"):
        play_scene("ssl", {"seconds_left": "x"})
    with pytest.raises(TypeError, match="start: ball: x: expected a number, got 'a'"):
        play_scene("ssl", {"ball": ("a", 0)})
    with pytest.raises(TypeError, match="config: expected a SimConfig, got 3"):
        play_scene("ssl", {}, config=3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"start\['robots'\]: expected names of .*, got 'blue_3'"):
        play_scene("ssl", {"robots": {"blue_3": (0, 0)}}, config=SimConfig("ssl_b", 1, 1))
    start = {"robots": {"blue_0": (0, 0)}, "ball": (1, 1)}
    for wrong in ([0.0] * 5, 1.0):
        with pytest.raises(ValueError, match="commands\\['blue_0'\\]: expected shape \\(6,\\)"):
            play_scene("ssl", start, {"blue_0": wrong})
    with pytest.raises(
        ValueError, match="commands\\['blue_0'\\]: expected finite numbers, got nan"
    ):
        play_scene("ssl", start, {"blue_0": [math.nan] * 6})
    with pytest.raises(ValueError, match="league: expected one of"):
        play_scene("rugby", {})
    with pytest.raises(ValueError, match="seconds: expected at least 0, got -1"):
        play_scene("ssl", {}, seconds=-1)
    with pytest.raises(ValueError, match="commands: expected names"):
        play_scene("ssl", {}, {"blue_7": [0.0] * 6})
    with pytest.raises(ValueError, match="commands: expected shape"):
        play_scene("ssl", {}, np.zeros((1, 6), np.float32))
    with pytest.raises(TypeError, match="start: expected a mapping"):
        play_scene("ssl", [])  # type: ignore[arg-type]


def test_rules_are_listed_with_sources() -> None:
    for league in ("ssl", "vsss"):
        entries = rules(league)
        assert len({entry.name for entry in entries}) == len(entries) > 5
        assert all(entry.source and entry.summary and "::" in entry.function for entry in entries)
    with pytest.raises(ValueError, match="league: expected 'ssl' or 'vsss'"):
        rules("x")


@pytest.mark.parametrize(("n_blue", "n_yellow"), [(1, 0), (0, 1), (0, 0)])
def test_teams_may_have_no_robots(n_blue: int, n_yellow: int) -> None:
    config = SimConfig("ssl_b", n_blue, n_yellow)
    robots = {"blue_0": (-3.0, 0.0)} if n_blue else {}
    robots |= {"yellow_0": (3.0, 0.0)} if n_yellow else {}
    start = {"ball": (-1.5, 0.0), "robots": robots, "command": "NORMAL_START"}
    for kick in ("PREPARE_PENALTY_BLUE", "PREPARE_KICKOFF_YELLOW"):
        scene = play_scene("ssl", {**start, "kick": kick}, seconds=0.5, config=config)
        assert scene is not None
    if not robots:
        with pytest.raises(ValueError, match="config: expected robots, got none"):
            ScriptedTeam(config, 1.0)
        return
    for team in (0, 1):
        script = ScriptedTeam(config, 1.0)
        memory = np.zeros((1, script.memory_size), np.float32)
        script.begin(memory, [0])
        row = np.zeros((1, config.row_size), np.float32)
        Simulator(config).read(row)
        commands = script.commands(row, Referee.new_game(0)[None], memory, team)
        assert commands.shape[:2] == (1, (n_blue, n_yellow)[team])
        assert np.isfinite(commands).all()


def test_indices_that_no_robot_has_are_nobody() -> None:
    config = SimConfig("ssl_b", 2, 2)
    referee = Referee(config, referee_preset("ssl_2026_b"))
    game = Referee.new_game(0)[None].copy()
    for name in ("kick_taker", "last_touch", "dribbler"):
        game[0, GAME_COLUMNS.index(name)] = 40
    game[0, GAME_COLUMNS.index("in_play")] = 1
    game[0, GAME_COLUMNS.index("command")] = 3
    arrays = (
        game,
        np.zeros((1, len(STATISTICS_COLUMNS)), np.float32),
        np.zeros((1, 2), np.int64),
        np.zeros(1, np.float32),
        np.zeros((1, 4), np.bool_),
    )
    row = np.zeros((1, config.row_size), np.float32)
    Simulator(config).read(row)
    referee.judge(row, row, arrays, row.copy())
    assert np.isfinite(game).all()


@pytest.mark.parametrize("name", ["half_seconds", "stop_seconds"])
def test_times_that_a_row_cannot_count_are_refused(name: str) -> None:
    numbers: dict[str, Any] = {name: 1e6}
    with pytest.raises(ValueError, match=f"{name}: expected at most 209715.2 s, got 1000000"):
        play_scene(RefereeConfig("ssl_2026_b", **numbers), {"ball": (0.0, 0.0)})


def test_distances_that_do_not_fit_the_field_are_cut() -> None:
    start = {"ball": (0.0, 2.9, 0.0, 2.0), "last_touch": "blue_0"}
    rules = RefereeConfig("ssl_2026_b", kick_line_distance=3.5)
    assert EventKind.BALL_LEFT_FIELD_TOUCH_LINE in kinds(play_scene(rules, start))
    field = Field("ssl_b", goal_width=0.17)
    config = SimConfig(field, 1, 1, robot="ssl_generic", ball="ssl_tigers")
    penalty = {
        "ball": (0.0, 0.0),
        "robots": {"blue_0": (-1.0, 0.0), "yellow_0": (2.0, 1.0)},
        "command": "STOP",
        "next_command": "PREPARE_PENALTY_BLUE",
    }
    assert play_scene("ssl", penalty, seconds=5.0, config=config) is not None
