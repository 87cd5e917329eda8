import numpy as np
import pytest

from rsoccer import rewards
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT, Floats
from rsoccer.matches import Matches
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests.helpers import pushing

TASK = VssSelfPlay()
FIELD = TASK.config.field


def still(n: int = 2, task: VssSelfPlay = TASK) -> Play:
    matches = Matches(task, n, seed=3)
    matches.reset()
    return matches.play


def show(play: Play, seers: int = 6, task: VssSelfPlay = TASK) -> None:
    """Fill the views again after a change of the frames."""
    viewpoint = task.new_viewpoint(range(seers))
    viewpoint.fill(play.frame, play.view)
    viewpoint.fill(play.last_frame, play.last_view)


def walk(term: str, steps: int = 60) -> tuple[Floats, Play, Play]:
    """The sum of a term over some steps, and the plays at both ends."""
    matches = Matches(TASK, 5, seed=4, autoreset="disabled")
    matches.reset()
    first = matches.play.take(np.arange(5))
    total = np.zeros((5, 6), np.float32)
    rng = np.random.default_rng(0)
    for _ in range(steps):
        matches.step(pushing(rng, matches))
        play = matches.play
        total += (
            rewards.approach(play, FIELD)
            if term == "approach"
            else rewards.ball_to_goal(play, FIELD)
        )
    return total, first, matches.play


def test_a_goal_is_good_for_who_attacks_that_side() -> None:
    play = still(3)
    play.frame.ball.crossed[:] = [GOAL_RIGHT, GOAL_LEFT, 0]
    show(play)
    assert rewards.goal(play).tolist() == [[1] * 3 + [-1] * 3, [-1] * 3 + [1] * 3, [0] * 6]
    assert rewards.scored(play).tolist() == [True, True, False]
    assert rewards.goals_at(play.frame.ball).tolist() == [1.0, -1.0, 0.0]


def test_right_after_a_reset_nothing_has_come_closer() -> None:
    play = still()
    assert not rewards.ball_to_goal(play, FIELD).any()
    assert not rewards.approach(play, FIELD).any()


def test_the_ball_pays_in_metres_along_the_axis() -> None:
    play = still(1)
    play.last_frame.ball.position[:] = [0.0, 0.0]
    play.frame.ball.position[:] = [0.2, 0.0]
    show(play)
    assert rewards.ball_to_goal(play, FIELD)[0] == pytest.approx([0.2] * 3 + [-0.2] * 3, abs=1e-6)


def test_what_the_ball_pays_one_side_it_costs_the_other_exactly() -> None:
    total, _, play = walk("ball_to_goal")
    paid = rewards.ball_to_goal(play, FIELD)
    assert paid.any()
    assert (paid[:, :3] == -paid[:, 3:]).all()
    assert np.abs(total).max() > 0.01


def test_the_ball_pays_only_for_where_it_ends_up() -> None:
    total, first, last = walk("ball_to_goal")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    show(first)
    assert total == pytest.approx(rewards.ball_to_goal(first, FIELD), abs=1e-5)


def test_approach_pays_each_robot_for_its_own_way() -> None:
    play = still(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    # The point behind the ball is 8 cm from it, on the own goal's side.
    where = np.array([[0.3, 0], [0.2, 0], [-0.5, 0], [-0.1, 0], [-0.4, 0], [0.5, 0]])
    play.last_frame.robots.position[:] = where
    play.frame.robots.position[:] = where - [0.05, 0.0]
    show(play)
    expected = [0.05, 0.05, -0.05, -0.05, -0.05, 0.05]
    assert rewards.approach(play, FIELD)[0] == pytest.approx(expected, abs=1e-6)


def test_approach_pays_only_for_where_a_robot_ends_up() -> None:
    total, first, last = walk("approach")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    show(first)
    assert total == pytest.approx(rewards.approach(first, FIELD), abs=1e-5)
    assert np.abs(total).max() > 0.05


def test_who_stands_before_the_ball_is_drawn_around_it() -> None:
    """Straight at the ball from the front pays less than the same way past it."""
    play = still(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    play.last_frame.robots.position[0, :2] = [0.06, 0.0], [0.06, 0.0]
    play.frame.robots.position[0, :2] = [0.06, 0.0], [0.0, 0.06]
    show(play)
    straight, around = rewards.approach(play, FIELD)[0, :2]
    assert around > straight + 0.03


def test_one_robot_of_each_team_was_nearest() -> None:
    play = still(1)
    play.last_frame.ball.position[:] = 0.0
    where = np.array([[0.3, 0], [0.2, 0], [0.5, 0], [-0.1, 0], [-0.4, 0], [-0.5, 0]])
    play.last_frame.robots.position[:] = where
    assert rewards.nearest(play)[0].tolist() == [False, True, False, True, False, False]


def test_the_nearest_with_nobody_on_the_other_side() -> None:
    play = still(20, VssSelfPlay(n_yellow=0))
    assert rewards.nearest(play).sum(axis=1).tolist() == [1] * 20


def test_energy_is_the_mean_effort() -> None:
    play = still(1)
    play.actions[0, 0] = [1.0, -1.0]
    play.actions[0, 1] = [0.0, 0.5]
    play.actions[0, 5] = [-1.0, 0.0]
    assert rewards.energy(play)[0] == pytest.approx([-1, -0.25, 0, 0, 0, -0.5])
    assert rewards.energy(play).dtype == np.float32
