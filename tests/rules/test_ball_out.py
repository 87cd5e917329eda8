"""The rule of a ball that leaves the field: where it is repositioned."""

import numpy as np
import pytest

from rsoccer import SimConfig
from rsoccer._core import CROSSINGS, Field
from rsoccer.arrays import Floats
from rsoccer.frame import Frame
from rsoccer.new_play import new_play, new_viewpoint
from rsoccer.rng import WorldRng
from rsoccer.rules import BallOut, Restart, free_places
from rsoccer.tasks import SslSelfPlay
from tests.test_view import rotated


def rule_of(task: SslSelfPlay) -> BallOut:
    [rule] = [rule for rule in task.rules if isinstance(rule, BallOut)]
    return rule


def judged(task: SslSelfPlay, frame: Frame) -> Restart | None:
    """Decision of the rule on states in which balls may have crossed lines."""
    n = len(frame)
    play = new_play(task, n, new_viewpoint(task, [0]), WorldRng.seeded(0, n))
    play.start(frame.rows)
    return rule_of(task).judge(play)


def test_a_ball_is_repositioned_only_where_it_has_left() -> None:
    task = SslSelfPlay()
    frame = Frame.empty(4, 3, 3)
    assert judged(task, frame) is None
    frame.ball.crossed[:] = [
        CROSSINGS.index(name) for name in ("goal_right", "goal_left", "none", "goal_left")
    ]
    assert judged(task, frame) is None, "a goal does not leave the field"
    frame.ball.crossed[3] = CROSSINGS.index("goal_line_left")
    frame.ball.crossed_at[3] = (-3.0, 1.0)
    restart = judged(task, frame)
    assert restart is not None
    assert restart.worlds.tolist() == [3]


def test_a_ball_returns_to_the_nearest_free_position_along_its_line() -> None:
    """Of two at the same distance, to the one nearer to the middle of the line."""
    task, rng, n = SslSelfPlay(), np.random.default_rng(2), 200
    line = rng.integers(0, 4, n)
    across = np.where(line < 2, 1.0, -1.0)
    touch, along = line % 2 == 0, rng.uniform(0.05, 0.95, n) * rng.choice([-1.0, 1.0], n)
    left_at = np.where(touch, [3.0 * along, 2.0 * across], [3.0 * across, 2.0 * along]).T
    frame = Frame.empty(n, 3, 3)
    names = np.where(touch, CROSSINGS.index("touch_line_left"), CROSSINGS.index("goal_line_left"))
    frame.ball.crossed[:], frame.ball.crossed_at[:] = names, left_at
    inside = np.array([2.8, 1.8])
    frame.robots.position[:] = np.clip(left_at, -inside, inside)[:, None]
    frame.robots.position[:] += rng.uniform(-0.3, 0.3, (n, 6, 2))
    restart = judged(task, frame)
    assert restart is not None
    assert restart.balls is not None
    clearance, tried = 0.09 + 2.0 * 0.0215, 0
    for world in range(n):
        axis = 0 if touch[world] else 1
        middle = -np.sign(left_at[world, axis])
        for step in sorted(range(-29, 30), key=lambda step: (abs(step), step < 0)):
            place = left_at[world].copy()
            place[axis] += 0.05 * step * middle
            place = np.clip(place, -inside, inside)
            gaps = np.linalg.norm(frame.robots.position[world] - place, axis=1)
            if gaps.min() > clearance:
                break
            tried += 1
        assert restart.balls[world, :2] == pytest.approx(place, abs=1e-5), world
    assert tried > n, "most positions where a ball left were occupied"


def repositioned_among(task: SslSelfPlay, robots: Floats, left_at: tuple[float, float]) -> Floats:
    """New position (2,) of a ball that left over the touch line, with robots at (robots, 2)."""
    frame = Frame.empty(1, task.n_blue, task.n_yellow)
    frame.robots.position[:] = robots
    frame.ball.crossed[:] = CROSSINGS.index(
        "touch_line_left" if left_at[1] > 0 else "touch_line_right"
    )
    frame.ball.crossed_at[:] = left_at
    restart = judged(task, frame)
    assert restart is not None
    assert restart.balls is not None
    position: Floats = restart.balls[0, :2]
    return position


@pytest.mark.parametrize("robots_in", ["line", "line inside", "block"])
def test_a_position_off_the_line_is_free_where_robots_cover_the_line(robots_in: str) -> None:
    """Without a free position on the line, the ball was once placed inside a robot."""
    task = SslSelfPlay(n_blue=11, n_yellow=11)
    if robots_in != "block":  # those inside are nearer to positions outside of the field
        y = 1.8 if robots_in == "line" else 1.75
        robots = np.stack([np.linspace(-2.1, 2.1, 22), np.full(22, y)], axis=-1)
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
    assert np.hypot(*(position - [0.0, 1.8])) < distance[clear].min() + 0.04


def test_a_covered_line_of_one_world_does_not_move_the_balls_of_others() -> None:
    task = SslSelfPlay(n_blue=11, n_yellow=11)
    frame = Frame.empty(3, 11, 11)
    frame.robots.position[..., 0] = np.linspace(-2.1, 2.1, 22)
    frame.robots.position[1, :, 1] = 1.8  # in the other worlds they stand on the middle line
    frame.ball.crossed[:] = CROSSINGS.index("touch_line_left")
    frame.ball.crossed_at[:] = (0.3, 2.0)
    restart = judged(task, frame)
    assert restart is not None
    assert restart.balls is not None
    assert restart.balls[[0, 2], :2] == pytest.approx(np.array([[0.3, 1.8]] * 2))
    gaps = np.linalg.norm(frame.robots.position[1] - restart.balls[1, :2], axis=1)
    assert gaps.min() > 0.09 + 0.0215


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
    rule = rule_of(task)
    grid = rule.grid
    robots = np.random.default_rng(0).uniform(-0.1, 0.1, (1, 50, 2)).astype(np.float32)
    covered = [
        (~free_places.is_free(grid, robots[0, i : i + 1], rule.clearance)).sum()
        for i in range(robots.shape[1])
    ]
    assert max(covered) * 2 * team_size < len(grid)


def test_a_ball_that_left_returns_symmetrically() -> None:
    """Robots stand where the ball left, so the nearest positions are occupied."""
    worlds, task, rng = 40, SslSelfPlay(), np.random.default_rng(0)
    frame = Frame.empty(worlds, 3, 3)
    frame.robots.position[..., 0] = np.linspace(-1.0, 1.0, 6)
    frame.ball.crossed[:] = [
        CROSSINGS.index("touch_line_left"),
        CROSSINGS.index("goal_line_left"),
    ] * 20
    frame.ball.crossed_at[::2] = np.stack([rng.uniform(-3, 3, 20), np.full(20, 2.0)], axis=-1)
    frame.ball.crossed_at[1::2] = np.stack([np.full(20, -3.0), rng.uniform(0.5, 2, 20)], axis=-1)
    near = frame.ball.crossed_at + rng.uniform(-0.2, 0.2, (worlds, 2))
    frame.blue.position[:, 0] = np.clip(near, [-2.8, -1.8], [2.8, 1.8])
    ours, theirs = judged(task, frame), judged(task, rotated(frame))
    assert ours is not None
    assert theirs is not None
    assert ours.balls is not None
    assert theirs.balls is not None
    assert np.array_equal(-ours.balls[:, :2], theirs.balls[:, :2])
    aside = np.abs(ours.balls[:, :2] - np.clip(frame.ball.crossed_at, [-2.8, -1.8], [2.8, 1.8]))
    assert (aside.max(axis=1) > 0.01).sum() > 10, "no position was occupied"
