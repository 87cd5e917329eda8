import numpy as np
import pytest

from rsoccer import list_tasks, make_task, rewards
from rsoccer._core import Potential, mean_action_magnitude, nearest_to_ball
from rsoccer.arrays import Floats
from rsoccer.frame import GOAL_LEFT, GOAL_RIGHT
from rsoccer.matches import Matches
from rsoccer.task import Play
from rsoccer.tasks import VssSelfPlay
from tests import rewards_reference
from tests.helpers import pushing

TASK = VssSelfPlay()
FIELD = TASK.config.field


def initial_play(n: int = 2, task: VssSelfPlay = TASK) -> Play:
    matches = Matches(task, n, seed=3)
    matches.reset()
    return matches.play


def refill_views(play: Play, observers: int = 6, task: VssSelfPlay = TASK) -> None:
    """Recompute the views after a change of the frames."""
    viewpoint = task.new_viewpoint(range(observers))
    viewpoint.fill(play.frame, play.view)
    viewpoint.fill(play.last_frame, play.last_view)


def accumulate(term: str, steps: int = 60) -> tuple[Floats, Play, Play]:
    """Sum of a term over some steps, with the first and the last state."""
    matches = Matches(TASK, 5, seed=4, autoreset="disabled")
    matches.reset()
    first = matches.play.take(np.arange(5))
    total = np.zeros((5, 6), np.float32)
    rng = np.random.default_rng(0)
    for _ in range(steps):
        matches.step(pushing(rng, matches))
        play = matches.play
        total += (
            rewards.approach_behind_ball(play, FIELD)
            if term == "approach"
            else rewards.ball_to_goal(play, FIELD)
        )
    return total, first, matches.play


def test_a_goal_has_the_sign_of_the_observers_team() -> None:
    play = initial_play(3)
    play.frame.ball.crossed[:] = [GOAL_RIGHT, GOAL_LEFT, 0]
    refill_views(play)
    assert rewards.goal(play).tolist() == [[1] * 3 + [-1] * 3, [-1] * 3 + [1] * 3, [0] * 6]
    assert rewards.scored(play).tolist() == [True, True, False]
    assert rewards.goal_score(play.frame.ball).tolist() == [1.0, -1.0, 0.0]


def test_shaping_terms_are_zero_after_a_reset() -> None:
    play = initial_play()
    assert not rewards.ball_to_goal(play, FIELD).any()
    assert not rewards.approach_behind_ball(play, FIELD).any()


def test_ball_to_goal_is_in_metres() -> None:
    play = initial_play(1)
    play.last_frame.ball.position[:] = [0.0, 0.0]
    play.frame.ball.position[:] = [0.2, 0.0]
    refill_views(play)
    assert rewards.ball_to_goal(play, FIELD)[0] == pytest.approx([0.2] * 3 + [-0.2] * 3, abs=1e-6)


def test_ball_to_goal_is_zero_sum() -> None:
    total, _, play = accumulate("ball_to_goal")
    term = rewards.ball_to_goal(play, FIELD)
    assert term.any()
    assert (term[:, :3] == -term[:, 3:]).all()
    assert np.abs(total).max() > 0.01


def test_ball_to_goal_depends_on_the_end_points_only() -> None:
    total, first, last = accumulate("ball_to_goal")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    refill_views(first)
    assert total == pytest.approx(rewards.ball_to_goal(first, FIELD), abs=1e-5)


