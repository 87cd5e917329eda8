import numpy as np
import pytest

from rsoccer import Matches, SimConfig
from rsoccer._core import CROSSINGS, Field
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
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
    """Let the ball leave the field; the matches after it is repositioned, and all rewards."""
    matches = Matches(SOLO, 1, autoreset="disabled")
    start = scene(SOLO, ball=ball, **{"blue_0": (0.0, 0.0), "yellow_0": (0.5, 0.0)} | robots)
    matches.reset(rows=start.rows)
    rewards = []
    for _ in range(20):
        outcome = matches.step(np.array([[STAND, STAND]], np.float32))
        assert not outcome.ended[0], "a ball off the field does not terminate"
        rewards.append(outcome.rewards[0])
        if not matches.frame.ball.velocity.any():
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
    # Only the motion up to the line is rewarded, not the jump back.
    assert np.abs(rewards[-1]).max() < 1e-3
    assert np.abs(rewards).max() < 0.2


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


def test_a_ball_is_repositioned_only_where_it_has_left() -> None:
    assert TASK.reposition_ball(Frame.empty(3, 3, 3)) is None


def repositioned_among(task: SslSelfPlay, robots: Floats, left_at: tuple[float, float]) -> Floats:
    """New position (2,) of a ball that left over the touch line, with robots at (robots, 2)."""
    frame = Frame.empty(1, task.n_blue, task.n_yellow)
    frame.robots.position[:] = robots
    frame.ball.crossed[:] = CROSSINGS.index(
        "touch_line_left" if left_at[1] > 0 else "touch_line_right"
    )
    frame.ball.crossed_at[:] = left_at
    moves = task.reposition_ball(frame)
    assert moves is not None
    position: Floats = moves[1][0, :2]
    return position


@pytest.mark.parametrize("robots_in", ["line", "block"])
def test_a_position_off_the_line_is_free_where_robots_cover_the_line(robots_in: str) -> None:
    """Without a free position on the line, the ball was once placed inside a robot."""
    task = SslSelfPlay(n_blue=11, n_yellow=11)
    if robots_in == "line":
        robots = np.stack([np.linspace(-2.1, 2.1, 22), np.full(22, 1.8)], axis=-1)
    else:
        x = np.concatenate([np.linspace(-1.6, 1.6, 14), np.linspace(-0.8, 0.8, 8)])
        robots = np.stack([x, np.where(np.arange(22) < 14, 1.8, 1.6)], axis=-1)
    robots = robots.astype(np.float32)
    position = repositioned_among(task, robots, (0.0, 2.0))
    gaps = np.linalg.norm(robots - position, axis=1)
    assert gaps.min() > 0.09 + 0.0215, "clear of robots"
    assert np.abs(position[1]) < 1.79, "off the line"
    # No position of a fine grid is free and much nearer.
    grid = np.stack(np.meshgrid(np.arange(-2.8, 2.81, 0.02), np.arange(-1.8, 1.81, 0.02)), axis=-1)
    distance = np.linalg.norm(grid - [0.0, 1.8], axis=-1)
    clear = np.linalg.norm(grid[..., None, :] - robots, axis=-1).min(axis=-1) > 0.09 + 2 * 0.0215
    assert np.hypot(*(position - [0.0, 1.8])) < distance[clear].min() + 0.08


def test_a_position_off_the_line_is_symmetric_between_the_teams() -> None:
    task, rng = SslSelfPlay(n_blue=11, n_yellow=11), np.random.default_rng(0)
    off = 0
    for _ in range(100):
        x = np.linspace(-2.1, 2.1, 22) + rng.uniform(-0.03, 0.03, 22)
        robots = np.stack([x, 1.8 + rng.uniform(-0.02, 0.02, 22)], axis=-1).astype(np.float32)
        left_at = (float(np.float32(rng.uniform(-0.5, 0.5))), 2.0)
        blue = repositioned_among(task, robots, left_at)
        yellow = repositioned_among(task, -robots, (-left_at[0], -left_at[1]))
        assert np.array_equal(blue, -yellow)
        off += int(blue[1] < 1.79)
    assert off > 50


@pytest.mark.parametrize("field", [name for name in Field.PRESETS if name.startswith("ssl")])
def test_robots_cannot_cover_the_whole_grid(field: str) -> None:
    config = SimConfig(field, 1, 0, robot="ssl_generic")
    team_size = config.field.max_robots
    task = SslSelfPlay(field=field, n_blue=team_size, n_yellow=team_size)
    grid = task._grid
    robots = np.random.default_rng(0).uniform(-0.1, 0.1, (1, 50, 2)).astype(np.float32)
    covered = [
        (~task._is_free(grid[None], robots[:, i : i + 1])).sum() for i in range(robots.shape[1])
    ]
    assert max(covered) * 2 * team_size < len(grid)
