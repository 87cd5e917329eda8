import numpy as np
import pytest

from rsoccer import Matches
from rsoccer.tasks import SslSelfPlay
from tests.tasks.ssl_scenes import STAND, play, run, scene

TASK = SslSelfPlay()
SOLO = SslSelfPlay(n_blue=1, n_yellow=1)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_a_goal_of_either_team_terminates(side: float) -> None:
    outcome, _ = run(TASK, scene(TASK, ball=(2.8 * side, 0.1, 2.0 * side, 0.0)))
    assert outcome.terminated[0]
    assert outcome.metrics["goal_score"][0] == side
    assert outcome.terms["goal"][0].tolist() == [10.0 * side] * 3 + [-10.0 * side] * 3


def repositioned(
    ball: tuple[float, ...], **robots: tuple[float, ...]
) -> tuple[Matches, np.ndarray]:
    """Let the ball leave the field; the matches after it was repositioned, and all rewards to then.

    The last reward is that of the step after.
    """
    matches = Matches(SOLO, 1, autoreset="disabled")
    start = scene(SOLO, ball=ball, **{"blue_0": (0.0, 0.0), "yellow_0": (0.5, 0.0)} | robots)
    matches.reset(rows=start.rows)
    rewards = []
    for _ in range(20):
        outcome = matches.step(np.array([[STAND, STAND]], np.float32))
        assert not outcome.ended[0], "a ball off the field does not terminate"
        rewards.append(outcome.rewards[0])
        if not matches.frame.ball.velocity.any():
            rewards.append(matches.step(np.array([[STAND, STAND]], np.float32)).rewards[0])
            return matches, np.array(rewards)
    raise AssertionError("the ball was not repositioned")


@pytest.mark.parametrize(
    ("ball", "expected"),
    [
        ((1.0, 1.95, 0.0, 2.0), (1.0, 1.8)),
        ((-1.0, -1.95, 0.0, -2.0), (-1.0, -1.8)),
        ((2.95, 1.0, 2.0, 0.0), (2.8, 1.0)),
        ((-2.95, -1.0, -2.0, 0.0), (-2.8, -1.0)),
        ((2.9, 1.95, 2.0, 2.0), (2.8, 1.8)),  # by the corner
    ],
)
def test_a_ball_that_leaves_is_repositioned_inside_the_line(
    ball: tuple[float, ...], expected: tuple[float, float]
) -> None:
    matches, rewards = repositioned(ball)
    assert matches.frame.ball.position[0] == pytest.approx(expected, abs=0.02)
    assert matches.frame.ball.height[0] == 0.0
    assert matches.frame.ball.last_touch[0] == -1.0
    # The motion over the line is rewarded, as all motion before it, and the jump back is not.
    assert np.abs(rewards[-1]).max() < 1e-3
    assert np.abs(rewards).max() < 0.2
    paid = np.abs(rewards[:-1, 0])
    if abs(ball[1]) > 1.9 or abs(ball[0]) > 2.9:
        assert paid[-1] > 0.5 * paid[0] > 0.0 or len(paid) == 1


def test_an_occupied_position_is_replaced_by_the_next_free_one() -> None:
    for blocker, x in (((1.0, 1.8), 0.86), ((1.05, 1.8), 0.9), ((0.95, 1.8), 1.1)):
        matches, _ = repositioned((1.0, 1.95, 0.0, 2.0), yellow_0=blocker)
        found = matches.frame.ball.position[0]
        assert found[1] == pytest.approx(1.8)
        assert found[0] == pytest.approx(x, abs=0.03)
        gap = np.linalg.norm(found - matches.frame.yellow.position[0, 0])
        assert 0.09 + 0.0215 < gap < 0.2


def test_repositioning_does_not_affect_other_worlds() -> None:
    matches = Matches(SOLO, 2, autoreset="disabled")
    robots = {"blue_0": (0.0, 0.0), "yellow_0": (0.5, 0.0)}
    frames = [
        scene(SOLO, ball=ball, **robots) for ball in ((1.0, 1.99, 0.0, 2.0), (1.0, 1.0, 0.0, 1.0))
    ]
    matches.reset(rows=np.concatenate([frame.rows for frame in frames]))
    matches.step(np.tile(np.array(STAND, np.float32), (2, 2, 1)))
    ball = matches.frame.ball
    assert ball.position[0] == pytest.approx([1.0, 1.8], abs=0.01)
    assert not ball.velocity[0].any()
    assert ball.velocity[1, 1] > 0.8


@pytest.mark.parametrize(("blue", "yellow"), [(1, 1), (2, 3), (3, 0)])
def test_team_sizes_are_options(blue: int, yellow: int) -> None:
    task = SslSelfPlay(n_blue=blue, n_yellow=yellow)
    matches = Matches(task, 2)
    matches.reset()
    assert len(matches.agents) == blue + yellow
    actions = np.zeros((2, blue + yellow, 5), np.float32)
    assert np.isfinite(matches.step(actions).observations).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"n_blue": 0}, "n_blue: expected at least 1"),
        ({"n_yellow": -1}, "n_yellow: expected at least 0"),
        ({"n_blue": 99}, "99|robots"),
        ({"field": "ssl_z"}, "ssl_z"),
    ],
)
def test_invalid_team_sizes_and_fields_are_refused(
    options: dict[str, int | str], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        SslSelfPlay(**options).config  # type: ignore[arg-type]  # noqa: B018


def test_matches_run_on_any_ssl_field() -> None:
    for field in ("ssl_a", "ssl_b"):
        matches = Matches(SslSelfPlay(field=field, n_blue=6, n_yellow=6), 1)
        matches.reset()
        assert matches.frame.robots.position.shape == (1, 12, 2)


def test_goals_are_the_largest_part_of_the_return() -> None:
    episodes = play(SslSelfPlay(n_blue=1, n_yellow=1), "strike", worlds=10)
    assert np.abs(episodes.metrics["goal_score"]).mean() > 0.6
    assert episodes.largest_term() == "goal"