def test_approach_rewards_each_robots_own_motion() -> None:
    play = initial_play(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    # The point behind the ball is 8 cm from the ball, on the side of the own goal.
    positions = np.array([[0.3, 0], [0.2, 0], [-0.5, 0], [-0.1, 0], [-0.4, 0], [0.5, 0]])
    play.last_frame.robots.position[:] = positions
    play.frame.robots.position[:] = positions - [0.05, 0.0]
    refill_views(play)
    expected = [0.05, 0.05, -0.05, -0.05, -0.05, 0.05]
    assert rewards.approach_behind_ball(play, FIELD)[0] == pytest.approx(expected, abs=1e-6)


def test_approach_depends_on_the_end_points_only() -> None:
    total, first, last = accumulate("approach")
    first.frame.rows[:], first.last_frame.rows[:] = last.frame.rows, first.frame.rows.copy()
    refill_views(first)
    assert total == pytest.approx(rewards.approach_behind_ball(first, FIELD), abs=1e-5)
    assert np.abs(total).max() > 0.05


def test_a_robot_in_front_of_the_ball_is_rewarded_for_driving_around_it() -> None:
    """Driving at the ball from the front earns less than the same distance past the ball."""
    play = initial_play(1)
    play.frame.ball.position[:] = play.last_frame.ball.position[:] = 0.0
    play.last_frame.robots.position[0, :2] = [0.06, 0.0], [0.06, 0.0]
    play.frame.robots.position[0, :2] = [0.06, 0.0], [0.0, 0.06]
    refill_views(play)
    straight, around = rewards.approach_behind_ball(play, FIELD)[0, :2]
    assert around > straight + 0.03


def test_one_robot_of_each_team_is_nearest() -> None:
    play = initial_play(1)
    play.last_frame.ball.position[:] = 0.0
    positions = np.array([[0.3, 0], [0.2, 0], [0.5, 0], [-0.1, 0], [-0.4, 0], [-0.5, 0]])
    play.last_frame.robots.position[:] = positions
    assert rewards.nearest_to_ball(play)[0].tolist() == [False, True, False, True, False, False]


def test_one_robot_is_nearest_without_opponents() -> None:
    play = initial_play(20, VssSelfPlay(n_yellow=0))
    assert rewards.nearest_to_ball(play).sum(axis=1).tolist() == [1] * 20


def test_energy_is_the_mean_action_magnitude() -> None:
    play = initial_play(1)
    play.actions[0, 0] = [1.0, -1.0]
    play.actions[0, 1] = [0.0, 0.5]
    play.actions[0, 5] = [-1.0, 0.0]
    assert rewards.energy(play)[0] == pytest.approx([-1, -0.25, 0, 0, 0, -0.5])
    assert rewards.energy(play).dtype == np.float32


@pytest.mark.parametrize("name", list_tasks())
def test_terms_equal_the_reference(name: str) -> None:
    task = make_task(name)
    matches = Matches(task, 8, seed=5)
    matches.reset()
    rng = np.random.default_rng(0)
    for _ in range(20):
        matches.step(pushing(rng, matches))
    play, config = matches.play, task.config
    # The ball is at rest in some tasks, so its motion is added to the views.
    play.view.ball.position[:] += rng.uniform(-0.1, 0.1, play.view.ball.position.shape)
    differences = {
        "ball_to_goal": rewards.ball_to_goal(play, config.field),
        "approach_behind_ball": rewards.approach_behind_ball(play, config.field),
    }
    if config.robot.has_mouth:
        differences["approach_mouth"] = rewards.approach_mouth(play, config)
    for term, difference in differences.items():
        expected = getattr(rewards_reference, term)(play, config)
        np.testing.assert_allclose(difference, expected, atol=1e-6, err_msg=term)
        assert expected.all(), f"{term}: a difference of 0 compares nothing"
    assert np.array_equal(rewards.nearest_to_ball(play), rewards_reference.nearest_to_ball(play))
    np.testing.assert_allclose(rewards.energy(play), rewards_reference.energy(play), rtol=1e-6)


def test_wrong_arrays_are_refused_by_name() -> None:
    play = initial_play(2)
    last, view = play.last_view, play.view
    potential = Potential.ball_to_goal(FIELD)
    with pytest.raises(ValueError, match=r"last_ball must have shape \(2, 6, 14\)"):
        potential.difference(last.ball.data[:1], last.robots.data, view.ball.data, view.robots.data)
    with pytest.raises(ValueError, match="robots must have 4 axes"):
        potential.difference(last.ball.data, last.robots.data, view.ball.data, view.ball.data)
    with pytest.raises(TypeError, match="ball must be an array of float32, got float64"):
        balls = view.ball.data.astype(np.float64)
        views = last.ball.data, last.robots.data, balls, view.robots.data
        potential.difference(*views)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="robot must have a mouth, got vss_440rpm"):
        rewards.approach_mouth(play, TASK.config)
    for distance in (0.0, -1.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="distance must be above 0 m"):
            Potential.behind_ball(FIELD, distance)
    for observer in (-1, 6):
        with pytest.raises(ValueError, match=f"observers must be robots below 6, got {observer}"):
            nearest_to_ball(play.frame.rows, 3, np.array([0, observer]))
        with pytest.raises(ValueError, match=f"observers must be robots below 6, got {observer}"):
            mean_action_magnitude(play.actions, np.array([0, observer]))
    with pytest.raises(TypeError, match="observers must be an array of int64"):
        nearest_to_ball(play.frame.rows, 3, np.array([0.0]))
