"""The rule of the lines: goals, own goals, balls that leave the field."""

import numpy as np
import pytest

import rsoccer
from rsoccer import Matches
from rsoccer._core import CROSSINGS
from rsoccer.frame import Frame
from rsoccer.game import BLUE, NOBODY, YELLOW, Event, EventKind
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.play import Play
from rsoccer.rng import WorldRng
from rsoccer.rules import Crossings
from rsoccer.rules.referee import RefereeRule
from rsoccer.tasks import SslGoToBall, VssSelfPlay
from tests.helpers import zeros
from tests.tasks.ssl_scenes import STAND, scene

EXPECTED = {
    "goal_right": (EventKind.GOAL, BLUE),
    "goal_left": (EventKind.GOAL, YELLOW),
    "goal_line_right": (EventKind.BALL_LEFT_FIELD_GOAL_LINE, None),
    "goal_line_left": (EventKind.BALL_LEFT_FIELD_GOAL_LINE, None),
    "touch_line_left": (EventKind.BALL_LEFT_FIELD_TOUCH_LINE, None),
    "touch_line_right": (EventKind.BALL_LEFT_FIELD_TOUCH_LINE, None),
}


def crossed(*crossings: str, last_touch: int = NOBODY) -> Play:
    """Worlds whose balls crossed lines, after the rule has judged them."""
    task, n = VssSelfPlay(), len(crossings)
    play = new_play(task, n, new_viewpoint(task, [0]), WorldRng.seeded(0, n))
    frame = Frame.empty(n, 3, 3)
    frame.ball.crossed[:] = [CROSSINGS.index(name) for name in crossings]
    frame.ball.crossed_at[:] = (0.3, -0.2)
    frame.ball.last_touch[:] = last_touch
    play.start(frame.rows)
    assert Crossings().judge(play) is None
    return play


def test_every_crossing_has_its_event() -> None:
    assert set(EXPECTED) == set(CROSSINGS) - {"none"}
    for robot, team in ((NOBODY, NOBODY), (0, BLUE), (2, BLUE), (3, YELLOW), (5, YELLOW)):
        play = crossed("none", *EXPECTED, last_touch=robot)
        assert play.events.of_world(0) == []
        for world, (kind, scorer) in enumerate(EXPECTED.values(), start=1):
            [event] = play.events.of_world(world)
            assert event[:3] == (kind, team if scorer is None else scorer, robot)
            assert event.position == pytest.approx((0.3, -0.2))


def test_goals_are_counted_for_the_team_that_attacks_there() -> None:
    play = crossed("goal_right", "goal_left", "none", "touch_line_left", last_touch=0)
    assert play.game.score.tolist() == [[1, 0], [0, 1], [0, 0], [0, 0]]
    Crossings().judge(play)
    assert play.game.score.tolist() == [[2, 0], [0, 2], [0, 0], [0, 0]]


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("autoreset", ["same_step", "next_step", "disabled"])
def test_a_goal_can_be_read_after_the_step_that_ends_the_episode(
    side: float, autoreset: str
) -> None:
    matches = Matches("VSSSelfPlay-v0", 2, autoreset=autoreset)
    frame = Frame.empty(2, 3, 3)
    frame.robots.position[:] = [(x, 0.5) for x in np.linspace(-0.6, 0.6, 6)]
    frame.ball.position[0] = (0.7 * side, 0.0)
    frame.ball.velocity[0] = (2.0 * side, 0.0)
    matches.reset(rows=frame.rows)
    while not matches.play.events.count.any():
        outcome = matches.step(zeros(matches))
    team = BLUE if side > 0 else YELLOW
    [event] = matches.play.events.of_world(0)
    assert event == Event(EventKind.GOAL, team, NOBODY, event.position)
    assert event.position == pytest.approx((0.75 * side, 0.0), abs=0.03)
    assert outcome.terminated.tolist() == [True, False]
    kept = [0, 0] if autoreset == "same_step" else [int(side > 0), int(side < 0)]
    assert matches.play.game.score.tolist() == [kept, [0, 0]]
    matches.step(zeros(matches))
    assert not matches.play.events.count.any(), "a waiting world does not repeat its goal"


def test_a_task_without_other_rules_reports_balls_that_left() -> None:
    task = SslGoToBall()
    matches = Matches(task, autoreset="disabled")
    matches.reset(rows=scene(task, ball=(1.0, 1.95, 0.0, 2.0), blue_0=(0.0, 0.0)).rows)
    found = []
    for _ in range(10):
        matches.step(np.array([[STAND]], np.float32))
        found += [event.kind for event in matches.play.events.of_world(0)]
    assert found == [EventKind.BALL_LEFT_FIELD_TOUCH_LINE]


def test_every_registered_task_judges_the_lines() -> None:
    for name in rsoccer.list_tasks():
        assert isinstance(rsoccer.make_task(name).rules[0], Crossings | RefereeRule)
