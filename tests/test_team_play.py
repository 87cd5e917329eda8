"""Measures of a team's play, in scenes and against sums over whole matches."""

import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.arrays import Doubles
from rsoccer.evaluate.team_play import MEASURES, TeamPlayRecorder
from rsoccer.frame import Frame
from rsoccer.tasks import SslSelfPlay, VssSelfPlay
from tests.tasks.ssl_scenes import DRIBBLE, KICK, STAND, scene

TASK = SslSelfPlay()
MOUTH = float(TASK.mouth_offset)
PASS = {"ball": (-1.0 + MOUTH, 0.0), "blue_0": (-1.0, 0.0), "blue_1": (1.0, 0.0, np.pi)}


def measured(start: Frame, side: str = "blue", steps: int = 60) -> dict[str, Doubles]:
    """Measures of a side while blue_0 kicks and all others dribble where they stand."""
    matches, recorder = Matches(TASK, autoreset="disabled"), TeamPlayRecorder(TASK, side)
    matches.reset(rows=start.rows)
    recorder.begin(1)
    actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
    for step in range(steps):
        actions[0, 0] = (*KICK[:3], 0.4, -1.0) if step < 2 else STAND
        playing = ~matches.done
        matches.step(actions)
        recorder.record(matches.play, playing)
    return recorder.means()


def test_a_pass_to_a_teammate_is_one_of_its_team() -> None:
    blue, yellow = (measured(scene(TASK, **PASS), side) for side in ("blue", "yellow"))
    assert (blue["passes"][0], blue["lost"][0]) == (1.0, 0.0)
    assert (blue["ball_share"][0], yellow["ball_share"][0]) == (1.0, 0.0)
    assert (yellow["passes"][0], yellow["lost"][0]) == (0.0, 0.0)


def test_a_ball_to_an_opponent_is_lost() -> None:
    poses = {**PASS, "blue_1": (-2.0, -1.5), "yellow_0": (1.0, 0.0, np.pi)}
    blue, yellow = (measured(scene(TASK, **poses), side) for side in ("blue", "yellow"))
    assert (blue["passes"][0], blue["lost"][0]) == (0.0, 1.0)
    assert blue["ball_share"][0] + yellow["ball_share"][0] == pytest.approx(1.0)
    assert 0.1 < yellow["ball_share"][0] < 0.9


def test_neighbors_that_hand_the_ball_over_do_not_pass() -> None:
    poses = {"ball": (-0.25 + MOUTH, 0.0), "blue_0": (-0.25, 0.0), "blue_1": (0.25, 0.0, np.pi)}
    means = measured(scene(TASK, **poses))
    assert (means["passes"][0], means["lost"][0]) == (0.0, 0.0)


def test_the_goal_after_a_touch_of_a_teammate_is_assisted() -> None:
    def goal(previous: str) -> float:
        """Assists of blue: `previous` touches the ball, then blue_0 kicks it into the goal."""
        matches, recorder = Matches(TASK, autoreset="disabled"), TeamPlayRecorder(TASK, "blue")
        x = TASK.config.field.half_length - 1.0
        ball = (x + MOUTH, 0.0)
        beside = {"blue_0": (x - 2.0, 0.0, 0.0), previous: (x, 0.0, 0.0)}
        matches.reset(rows=scene(TASK, ball=ball, **beside).rows)
        recorder.begin(1)
        actions = np.tile(np.array(DRIBBLE, np.float32), (1, 6, 1))
        for _ in range(5):
            matches.step(actions)
            recorder.record(matches.play, ~matches.done)
        after = scene(TASK, ball=ball, blue_0=(x, 0.0, 0.0))
        after.ball.last_touch[0] = matches.frame.ball.last_touch[0]
        matches.reset(rows=after.rows)
        actions[0, 0] = KICK
        for _ in range(60):
            playing = ~matches.done
            outcome = matches.step(actions)
            recorder.record(matches.play, playing)
            if outcome.ended[0]:
                break
        assert outcome.metrics["goal_score"][0] == 1.0
        return float(recorder.means()["assists"][0])

    assert goal("blue_1") == 1.0
    assert goal("yellow_0") == 0.0


def test_positions_are_measured_in_meters_and_shares_of_the_goal() -> None:
    poses = {"ball": (1.0, 0.0), "blue_0": (0.0, 1.0), "blue_1": (0.0, -1.0), "blue_2": (0.0, 1.5)}
    open_goal = measured(scene(TASK, **poses), steps=1)
    assert open_goal["spread"][0] == pytest.approx((2.0 + 2.5 + 0.5) / 3, abs=1e-3)
    assert open_goal["cover"][0] == 0.0
    near = {**poses, "ball": (-2.5, 0.0), "blue_0": (-2.8, 0.0)}
    assert measured(scene(TASK, **near), steps=1)["cover"][0] > 0.5
    behind = {**poses, "ball": (-2.5, 0.0), "blue_0": (-2.2, 0.0)}
    assert measured(scene(TASK, **behind), steps=1)["cover"][0] == 0.0
    assert measured(scene(TASK, **near), "yellow", steps=1)["cover"][0] == 0.0


def test_each_match_is_measured_alone_and_to_its_end() -> None:
    """World i of a batch has the measures of the same match alone, waiting worlds included."""

    def played(worlds: int, seed: int) -> dict[str, Doubles]:
        task = VssSelfPlay(max_steps=150)
        controllers = {"blue": "chase", "yellow": "ou"}
        matches = Matches(task, worlds, seed, controllers=controllers, autoreset="disabled")
        recorder = TeamPlayRecorder(task, "blue")
        matches.reset()
        recorder.begin(worlds)
        for _ in range(task.max_steps):
            playing = ~matches.done
            matches.step(np.zeros((worlds, 0, 2), np.float32))
            recorder.record(matches.play, playing)
        assert matches.done.all()
        return recorder.means()

    batch, singles = played(3, 3), [played(1, 3 + i) for i in range(3)]
    assert list(batch) == list(MEASURES)
    for name in MEASURES:
        alone = np.concatenate([single[name] for single in singles])
        assert (batch[name] == alone).all(), name
    assert len(np.unique(batch["spread"])) == 3
    assert 0.0 < batch["ball_share"].mean() <= 1.0
